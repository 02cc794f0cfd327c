#include "dem/peridynamics/supports.h"

#include "dem/neighbours/pieces.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  namespace
  {
    constexpr int most_motions = 6;
    using Motion               = Eigen::Matrix<double, most_motions, 1>;

    int motions_of(const int dimension) { return dimension == 1 ? 1 : dimension == 2 ? 3 : 6; }

    /** What the rigid motions of a piece are at one component of a node: translations, then rotations over its size. */
    Motion motions_at(const Eigen::Vector3d &arm, const int dimension, const int component)
    {
      Motion m     = Motion::Zero();
      m[component] = 1;
      if (dimension == 2)
        m[2] = component == 0 ? -arm.y() : arm.x();
      if (dimension == 3)
        {
          const Eigen::Vector3d axis = Eigen::Vector3d::Unit(component);
          m.tail<3>()                = arm.cross(axis);
        }
      return m;
    }

    /** Orthonormal directions among the rigid motions of a piece that are held. */
    struct HeldDirections
    {
      std::vector<Motion> basis;

      Motion rest(Motion m) const
      {
        for (const Motion &b : basis)
          m -= b.dot(m) * b;
        return m;
      }
      void add(const Motion &m)
      {
        const Motion r = rest(m);
        if (r.norm() > 1e-6)
          basis.push_back(rest(r.normalized()).normalized());
      }
    };

    struct Piece
    {
      const Grid                     &grid;
      const std::vector<std::size_t> &nodes;
      Eigen::Vector3d                 centre = Eigen::Vector3d::Zero();
      double                          size   = 0;

      Piece(const Grid &of, const std::vector<std::size_t> &places)
        : grid(of)
        , nodes(places)
      {
        for (const std::size_t i : nodes)
          centre += grid.position(i) / static_cast<double>(nodes.size());
        for (const std::size_t i : nodes)
          size = std::max(size, (grid.position(i) - centre).norm());
        size = std::max(size, grid.spacing());
      }
      Motion at(const std::size_t i, const int component) const
      {
        return motions_at((grid.position(i) - centre) / size, grid.dimension(), component);
      }
    };

    void hold(const Piece &piece, const Field &load, RigidMotions &found)
    {
      const int      d = piece.grid.dimension();
      HeldDirections directions;
      Motion         sum       = Motion::Zero();
      double         magnitude = 0;
      for (const std::size_t i : piece.nodes)
        for (int c = 0; c < d; ++c)
          {
            const Motion m = piece.at(i, c);
            if (found.held[i] >> c & 1)
              directions.add(m);
            else
              {
                sum += load.c[static_cast<std::size_t>(c)][i] * m;
                magnitude += std::abs(load.c[static_cast<std::size_t>(c)][i]) * m.norm();
              }
          }
      // Nodes on a point or a line have fewer rigid motions: rotations about them move nothing.
      const double imbalance = magnitude > 0 ? directions.rest(sum).norm() / magnitude : 0;
      if (directions.basis.size() < static_cast<std::size_t>(motions_of(d)) && imbalance > found.imbalance)
        {
          found.imbalance = imbalance;
          found.loose     = piece.nodes.size();
        }
      while (directions.basis.size() < static_cast<std::size_t>(motions_of(d)))
        {
          double      best      = 1e-6;
          std::size_t node      = 0;
          int         component = -1;
          for (const std::size_t i : piece.nodes)
            for (int c = 0; c < d; ++c)
              if (const double r = directions.rest(piece.at(i, c)).norm(); r > best * (1 + 1e-9))
                {
                  best      = r;
                  node      = i;
                  component = c;
                }
          if (component < 0)
            return;
          directions.add(piece.at(node, component));
          found.held[node] |= static_cast<std::uint8_t>(1u << component);
          found.free = true;
        }
    }
  } // namespace

  RigidMotions hold_rigid_motions(const Bonds &bonds, const Held &held, const Field &load)
  {
    const Grid                &grid = bonds.grid();
    std::vector<NeighbourPair> whole;
    bonds.each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      if (bonds.stiffness()[bond] != 0)
        whole.push_back({grid.number(i), grid.number(j), {0, 0, 0}});
    });
    const Pieces                          pieces = find_pieces(grid.nodes().size(), whole);
    std::vector<std::vector<std::size_t>> members(pieces.size.size());
    for (std::size_t n = 0; n < grid.nodes().size(); ++n)
      members[pieces.piece[n]].push_back(grid.nodes()[n]);
    RigidMotions found;
    found.held = held;
    for (const auto &places : members)
      hold(Piece(grid, places), load, found);
    return found;
  }

  void remove_rigid_motion(const Grid &grid, Field &u)
  {
    const int       n     = motions_of(grid.dimension());
    const double    size  = grid.body().size.norm();
    Eigen::MatrixXd sums  = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(n);
    for (const std::size_t i : grid.nodes())
      for (int c = 0; c < grid.dimension(); ++c)
        {
          const Eigen::VectorXd m = motions_at(grid.position(i) / size, grid.dimension(), c).head(n);
          sums += grid.volume()[i] * m * m.transpose();
          moved += grid.volume()[i] * u.c[static_cast<std::size_t>(c)][i] * m;
        }
    const Eigen::VectorXd rigid = sums.completeOrthogonalDecomposition().solve(moved);
    for (const std::size_t i : grid.nodes())
      for (int c = 0; c < grid.dimension(); ++c)
        u.c[static_cast<std::size_t>(c)][i] -=
          rigid.dot(motions_at(grid.position(i) / size, grid.dimension(), c).head(n));
  }
} // namespace dem::peridynamics

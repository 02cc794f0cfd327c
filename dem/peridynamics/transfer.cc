#include "dem/peridynamics/transfer.h"

#include "dem/core/symmetric_modes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem::peridynamics
{
  double boundary_weight(
    const TractionWeight weight, const BondModel model, const int dimension, const double r, const double horizon)
  {
    if (r >= horizon)
      return 0;
    const bool prototype = model == BondModel::prototype;
    if (weight == TractionWeight::paper)
      return prototype ? horizon - r : horizon * horizon - r * r;
    const int power = prototype ? dimension : dimension + 1;
    return (std::pow(horizon, power) - std::pow(r, power)) / std::pow(r, dimension - 1);
  }

  namespace
  {
    /**
     * Weight of a node at the point itself: the mean over the part of its cell that it has at the boundary, by symmetry that of a quadrant,
     * by midpoints.
     */
    double own_weight(const TractionWeight weight, const BondModel model, const Grid &grid, const double horizon)
    {
      if (grid.dimension() == 1) // there e e is 1 whatever the direction: nothing has to be averaged
        return boundary_weight(weight, model, 1, 0.0, horizon);
      constexpr int n    = 20; // 40 x 40 over a whole cell
      const double  step = 0.5 * grid.spacing() / n;
      const int     nz   = grid.dimension() > 2 ? n : 1;
      double        sum  = 0;
      for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
          for (int z = 0; z < nz; ++z)
            {
              const Eigen::Vector3d p(x + 0.5, y + 0.5, nz > 1 ? z + 0.5 : 0.0);
              sum += boundary_weight(weight, model, grid.dimension(), step * p.norm(), horizon);
            }
      return sum / (n * n * nz);
    }
  } // namespace

  Transfer::Transfer(const Grid                &grid,
                     const double               horizon,
                     const BondModel            model,
                     std::vector<BoundaryPoint> points,
                     const TractionWeight       weight,
                     const TractionForm         how)
    : of(grid)
    , form(how)
    , point(std::move(points))
  {
    const double own = own_weight(weight, model, grid, horizon);
    const int    far = static_cast<int>(std::ceil(horizon / grid.spacing())) + 1;
    for (const BoundaryPoint &p : point)
      {
        begin.push_back(share.size());
        if (form == TractionForm::layer)
          continue;
        const std::array<int, 3> middle = grid.numbers(p.outer);
        const int                far_y = grid.dimension() > 1 ? far : 0, far_z = grid.dimension() > 2 ? far : 0;
        Eigen::Matrix3d          sum = Eigen::Matrix3d::Zero();
        for (int z = -far_z; z <= far_z; ++z)
          for (int y = -far_y; y <= far_y; ++y)
            for (int x = -far; x <= far; ++x)
              {
                const std::array<int, 3> i = {middle[0] + x, middle[1] + y, middle[2] + z};
                if (!grid.has_node(i))
                  continue;
                const std::size_t at     = grid.place(i);
                const double      r      = (grid.position(at) - p.place).norm();
                const bool        itself = r < 1e-9 * grid.spacing();
                const double      alpha  = itself ? own : boundary_weight(weight, model, grid.dimension(), r, horizon);
                if (alpha <= 0)
                  continue;
                share.push_back({at, alpha * grid.volume()[at], itself});
                sum += product(share.back(), p.place, nullptr);
              }
        const SymmetricModes modes = symmetric_modes(sum.topLeftCorner(grid.dimension(), grid.dimension()));
        const double         least = modes.values[0], most = modes.values[grid.dimension() - 1];
        if (least < 1e-8 * most || most <= 0)
          ++singular_points;
        else
          worst = std::max(worst, most / least);
      }
    begin.push_back(share.size());
  }

  Eigen::Vector3d Transfer::place_of(const BoundaryPoint &p, const Field *const u) const
  {
    if (u == nullptr)
      return p.place;
    const Eigen::Vector3d outer = u->at(p.outer);
    if (p.inner == p.outer)
      return p.place + outer;
    const double beyond = (p.place - of.position(p.outer)).norm() / of.spacing();
    return p.place + outer + beyond * (outer - u->at(p.inner));
  }

  Eigen::Matrix3d Transfer::product(const Share &s, const Eigen::Vector3d &from, const Field *const u) const
  {
    if (s.itself)
      {
        Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
        for (int a = 0; a < of.dimension(); ++a)
          all(a, a) = s.weight / of.dimension();
        return all;
      }
    Eigen::Vector3d e = from - of.position(s.node);
    if (u != nullptr)
      e -= u->at(s.node);
    return s.weight / e.squaredNorm() * e * e.transpose();
  }

  void Transfer::spread(const std::size_t p, const Eigen::Vector3d &force, const Field *const u, Field &forces) const
  {
    const Eigen::Vector3d from = place_of(point[p], u);
    Eigen::Matrix3d       sum  = Eigen::Matrix3d::Zero();
    for (std::size_t n = begin[p]; n < begin[p + 1]; ++n)
      sum += product(share[n], from, u);
    const int            d                   = of.dimension();
    const SymmetricModes modes               = symmetric_modes(sum.topLeftCorner(d, d));
    Eigen::Vector3d      inverse_times_force = Eigen::Vector3d::Zero();
    Eigen::VectorXd      carried             = Eigen::VectorXd::Zero(d);
    for (int m = 0; m < d; ++m)
      if (modes.values[m] > 1e-8 * modes.values[d - 1])
        {
          const Eigen::VectorXd mode = modes.vectors.col(m);
          const double          part = mode.dot(force.head(d));
          carried += part * mode;
          inverse_times_force.head(d) += part / modes.values[m] * mode;
        }
    for (std::size_t n = begin[p]; n < begin[p + 1]; ++n)
      forces.add(share[n].node, product(share[n], from, u) * inverse_times_force);
    // What no direction of these nodes can carry is shared out evenly.
    const Eigen::VectorXd rest = force.head(d) - carried;
    if (rest.norm() <= 1e-12 * force.norm())
      return;
    double whole = 0;
    for (std::size_t n = begin[p]; n < begin[p + 1]; ++n)
      whole += of.volume()[share[n].node];
    Eigen::Vector3d padded = Eigen::Vector3d::Zero();
    padded.head(d)         = rest;
    for (std::size_t n = begin[p]; n < begin[p + 1]; ++n)
      forces.add(share[n].node, of.volume()[share[n].node] / whole * padded);
    if (whole == 0)
      forces.add(point[p].outer, padded);
  }

  void Transfer::add(const std::vector<Eigen::Vector3d> &traction, const Field *const u, Field &forces) const
  {
    for (std::size_t p = 0; p < point.size(); ++p)
      {
        const Eigen::Vector3d force = point[p].area * traction[p];
        if (form == TractionForm::layer)
          forces.add(point[p].outer, force);
        else if (force.squaredNorm() > 0)
          spread(p, force, u, forces);
      }
  }
} // namespace dem::peridynamics

#include "coupling/volume/absorber.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;
  using Eigen::VectorXd;

  namespace
  {
    /** Of a cubic B-spline at the four knots around a place. @param part of the way from the second to the third */
    std::array<double, 4> spline_weights(const double part)
    {
      const double rest = 1 - part;
      return {rest * rest * rest / 6, (4 - 6 * part * part + 3 * part * part * part) / 6,
              (4 - 6 * rest * rest + 3 * rest * rest * rest) / 6, part * part * part / 6};
    }

    /** Knots of the grid by their numbers along the axes, in the order in which they were first needed. */
    class Knots
    {
    public:
      Index number(const std::array<long, 3> &at)
      {
        return known.emplace(at, static_cast<Index>(known.size())).first->second;
      }
      Index size() const { return static_cast<Index>(known.size()); }

    private:
      std::map<std::array<long, 3>, Index> known;
    };

    /** Rows times columns; each row by one thread, so that the sum is the same for any number of them. */
    CarrierRows product(const WeightRows &rows, const CarrierRows &columns)
    {
      CarrierRows result(rows.rows(), 3);
#pragma omp parallel for schedule(static)
      for (Index r = 0; r < rows.rows(); ++r)
        {
          Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
          for (WeightRows::InnerIterator it(rows, r); it; ++it)
            sum += it.value() * columns.row(it.col());
          result.row(r) = sum;
        }
      return result;
    }
  } // namespace

  FineScaleAbsorber::FineScaleAbsorber(const AbsorberParameters &parameters, AbsorberCarriers given)
    : sharpness(parameters.sharpness)
    , carriers(std::move(given))
    , points_of_nodes(carriers.weights.transpose())
  {
    if (!(parameters.spacing > 0))
      throw base::InputError("Absorber: the spacing of its grid must be above 0 m.");
    if (sharpness < 1)
      throw base::InputError("Absorber: the sharpness must be 1 at least.");
    mass.resize(carriers.whole_mass.size() + carriers.point_mass.size());
    mass << carriers.whole_mass, carriers.point_mass;
    make_grid(parameters.spacing);
    make_fit();
    find_largest_rate();
  }

  void FineScaleAbsorber::make_grid(const double spacing)
  {
    std::vector<Vector3d> all = carriers.places;
    all.insert(all.end(), carriers.points.begin(), carriers.points.end());
    Knots                               knots;
    std::vector<Eigen::Triplet<double>> entries;
    const int                           across = carriers.dimension == 3 ? 4 : 1;
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        std::array<long, 3>                  low{};
        std::array<std::array<double, 4>, 3> weight{};
        weight[2] = {1, 0, 0, 0};
        for (int c = 0; c < carriers.dimension; ++c)
          {
            const double at = all[k][c] / spacing, whole = std::floor(at);
            low[static_cast<std::size_t>(c)]    = static_cast<long>(whole) - 1;
            weight[static_cast<std::size_t>(c)] = spline_weights(at - whole);
          }
        for (int z = 0; z < across; ++z)
          for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
              entries.emplace_back(knots.number({low[0] + x, low[1] + y, low[2] + z}), static_cast<Index>(k),
                                   weight[0][static_cast<std::size_t>(x)] * weight[1][static_cast<std::size_t>(y)] *
                                     weight[2][static_cast<std::size_t>(z)]);
      }
    spread.resize(knots.size(), static_cast<Index>(all.size()));
    spread.setFromTriplets(entries.begin(), entries.end());
    gathered          = spread.transpose();
    inverse_grid_mass = (spread * mass).unaryExpr([](const double m) { return m > 0 ? 1 / m : 0.0; });
  }

  void FineScaleAbsorber::make_fit()
  {
    affine.resize(mass.size(), carriers.dimension + 1);
    affine.col(0).setOnes();
    Vector3d centre = Vector3d::Zero();
    for (Index k = 0; k < mass.size(); ++k)
      centre += mass[k] / mass.sum() * place(k);
    for (Index k = 0; k < mass.size(); ++k)
      affine.row(k).tail(carriers.dimension) = (place(k) - centre).head(carriers.dimension).transpose();
    const Eigen::MatrixXd moments = affine.transpose() * mass.asDiagonal() * affine;
    // What all carriers have in common along an axis (a row of them) says nothing there.
    fit = moments.completeOrthogonalDecomposition().solve(affine.transpose() * mass.asDiagonal());
  }

  CarrierRows FineScaleAbsorber::smooth(const CarrierRows &all) const
  {
    return product(gathered, inverse_grid_mass.asDiagonal() * product(spread, mass.asDiagonal() * all));
  }

  CarrierRows FineScaleAbsorber::smooth_transposed(const CarrierRows &all) const
  {
    return mass.asDiagonal() * product(gathered, inverse_grid_mass.asDiagonal() * product(spread, all));
  }

  CarrierChanges FineScaleAbsorber::forces(const CarrierRows &particles, const CarrierRows &nodes) const
  {
    const Index of_particles = carriers.whole_mass.size(), of_points = carriers.point_mass.size();
    CarrierRows fine(of_particles + of_points, 3);
    fine << particles, product(carriers.weights, nodes);
    fine -= affine * (fit * fine);
    for (int k = 0; k < sharpness; ++k)
      fine -= smooth(fine);
    CarrierRows force           = CarrierRows::Zero(fine.rows(), 3);
    force.topRows(of_particles) = carriers.damping.asDiagonal() * fine.topRows(of_particles);
    for (int k = 0; k < sharpness; ++k)
      force -= smooth_transposed(force);
    force -= fit.transpose() * (affine.transpose() * force);
    return {force.topRows(of_particles), product(points_of_nodes, force.bottomRows(of_points))};
  }

  CarrierChanges
  FineScaleAbsorber::changes(const CarrierRows &particles, const CarrierRows &nodes, const double time) const
  {
    // Explicit sub-steps contract in the norm of the masses up to twice this length.
    const int    steps = std::max(1, static_cast<int>(std::ceil(time * fastest)));
    const double step  = time / steps;
    CarrierRows  p = particles, n = nodes;
    for (int s = 0; s < steps; ++s)
      {
        const CarrierChanges force = forces(p, n);
        p -= step * carriers.inverse_mass.cwiseProduct(force.particles);
        n -= step * carriers.inverse_node_mass.cwiseProduct(force.nodes);
      }
    return {p - particles, n - nodes};
  }

  void FineScaleAbsorber::find_largest_rate()
  {
    // Power iteration from an irregular start; it approaches the largest eigenvalue from below.
    constexpr int    iterations = 40;
    constexpr double margin     = 1.1;
    const auto       irregular  = [](const Index rows, const double phase) {
      CarrierRows start(rows, 3);
      for (Index r = 0; r < rows; ++r)
        for (int c = 0; c < 3; ++c)
          start(r, c) = std::sin(phase + 2.399963 * static_cast<double>(r) + 1.1 * c);
      return start;
    };
    CarrierRows p = irregular(carriers.whole_mass.size(), 0.3), n = irregular(carriers.inverse_node_mass.rows(), 0.7);
    for (int i = 0; i < iterations; ++i)
      {
        const double size = std::sqrt(p.squaredNorm() + n.squaredNorm());
        if (!(size > 0))
          return;
        const CarrierChanges force = forces(p / size, n / size);
        p                          = carriers.inverse_mass.cwiseProduct(force.particles);
        n                          = carriers.inverse_node_mass.cwiseProduct(force.nodes);
        fastest                    = margin * std::sqrt(p.squaredNorm() + n.squaredNorm());
      }
  }
} // namespace coupling

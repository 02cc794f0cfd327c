#include "coupling/volume/absorber.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  namespace
  {
    /** Particles first, then points; the damped momentum of these is not passed on. */
    dem::FineScaleFilter filter_of(const AbsorberParameters &parameters, const AbsorberCarriers &all)
    {
      if (!(parameters.spacing > 0))
        throw base::InputError("Absorber: the spacing of its grid must be above 0 m.");
      if (parameters.sharpness < 1)
        throw base::InputError("Absorber: the sharpness must be 1 at least.");
      if (!(parameters.phase > 0 && parameters.phase < 2))
        throw base::InputError("Absorber: the phase must be above 0 and below 2.");
      dem::FineScaleFilter::Carriers carriers{all.places, {}, {}};
      for (Index k = 0; k < all.whole_mass.size(); ++k)
        {
          carriers.masses.push_back(all.whole_mass[k]);
          carriers.rates.push_back(all.damping[k] / all.whole_mass[k]);
        }
      carriers.places.insert(carriers.places.end(), all.points.begin(), all.points.end());
      carriers.masses.insert(carriers.masses.end(), all.point_mass.data(),
                             all.point_mass.data() + all.point_mass.size());
      carriers.rates.resize(carriers.masses.size(), 0.0);
      return {carriers, parameters.spacing, all.dimension, parameters.sharpness, all.components};
    }
  } // namespace

  FineScaleAbsorber::FineScaleAbsorber(const AbsorberParameters &parameters, AbsorberCarriers given)
    : own(parameters)
    , carriers(std::move(given))
    , points_of_nodes(carriers.weights.transpose())
    , filter(filter_of(parameters, carriers))
    , row_of(filter.order().size())
    , inverse_mass(record * row_of.size(), 0.0)
    , velocity(record * row_of.size(), 0.0)
    , force(record * row_of.size(), 0.0)
  {
    for (std::size_t row = 0; row < row_of.size(); ++row)
      row_of[filter.order()[row]] = record * row;
    for (std::size_t k = 0; k < carriers.places.size(); ++k)
      for (Index c = 0; c < 3; ++c)
        inverse_mass[row_of[k] + static_cast<std::size_t>(c)] = carriers.inverse_mass(static_cast<Index>(k), c);
    find_largest_rate();
  }

  void FineScaleAbsorber::enter(const CarrierRows &particles) const
  {
    for (std::size_t k = 0; k < carriers.places.size(); ++k)
      Eigen::Map<Eigen::RowVector3d>{&velocity[row_of[k]]} = particles.row(static_cast<Index>(k));
  }

  void FineScaleAbsorber::add_entered(CarrierRows &particles) const
  {
    for (std::size_t k = 0; k < carriers.places.size(); ++k)
      particles.row(static_cast<Index>(k)) += row(velocity, k);
  }

  void FineScaleAbsorber::step(const double time, CarrierRows &nodes) const
  {
    const std::size_t of_particles = carriers.places.size();
    at_points.noalias()            = carriers.weights * nodes;
    for (std::size_t k = 0; k < carriers.points.size(); ++k)
      Eigen::Map<Eigen::RowVector3d>{&velocity[row_of[of_particles + k]]} = at_points.row(static_cast<Index>(k));
    filter.damping(velocity, force);
    for (std::size_t i = 0; i < velocity.size(); ++i)
      velocity[i] -= time * inverse_mass[i] * force[i];
    for (std::size_t k = 0; k < carriers.points.size(); ++k)
      at_points.row(static_cast<Index>(k)) = row(force, of_particles + k);
    on_nodes.noalias() = points_of_nodes * at_points;
    nodes -= time * carriers.inverse_node_mass.cwiseProduct(on_nodes);
  }

  CarrierChanges
  FineScaleAbsorber::changes(const CarrierRows &particles, const CarrierRows &nodes, const double time) const
  {
    // Explicit sub-steps contract in the norm of the masses up to twice the time of the largest rate.
    return in_steps(particles, nodes, time, std::max(1, static_cast<int>(std::ceil(time / longest_time()))));
  }

  CarrierChanges FineScaleAbsorber::in_steps(const CarrierRows &particles,
                                             const CarrierRows &nodes,
                                             const double       time,
                                             const int          steps) const
  {
    CarrierChanges change{-particles, nodes};
    enter(particles);
    for (int s = 0; s < steps; ++s)
      step(time / steps, change.nodes);
    add_entered(change.particles);
    change.nodes -= nodes;
    return change;
  }

  void FineScaleAbsorber::find_largest_rate()
  {
    // Power iteration from an irregular start; it approaches the largest eigenvalue from below.
    constexpr int    iterations = 60;
    constexpr double margin     = 1.05;
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
        p /= size;
        n /= size;
        const CarrierChanges force_over_mass = in_steps(p, n, -1, 1);
        p                                    = force_over_mass.particles;
        n                                    = force_over_mass.nodes;
        fastest                              = margin * std::sqrt(p.squaredNorm() + n.squaredNorm());
      }
  }
} // namespace coupling

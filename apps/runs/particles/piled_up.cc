#include "apps/runs/particles/piled_up.h"

#include "apps/forecasts/duration.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/packing/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace apps
{
  namespace
  {
    constexpr double touching = 1 - 1e-6; ///< distance of neighbours over their diameter
    constexpr double far_away = 1.5;      ///< likewise

    /** For each particle. */
    double seconds_per_step_of(dem::Specimen body)
    {
      return seconds_per_step(body, [&](const std::int64_t count) { body.advance(count); }) /
             static_cast<double>(body.counts().particles);
    }

    double mean_radius(const dem::ObservedSpecimen &specimen)
    {
      const std::vector<double> radius = specimen.kinematics().radius;
      return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
    }
  } // namespace

  int LatticeOfParticles::along() const
  {
    const double root = std::pow(static_cast<double>(number), 1.0 / parameters.physics.dimension);
    return std::max(2, static_cast<int>(std::lround(root)));
  }

  dem::Specimen LatticeOfParticles::body(const double distance) const
  {
    const bool   plane   = parameters.physics.dimension == 2;
    dem::Packing packing = dem::make_lattice(plane ? dem::Lattice::square : dem::Lattice::simple_cubic,
                                             distance * radius, {along(), along(), plane ? 1 : along()});
    packing.periodic_cell.reset();
    packing.radius.assign(packing.size(), radius);
    if (materials.several())
      packing.material.assign(packing.size(), 0);
    dem::SpecimenParameters made = parameters;
    made.gravity                 = {0, 0, 0};
    made.loose                   = 0;
    return {packing, made, materials};
  }

  dem::Specimen LatticeOfParticles::piled_up() const
  {
    dem::Specimen made = body(touching);
    if (!ground)
      return made;
    const bool            plane = parameters.physics.dimension == 2;
    const Eigen::Vector3d low(0, 0, 0), high = Eigen::Vector3d::Constant(2 * touching * radius * along());
    dem::BoxSides         there = {true, true, true, true, true, true};
    there[plane ? 3 : 5]        = false; // above
    made.surfaces().add({"box", plane ? dem::rectangle(low, high, there) : dem::box(low, high, there), *ground});
    return made;
  }

  dem::Specimen LatticeOfParticles::apart() const { return body(far_away); }

  double dearer_step_when_piled_up(const ParticlesModel                    &model,
                                   const dem::ObservedSpecimen             &now,
                                   const std::optional<dem::LinkMaterials> &ground)
  {
    constexpr double  of_each = 2.5; // contacts in a pile: two share one
    const dem::Counts counts  = now.counts();
    if (model.bonded() || counts.particles < 2 || model.parameters().gravity.isZero())
      return 0;
    const double             number  = static_cast<double>(counts.particles);
    const double             to_come = std::max(0.0, 1 - static_cast<double>(counts.contacts) / (of_each * number));
    const LatticeOfParticles lattice{model.parameters(), model.material.materials(), counts.particles, mean_radius(now),
                                     ground};
    return to_come * number *
           std::max(0.0, seconds_per_step_of(lattice.piled_up()) - seconds_per_step_of(lattice.apart()));
  }
} // namespace apps

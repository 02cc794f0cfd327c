#include "apps/runs/coupled/sub_cycling_forecast.h"

#include "dem/facets/surface_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace apps
{
  namespace
  {
    struct ImpactLoss
    {
      double duration = 0; ///< [s]
      double part     = 0; ///< of the energy of the approach
    };

    /** Of one particle that meets the solid. @param stiffness of its contact [N/m] */
    ImpactLoss loss_of(const double stiffness, const double mass, const CoupledBody &body)
    {
      const CoupledSteps steps    = body.steps();
      const double       alone    = M_PI * std::sqrt(mass / stiffness); // on a wall: how far waves come meanwhile
      const double       solid    = body.solid_mass_within(alone);
      const double       both     = mass * solid / (mass + solid);
      const double       duration = M_PI * std::sqrt(both / stiffness);
      const double       longer   = steps.particle_steps > 1 ? solid : mass; // of what takes the long step
      const double       lag      = steps.window * (1 - 1.0 / std::max(steps.particle_steps, steps.solid_steps));
      return {duration, 0.5 * M_PI * M_PI * lag / duration * both / longer};
    }
  } // namespace

  std::string sub_cycling_forecast(const CoupledModel &model, CoupledBody &body)
  {
    const CoupledSteps steps = body.steps();
    if (steps.particle_steps == 1 && steps.solid_steps == 1)
      return "";
    const dem::ObservedSpecimen &specimen  = body.particles().specimen();
    const double                 thickness = model.dimension() == 2 ? specimen.parameters().thickness : 0;
    ImpactLoss                   worst;
    for (const CouplingSection &coupling : model.couplings.couplings)
      {
        if (coupling.pressure)
          continue;
        const dem::SurfaceLaw    law(coupling.contact.materials(), specimen.parameters().physics, coupling.name);
        std::vector<std::size_t> members = coupling.particles(body.particles().all_groups());
        if (members.empty())
          {
            members.resize(specimen.counts().particles);
            std::iota(members.begin(), members.end(), std::size_t(0));
          }
        for (const std::size_t i : members)
          {
            const dem::ParticleState p    = specimen.particle(i);
            const double             area = thickness > 0 ? 2 * p.radius * thickness : M_PI * p.radius * p.radius;
            // Of a law that stiffens: at an overlap of a hundredth of the radius.
            const dem::FacePressure pressed =
              law.press({p.radius, area, 1, 0.01 * p.radius, 0.01 * p.radius}, law.begin(p.radius, area, p.mass));
            const ImpactLoss found = loss_of(pressed.stiffness, p.mass, body);
            if (found.part > worst.part)
              worst = found;
          }
      }
    if (!(worst.part > 0))
      return "";
    const double allowed = model.sub_cycling_loss;
    return fmt::format(
      "  sub-cycling  with such windows an impact of {:.3g} s would lose about {:.2g} of its energy; {}\n",
      worst.duration, std::min(1.0, worst.part),
      worst.part > allowed ?
        fmt::format("they are made shorter, so that {:g} of the largest energy is lost at most", allowed) :
        fmt::format("{:g} of the largest energy may be lost", allowed));
  }
} // namespace apps

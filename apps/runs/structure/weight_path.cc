#include "apps/runs/structure/weight_path.h"

#include "apps/results/run_work.h"
#include "base/errors.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    dem::QuasiStaticParameters while_put_on(dem::QuasiStaticParameters p)
    {
      p.sign        = 1;
      p.strain_step = p.end_strain = 1; // all at once, unless bonds are damaged
      p.end_stress                 = 0;
      p.leading.reset();
      return p;
    }

    /** What the first part of the weight, so small that nothing is damaged, leaves over of itself once the links have answered. */
    double left_over(const dem::LoadedNetwork         &network,
                     const dem::LinkMaterials         &materials,
                     const dem::QuasiStaticParameters &p)
    {
      constexpr double   little = 1e-6;
      dem::TangentSystem system(network, {p.solver, p.ranks, p.tolerance});
      dem::DamagingLinks links(network, materials);
      dem::LoadedMotion  motion(network.held.size());
      const auto         unbalanced = [&] {
        links.evaluate(motion);
        return dem::unbalanced_of(network, motion, links.forces(), links.moments(), system.length_scale());
      };
      motion.loads[network.driven] = little;
      dem::TangentSystem::Answer answer;
      const dem::Unbalanced      start = unbalanced();
      if (!system.solve(links.stiffness(dem::LinkStiffness::consistent), start, answer))
        return start.residual;
      motion.particles += answer.constant.particles;
      motion.loads += answer.constant.loads;
      return unbalanced().residual;
    }
  } // namespace

  WeightPath::WeightPath(const dem::LoadedNetwork         &whole,
                         const dem::LinkMaterials         &materials,
                         const dem::QuasiStaticParameters &along,
                         const bool                        released)
    : network(dem::with_load_put_on(whole, released))
    , path(network, materials, while_put_on(along))
  {
    constexpr double much = 1e-2;
    if (left_over(network, materials, along) > much)
      throw base::InputError(std::string("Gravity: nothing holds the structure against its weight") +
                             (released ? ", as what is driven bears nothing of it" : "") + ". Hold more of it.");
  }

  void WeightPath::advance()
  {
    const double before  = part();
    const auto   refusal = [before](const char *why) {
      return fmt::format("Gravity: the structure does not bear its weight: at {:.3g} of it {}.", before, why);
    };
    try
      {
        path.advance();
      }
    catch (const base::NumericalError &)
      {
        throw base::NumericalError(refusal("it breaks, and finds no equilibrium any more"));
      }
    if (part() < before)
      throw StoppedShort(refusal("cracks go on by themselves"));
  }
} // namespace apps

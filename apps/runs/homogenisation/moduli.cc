#include "apps/runs/homogenisation/moduli.h"

#include "apps/specimens/specimen_packing.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "dem/homogenisation/resisted_strains.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    bool lies_in_a_plane(const dem::Packing &packing)
    {
      return std::all_of(packing.centre.begin(), packing.centre.end(),
                         [&](const auto &c) { return c[2] == packing.centre.front()[2]; });
    }

    void
    refuse_unsuitable(const dem::Packing &packing, const HomogenisationQuestion &question, const std::string &origin)
    {
      const int   dimension = question.links.dimension;
      const auto &m         = packing.material;
      if (!question.materials &&
          std::any_of(m.begin(), m.end(), [&](const std::int32_t number) { return number != m.front(); }))
        throw base::InputError(origin + ": its particles are of several materials, and all links get one modulus here. "
                                        "Name a scene that has these materials (--materials SCENE.prm).");
      if (!packing.periodic_cell)
        throw base::InputError(origin +
                               ": not a periodic packing, so that its stiffness would depend on how its surface is "
                               "held. Give one with a periodic cell, e.g. made by \"breccia pack\".");
      const bool plane = lies_in_a_plane(packing);
      if (dimension == 3 && plane && packing.size() > 1)
        throw base::InputError(origin +
                               ": all centres lie in one plane. For discs give their thickness (--thickness).");
      if (dimension == 2 && !plane)
        throw base::InputError(origin +
                               ": discs of a thickness are requested, but the centres do not lie in one plane z. "
                               "Leave the thickness out for spheres.");
    }

    /** Constants of a stiffness that resists so many strains. */
    FoundStiffness found(const dem::MacroscopicStiffness &stiffness, const int resisted, const int dimension)
    {
      if (resisted < dem::strains_of(dimension))
        return {stiffness, std::nullopt, resisted};
      return {stiffness, dem::isotropy_measures(stiffness, dimension).mean, resisted};
    }

    FoundStiffness found_affine(const dem::ElasticNetwork &network)
    {
      const dem::MacroscopicStiffness bound     = dem::affine_stiffness(network);
      dem::MacroscopicStiffness       stiffness = bound;
      const int                       resisted  = dem::remove_unresisted(stiffness, bound, network.dimension);
      return found(stiffness, resisted, network.dimension);
    }

    /**
     * A residual squared is the error of a stiffness, and a loose tolerance would pass that error off as the stiffness of a cell that
     * hardly resists. Whether it resists at all is therefore decided at the usual tolerance.
     */
    dem::RelaxedStiffness
    relax(const dem::ElasticNetwork &network, dem::SolverParameters parameters, const FoundStiffness &affine)
    {
      constexpr double      doubtful = 1e-2;
      const double          usual    = dem::SolverParameters().tolerance;
      dem::RelaxedStiffness relaxed  = dem::relaxed_stiffness(network, parameters);
      const bool soft = relaxed.stiffness.diagonal().maxCoeff() < doubtful * affine.stiffness.diagonal().maxCoeff();
      if (!relaxed.solver.converged || parameters.tolerance <= usual || !soft)
        return relaxed;
      parameters.tolerance = usual;
      return dem::relaxed_stiffness(network, parameters);
    }
  } // namespace

  HomogenisationAnswer
  homogenise(const dem::Packing &packing, const HomogenisationQuestion &question, const std::string &origin)
  {
    const base::Stopwatch watch;
    const auto           &links = question.links;
    refuse_unsuitable(packing, question, origin);
    const dem::ElasticNetwork network =
      question.materials ? dem::make_network(packing, links, *question.materials) : dem::make_network(packing, links);
    // Alike links have the given constants, to the last bit.
    const dem::LinkModuli mean           = question.materials ? dem::mean_moduli(network) : dem::LinkModuli();
    const double          normal_modulus = question.materials ? mean.normal : links.normal_modulus,
                 shear_ratio             = question.materials ? mean.shear / mean.normal : links.shear_ratio;

    HomogenisationAnswer answer;
    answer.dimension  = links.dimension;
    answer.particles  = network.particles();
    answer.links      = network.links.size();
    answer.density    = dem::link_statistics(network);
    answer.statistics = {dem::closed_form_stiffness(answer.density, normal_modulus, shear_ratio),
                         dem::closed_form(answer.density, normal_modulus, shear_ratio),
                         dem::strains_of(links.dimension)};
    answer.affine     = found_affine(network);

    const dem::RelaxedStiffness relaxed = relax(network, question.solver, answer.affine);
    answer.solver                       = relaxed.solver;
    if (!relaxed.solver.converged)
      throw base::NumericalError(fmt::format(
        "homogenisation: residual {:.2e} after {} iterations, required {:.2e}. {} Raise the tolerance or the "
        "interaction ratio, or choose the direct solver.",
        relaxed.solver.residual, relaxed.solver.iterations, question.solver.tolerance,
        dem::describe(relaxed.solver.mechanisms)));
    answer.relaxed = found(relaxed.stiffness, relaxed.resisted, links.dimension);
    if (answer.relaxed.constants)
      answer.isotropy = dem::isotropy_measures(relaxed.stiffness, links.dimension);
    answer.seconds = watch.seconds();
    return answer;
  }

  dem::Packing
  packing_like(const dem::Packing &packing, const double friction, const std::uint64_t seed, const std::string &origin)
  {
    const auto [smallest, largest] = std::minmax_element(packing.radius.begin(), packing.radius.end());
    if (*largest > *smallest * (1 + 1e-9))
      throw base::InputError(
        fmt::format("{}: radii from {:.6g} to {:.6g} m; other seeds are made of equal spheres only. "
                    "Homogenise packings of your own one by one.",
                    origin, *smallest, *largest));
    dem::CompactionParameters parameters;
    parameters.radius   = *largest;
    parameters.count    = packing.size();
    parameters.friction = friction;
    parameters.seed     = seed;
    return compact_with_progress(parameters).packing;
  }
} // namespace apps

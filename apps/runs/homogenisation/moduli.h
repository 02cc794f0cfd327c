#pragma once

#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace apps
{
  /** The question of `breccia homogenise` about one packing. */
  struct HomogenisationQuestion
  {
    dem::NetworkParameters links;
    dem::SolverParameters  solver;
    std::optional<dem::LinkMaterials>
      materials; ///< law of the links, of each pair of materials; none: `links` has moduli
  };

  /** Stiffness found in one way, and the constants read from it. */
  struct FoundStiffness
  {
    dem::MacroscopicStiffness stiffness; ///< [Pa]
    std::optional<dem::ElasticConstants>
        constants;    ///< none where some strain is not resisted: there are no moduli then
    int resisted = 0; ///< how many independent strains are
  };

  /** The three answers, and what they rest on. */
  struct HomogenisationAnswer
  {
    int                                  dimension = 3;
    std::size_t                          particles = 0, links = 0;
    dem::LinkStatistics                  density;
    FoundStiffness                       statistics; ///< closed form: links of every direction alike
    FoundStiffness                       affine;     ///< actual links, all particles moved alike: an upper bound
    FoundStiffness                       relaxed;    ///< particles in equilibrium: the answer
    std::optional<dem::IsotropyMeasures> isotropy;   ///< of the relaxed stiffness; none where it has no constants
    dem::SolverReport                    solver;
    double                               seconds = 0; ///< from the packing to all three answers
  };

  /** One of the three answers by its name. */
  struct HomogenisationWay
  {
    const char    *name, *meaning;
    FoundStiffness HomogenisationAnswer::*found;
  };
  inline constexpr std::array<HomogenisationWay, 3> homogenisation_ways = {
    {{"statistics", "closed form, no preferred direction", &HomogenisationAnswer::statistics},
     {"affine", "actual links, upper bound", &HomogenisationAnswer::affine},
     {"relaxed", "in equilibrium, the answer", &HomogenisationAnswer::relaxed}}};

  /**
   * @param origin of the packing, for messages
   * A cell that does not resist every strain has an answer too: its stiffness, zero in those strains, without constants.
   * @throws base::InputError if the packing does not repeat, or lies in a plane while links in space are requested;
   *         base::NumericalError if the required residual is not reached.
   */
  HomogenisationAnswer
  homogenise(const dem::Packing &packing, const HomogenisationQuestion &question, const std::string &origin);

  /**
   * Another packing like a given one: as many spheres of the same radius in a periodic cell, compacted anew.
   * @param friction between the spheres while compacted @throws base::InputError if the spheres are not equal
   */
  dem::Packing
  packing_like(const dem::Packing &packing, double friction, std::uint64_t seed, const std::string &origin);
} // namespace apps

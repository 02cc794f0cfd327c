#pragma once

#include "dem/specimen/results.h"

#include <cstddef>
#include <functional>
#include <vector>

/**
 * How a specimen is read that several ranks share (Specimen::share_among()) without any of them having, or being given, all of it
 * (doc/theory/ranks.md, 3): each reads what it has and tells the first what that asks for, some lines at a time. All ranks make these calls, in the
 * same order; of one process they are readings as others.
 */
namespace dem
{
  class ObservedSpecimen;

  /** Of ObservedSpecimen::particles() what each rank knows of all by itself: radius, held, volume, broken_links and material. */
  ParticleOutput lasting_particles(const ObservedSpecimen &specimen);
  /** On the first rank these and position and displacement, on others nothing. */
  ParticleOutput placed_particles_for_first(const ObservedSpecimen &specimen);
  /** And damage. */
  ParticleOutput particles_for_first(const ObservedSpecimen &specimen);
  /** On the first rank all of ObservedSpecimen::particles(), on others nothing. */
  ParticleOutput all_particles_for_first(const ObservedSpecimen &specimen);
  /** On the first rank of each particle xx yy zz yz xz xy of its stress, symmetric [Pa]; on others nothing. */
  std::vector<double> stress_for_first(const ObservedSpecimen &specimen);

  /** What a rank says of a link, by its place among some: any numbers, or none. It is not asked of glue. */
  using TellOfLink = std::function<void(const LinkOutput &some, std::size_t l, std::vector<double> &numbers)>;
  /** The first rank takes what is said of links, in the order of ObservedSpecimen::links(); called several times. */
  using TakeOfLinks = std::function<void(const std::vector<double> &numbers)>;
  void tell_first_of_links(const ObservedSpecimen &specimen, const TellOfLink &tell, const TakeOfLinks &take);

  /** Is shown some links at a time, in their order, without glue: their ends, kinds and branches. */
  using SeeLinks = std::function<void(const LinkOutput &some)>;
  /**
   * On the first rank ObservedSpecimen::links() without what files for ParaView do not show: loads, strength_damage and dissipated are empty. On
   * others nothing.
   * @param see called on the first; all ranks give one, or none does
   */
  LinkOutput shown_links_for_first(const ObservedSpecimen &specimen, const SeeLinks &see = {});

  /** Bonds that are damaged, and broken links, on the first rank: ends, kind, pair, damage, branches; and all glue. The other columns are empty. */
  LinkOutput damaged_links_for_first(const ObservedSpecimen &specimen);

  /**
   * Go through ObservedSpecimen::links() in their order, some at a time, each rank through its own; without glue.
   * @param numbers go from rank to rank with them: what is added up in them has the bits that it has on one rank, and all ranks have it then
   */
  void add_up_links(const ObservedSpecimen                        &specimen,
                    std::vector<double>                           &numbers,
                    const std::function<void(const LinkOutput &)> &use);
} // namespace dem

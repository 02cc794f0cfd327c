#include "dem/contacts/deepest_overlap.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    void measure_overlap(const Particles &particles, const LinkSet &links, const std::size_t l, DeepestOverlap &deepest)
    {
      const std::int32_t first = links.first[l], second = links.second[l];
      const double       J = particles.radius_of(first), K = particles.radius_of(second);
      const double       without_force = std::min(links.reference_length[l], J + K);
      const double       depth         = (without_force - branch_of(particles, links, l).norm()) / std::min(J, K);
      if (depth > deepest.depth)
        deepest = {depth, first, second};
    }
  } // namespace

  DeepestOverlap deepest_overlap(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts)
  {
    DeepestOverlap deepest;
    find_deeper_contact(particles, contacts, all_lines(contacts), deepest);
    find_deeper_bond(particles, bonds, all_lines(bonds), deepest);
    return deepest;
  }

  void find_deeper_contact(const Particles &particles,
                           const LinkSet   &contacts,
                           const LinkRange &lines,
                           DeepestOverlap  &deepest)
  {
    each_living(contacts, lines, [&](const std::size_t l) { measure_overlap(particles, contacts, l, deepest); });
  }

  void
  find_deeper_bond(const Particles &particles, const LinkSet &bonds, const LinkRange &lines, DeepestOverlap &deepest)
  {
    if (bonds.logs_breaks)
      each_living(bonds, lines, [&](const std::size_t l) {
        if (bonds.is_broken(l) && particles.cut_between(bonds.first[l], bonds.second[l]) == nullptr)
          measure_overlap(particles, bonds, l, deepest);
      });
  }
} // namespace dem

#pragma once

#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Call use(column, numbers of a line) for what only those need of a set who update its links; all others know which there are. */
  template <typename Links, typename Use>
  void each_column_of_state(Links &links, const Use &use)
  {
    use(links.reference_length, std::size_t{1});
    use(links.area, std::size_t{1});
    for (auto &column : links.history)
      use(column, std::size_t{1});
    use(links.force, std::size_t{record_size});
    if (links.moments_apart)
      use(links.moment, std::size_t{half_record_size});
  }

  /** How many numbers a line of such a column has; 0 of another column. */
  inline std::size_t numbers_of_state(const LinkSet &links, const base::Column &column)
  {
    std::size_t found = 0;
    each_column_of_state(links, [&](const base::Column &each, const std::size_t numbers) {
      if (&each == &column)
        found = numbers;
    });
    return found;
  }

  /** Records of particles that only those need who update links that end in them. */
  template <typename Of>
  auto records_of_places(Of &particles)
  {
    return std::vector{&particles.pose, &particles.motion};
  }

  /** Records of particles that only those need who move them. */
  template <typename Of>
  auto records_of_motion(Of &particles)
  {
    return std::vector{&particles.velocity, &particles.force, &particles.inverse_mass};
  }

  /** Both. */
  template <typename Of>
  auto records_of_state(Of &particles)
  {
    auto       all   = records_of_places(particles);
    const auto other = records_of_motion(particles);
    all.insert(all.end(), other.begin(), other.end());
    return all;
  }

  /** Memory that particles and links take up in this process at present [B]. */
  std::size_t resident_bytes(const Particles &particles, const std::vector<const LinkSet *> &sets);
} // namespace dem

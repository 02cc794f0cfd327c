#include "dem/peridynamics/mixture.h"

#include "dem/model/materials.h"

#include <algorithm>

namespace dem::peridynamics
{
  namespace
  {
    std::size_t pair_of(const std::size_t one, const std::size_t other)
    {
      return static_cast<std::size_t>(material_pair(static_cast<std::int32_t>(one), static_cast<std::int32_t>(other)));
    }
  } // namespace

  PairConstants in_series(const Material &one, const Material &other)
  {
    PairConstants pair;
    const double  a = one.young_modulus, b = other.young_modulus;
    // Not computed where both are alike: the bonds of one material have its constants to the last bit.
    pair.young_modulus    = a == b ? a : 2 * a * b / (a + b);
    pair.critical_stretch = a == b ?
                              std::min(one.critical_stretch, other.critical_stretch) :
                              std::min(a * one.critical_stretch, b * other.critical_stretch) / pair.young_modulus;
    return pair;
  }

  Mixture::Mixture(const Material &material)
    : materials{material}
    , pairs{in_series(material, material)}
  {
  }

  Mixture::Mixture(const std::vector<Material> &several, const std::vector<std::int32_t> &of_places)
    : materials(several)
    , of(of_places)
  {
    for (std::size_t one = 0; one < materials.size(); ++one)
      for (std::size_t other = 0; other <= one; ++other)
        pairs.push_back(in_series(materials[one], materials[other]));
  }

  const Material &Mixture::at(const std::size_t place) const
  {
    return materials[of.empty() ? 0 : static_cast<std::size_t>(of[place])];
  }

  PairConstants &Mixture::between(const std::size_t one, const std::size_t other) { return pairs[pair_of(one, other)]; }

  std::size_t Mixture::pair_at(const std::size_t place, const std::size_t other) const
  {
    return of.empty() ? 0 : pair_of(static_cast<std::size_t>(of[place]), static_cast<std::size_t>(of[other]));
  }

  double Mixture::largest_modulus() const
  {
    double most = 0;
    for (const PairConstants &pair : pairs)
      most = std::max(most, pair.young_modulus);
    return most;
  }
} // namespace dem::peridynamics

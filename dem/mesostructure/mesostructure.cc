#include "dem/mesostructure/mesostructure.h"

#include <cmath>

namespace dem
{
  using Eigen::Vector3d;

  double Mesostructure::content() const
  {
    double volume = 0;
    for (const Inclusion &one : inclusions)
      volume += one.volume();
    return volume / box.prod();
  }

  namespace
  {
    /** Whether a place, or an image of it, lies in an aggregate. */
    bool holds(const Mesostructure &m, const Inclusion &one, const Vector3d &place, const double inset)
    {
      Vector3d x = place;
      if (m.periodic)
        for (int d = 0; d < 3; ++d)
          x[d] -= m.box[d] * std::round((x[d] - one.centre[d]) / m.box[d]);
      return (x - one.centre).squaredNorm() <= one.reach() * one.reach() && one.depth(x) >= inset;
    }
  } // namespace

  std::vector<std::int32_t> aggregates_at(const Mesostructure         &mesostructure,
                                          const std::vector<Vector3d> &places,
                                          const std::vector<double>   &inset)
  {
    std::vector<std::int32_t> numbers(places.size(), in_mortar);
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t a = 0; a < mesostructure.inclusions.size() && numbers[i] == in_mortar; ++a)
        if (holds(mesostructure, mesostructure.inclusions[a], places[i], inset.empty() ? 0 : inset[i]))
          numbers[i] = static_cast<std::int32_t>(a);
    return numbers;
  }

  std::vector<std::int32_t> aggregates_of(const Mesostructure &mesostructure, const Packing &packing)
  {
    std::vector<double> inset(packing.radius);
    for (double &depth : inset)
      depth *= 0.5;
    return aggregates_at(mesostructure, packing.centre, inset);
  }
} // namespace dem

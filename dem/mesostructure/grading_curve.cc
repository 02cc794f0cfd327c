#include "dem/mesostructure/grading_curve.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace dem
{
  namespace
  {
    constexpr double rounding = 1e-6; ///< of parts that laboratories print

    [[noreturn]] void refuse(const std::size_t number, const std::string &why)
    {
      throw base::InputError("Grading: sieve " + std::to_string(number + 1) + ": " + why);
    }

    /** Numbers of the sieves from fine to coarse. */
    std::vector<std::size_t> ascending(const std::vector<SievePart> &sieves)
    {
      if (sieves.size() < 2)
        throw base::InputError("Grading: a curve has two sieves at least.");
      for (std::size_t i = 0; i < sieves.size(); ++i)
        {
          if (!(sieves[i].size > 0 && std::isfinite(sieves[i].size)))
            refuse(i, "a size of " + base::number_text(sieves[i].size) + " m: must be above 0.");
          if (!(sieves[i].part >= 0 && sieves[i].part <= 1 + rounding))
            refuse(i, base::number_text(sieves[i].part) + " of the solid: must be in [0, 1].");
        }
      std::vector<std::size_t> order(sieves.size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::stable_sort(order.begin(), order.end(),
                       [&](const std::size_t a, const std::size_t b) { return sieves[a].size < sieves[b].size; });
      for (std::size_t k = 1; k < order.size(); ++k)
        if (sieves[order[k]].size == sieves[order[k - 1]].size)
          refuse(order[k], "the same size as sieve " + std::to_string(order[k - 1] + 1) + ".");
      return order;
    }
  } // namespace

  GradingCurve GradingCurve::of_passing(const std::vector<SievePart> &passing)
  {
    const std::vector<std::size_t> order = ascending(passing);
    std::vector<SievePart>         curve;
    for (std::size_t k = 0; k < order.size(); ++k)
      {
        curve.push_back(passing[order[k]]);
        if (k > 0 && curve[k].part < curve[k - 1].part)
          refuse(order[k], "less passes than the finer sieve " + std::to_string(order[k - 1] + 1) + ".");
      }
    if (!(std::abs(curve.back().part - 1) <= rounding))
      refuse(order.back(),
             base::number_text(curve.back().part) + " of the solid passes the coarsest sieve: must be 1, or 100 %.");
    curve.back().part = 1;
    return GradingCurve(std::move(curve));
  }

  GradingCurve GradingCurve::of_retained(const std::vector<SievePart> &retained)
  {
    const std::vector<std::size_t> order = ascending(retained);
    if (retained[order.back()].part > rounding)
      refuse(order.back(), base::number_text(retained[order.back()].part) +
                             " of the solid lies on the coarsest sieve, and nothing says how coarse it is. Add the "
                             "size that all passes, with 0.");
    std::vector<SievePart> curve(order.size());
    double                 coarser = 0; // than the sieve
    for (std::size_t k = order.size(); k-- > 0;)
      {
        coarser += retained[order[k]].part;
        curve[k] = {retained[order[k]].size, std::max(0.0, 1 - coarser)};
      }
    if (coarser > 1 + rounding)
      throw base::InputError("Grading: what lies on the sieves sums up to " + base::number_text(coarser) +
                             ": must be 1, or 100 %, at most.");
    return GradingCurve(std::move(curve));
  }

  GradingCurve
  GradingCurve::fuller(const double smallest, const double largest, const double exponent, const std::size_t classes)
  {
    if (!(smallest > 0 && largest > smallest && std::isfinite(largest)))
      throw base::InputError("Grading: Fuller's curve from " + base::number_text(smallest) + " to " +
                             base::number_text(largest) + " m: sizes must ascend from above 0.");
    if (!(exponent > 0 && exponent <= 2))
      throw base::InputError("Grading: exponent of Fuller's curve = " + base::number_text(exponent) +
                             ": must be in (0, 2].");
    std::vector<SievePart> curve;
    for (std::size_t k = 0; k <= classes; ++k)
      {
        const double part = static_cast<double>(k) / static_cast<double>(classes);
        const double size = k == classes ? largest : smallest * std::pow(largest / smallest, part);
        curve.push_back({size, std::pow(size / largest, exponent)});
      }
    return GradingCurve(std::move(curve));
  }

  double GradingCurve::passing(const double size) const
  {
    if (size <= smallest())
      return sieves.front().part;
    if (size >= largest())
      return sieves.back().part;
    const auto high = std::upper_bound(sieves.begin(), sieves.end(), size,
                                       [](const double d, const SievePart &sieve) { return d < sieve.size; });
    const auto low  = high - 1;
    return low->part + (high->part - low->part) * std::log(size / low->size) / std::log(high->size / low->size);
  }
} // namespace dem

#include "dem/emission/frequency_law.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dem
{
  namespace
  {
    constexpr int classes_of_one = 10; // of magnitudes, in a unit

    /** The lower end of the class with most magnitudes; of several with as many, of the lowest. */
    double most_frequent(const std::vector<double> &magnitudes)
    {
      std::map<long, std::size_t> in_class;
      for (const double magnitude : magnitudes)
        ++in_class[std::lround(std::floor(magnitude * classes_of_one))];
      const auto most = std::max_element(in_class.begin(), in_class.end(),
                                         [](const auto &a, const auto &b) { return a.second < b.second; });
      return static_cast<double>(most->first) / classes_of_one;
    }
  } // namespace

  std::optional<FrequencyLaw> frequency_law(const std::vector<double> &magnitudes)
  {
    if (magnitudes.empty())
      return {};
    FrequencyLaw found;
    found.completeness = most_frequent(magnitudes);
    std::vector<double> heard;
    std::copy_if(magnitudes.begin(), magnitudes.end(), std::back_inserter(heard),
                 [&](const double magnitude) { return magnitude >= found.completeness; });
    found.events      = heard.size();
    const auto n      = static_cast<double>(found.events);
    double     excess = 0, scatter = 0; // mean above the completeness, and sum of squares about it
    for (const double magnitude : heard)
      excess += (magnitude - found.completeness) / n;
    for (const double magnitude : heard)
      scatter += std::pow(magnitude - found.completeness - excess, 2);
    const auto [least, most] = std::minmax_element(heard.begin(), heard.end());
    if (found.events < fewest_events_of_law || *least == *most)
      return {};
    found.b     = 1 / (std::log(10.0) * excess);
    found.error = std::log(10.0) * found.b * found.b * std::sqrt(scatter / (n * (n - 1)));
    return found;
  }
} // namespace dem

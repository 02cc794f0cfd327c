#include "apps/statistics/references.h"

#include "apps/statistics/distributions.h"

#include <string>

namespace statistics
{
  namespace
  {
    std::string text_of(const double value)
    {
      std::string text = std::to_string(value);
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.')
        text.pop_back();
      return text;
    }

    std::string name_of_f(const double x, const double of, const double over)
    {
      return "F = " + text_of(x) + " of " + text_of(of) + " and " + text_of(over);
    }

    std::string name_of_t(const double x, const double degrees)
    {
      return "t = " + text_of(x) + " of " + text_of(degrees);
    }

    struct OfF
    {
      double x, degrees, error_degrees, value, digits;
    };

    struct OfT
    {
      double x, degrees, value, digits;
    };

    /** To the digits that tables print. */
    void printed_limits(base::Comparisons &rows)
    {
      for (const OfF &f : {OfF{0.05, 2, 35, 3.26742, 5e-6},
                           {0.01, 2, 35, 5.26794, 5e-6},
                           {0.05, 2, 37, 3.252, 5e-4},
                           {0.05, 4, 20, 2.866, 5e-4},
                           {0.01, 10, 10, 4.849, 5e-4}})
        rows
          .of("F exceeded with " + text_of(f.x) + " of " + text_of(f.degrees) + " and " + text_of(f.error_degrees), "",
              f_limit(f.x, f.degrees, f.error_degrees))
          .within_margin(f.digits, f.value);
      for (const OfT &t :
           {OfT{0.025, 1, 12.706, 5e-4}, {0.025, 10, 2.228, 5e-4}, {0.005, 30, 2.750, 5e-4}, {0.05, 120, 1.658, 5e-4}})
        rows.of("t exceeded with " + text_of(t.x) + " of " + text_of(t.degrees), "", t_limit(t.x, t.degrees))
          .within_margin(t.digits, t.value);
    }

    void probabilities(base::Comparisons &rows)
    {
      constexpr double ten_digits = 1e-10;
      for (const OfF &f : {OfF{31.3257, 2, 35, 1.5915397161731136e-08, ten_digits},
                           {2.468, 3, 4, 0.2016273181585798, ten_digits},
                           {0.183, 20, 5, 0.9975046891585464, ten_digits},
                           {1.0, 7, 13, 0.4732108395323182, ten_digits},
                           {4.5, 12, 60, 4.053759606718197e-05, ten_digits},
                           {0.3, 1, 1, 0.6809942799600229, ten_digits}})
        rows
          .of("probability above " + name_of_f(f.x, f.degrees, f.error_degrees), "",
              f_probability_above(f.x, f.degrees, f.error_degrees))
          .within(f.digits, f.value);
      for (const OfT &t : {OfT{1.96, 3, 0.14485220856485362, ten_digits},
                           {15.3, 34, 8.224165312241963e-17, ten_digits},
                           {0.5, 57, 0.6189999472049581, ten_digits},
                           {4, 25, 0.0004954436705320874, ten_digits}})
        rows.of("probability beyond " + name_of_t(t.x, t.degrees), "", t_probability_beyond(t.x, t.degrees))
          .within(t.digits, t.value);
    }

    void half_normal(base::Comparisons &rows)
    {
      rows.of("quantile of 0.5", "", half_normal_quantile(0.5)).within(1e-10, 0.6744897501960817);
      rows.of("quantile of 0.95", "", half_normal_quantile(0.95)).within(1e-10, 1.959963984540054);
    }
  } // namespace

  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"statistics: limits of F and t", "printed tables of five and one percent", printed_limits},
      {"statistics: probabilities of F and t", "scipy.stats 1.10, f.sf and t.sf", probabilities},
      {"statistics: half-normal quantiles", "printed tables", half_normal}};
    return all;
  }
} // namespace statistics

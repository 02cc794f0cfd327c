#include "apps/bench/beygi_mixes.h"

namespace apps::beygi
{
  MixSection Mix::section(MixSection base) const
  {
    constexpr double aggregate = 2590, limits[] = {4.75e-3, 9.5e-3, 12.5e-3, 19e-3}; // [kg/m^3], [m]
    base.constituents = {{"cement", cement, 3100, false, 0, 0},
                         {"water", water, 1000, false, 0, 0},
                         {"plasticiser", plasticiser, 1000, false, 0, 0},
                         {"sand and powder", 1122, aggregate, true, 0, 0}};
    for (std::size_t c = 0; c < coarse.size(); ++c)
      if (coarse[c] > 0)
        base.constituents.push_back(
          {"gravel " + std::to_string(c + 1), coarse[c], aggregate, true, limits[c], limits[c + 1]});
    base.grading     = MixSection::Grading::constituents;
    base.content     = 0;
    base.air         = 0;
    base.unit_weight = unit_weight;
    base.smallest    = limits[0];
    base.increment   = increment;
    return base;
  }

  // The cement of the low strength is 352.8 kg: 325.8, as its table prints it, would not give the water-cement ratio.
  const std::vector<Mix> &mixes()
  {
    static const std::vector<Mix> all = {
      {"l-9.5", false, 352.8, 187.0, 4.4, {750, 0, 0}, 2318, 5.475e-6, {1, 1, 1, 1}, {1, 1, 1, 1}},
      {"l-12.5",
       false,
       352.8,
       187.0,
       4.4,
       {300, 450, 0},
       2408,
       13.0e-6,
       {1.103, 0.967, 1.175, 1.106},
       {1.049, 1.006, 1.045, 1.111}},
      {"l-19",
       false,
       352.8,
       187.0,
       4.4,
       {300, 300, 150},
       2428,
       12.8e-6,
       {1.149, 0.935, 1.257, 1.344},
       {1.060, 0.992, 1.053, 1.295}},
      {"h-9.5", true, 422.4, 160.7, 9.0, {750, 0, 0}, 2399, 5.40e-6, {1, 1, 1, 1}, {}},
      {"h-12.5", true, 422.4, 160.7, 9.0, {300, 450, 0}, 2448, 13.0e-6, {1.023, 0.965, 1.013, 1.121}, {}},
      {"h-19", true, 422.4, 160.7, 9.0, {300, 300, 150}, 2462, 13.0e-6, {1.036, 0.856, 1.054, 1.333}, {}}};
    return all;
  }

  const Mix &Mix::reference() const { return mixes()[high ? 3 : 0]; }

  std::optional<Band> band_of(const Mix &mix, const double ductility, const Property property)
  {
    constexpr Ratios apart = {0.06, 0.06, 0.06, 0.25};
    if (&mix == &mix.reference() || ductility != simulated_ductility || !(mix.simulated[property] > 0))
      return std::nullopt;
    return Band{mix.simulated[property] - apart[property], mix.simulated[property] + apart[property]};
  }

  bool right_trend(const Property property, const double ratio)
  {
    constexpr double flat = 0.01;
    return property == tension ? ratio <= 1 + flat : ratio > 1;
  }

  std::string judgement(const Mix &mix, const double ductility, const Property property, const double ratio)
  {
    if (&mix == &mix.reference())
      return "";
    const std::optional<Band> band = band_of(mix, ductility, property);
    std::string               said = !band ? "" : band->holds(ratio) ? "within" : "outside";
    if (!right_trend(property, ratio))
      said += said.empty() ? "against the trend" : ", against the trend";
    return said;
  }
} // namespace apps::beygi

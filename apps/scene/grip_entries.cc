#include "apps/scene/grip_entries.h"

#include "apps/scene/value_text.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    constexpr const char *nominal = "nominal";
  } // namespace

  void GripEntries::declare(Section &loading, const std::function<bool()> &gripped, const std::string &words)
  {
    const auto asked = [gripped](Entry &entry, const std::string &condition) {
      if (gripped)
        entry.only_if(gripped, condition);
    };
    asked(loading.number("Grip thickness", thickness, "m", Range::positive(), Need::required)
            .means("A grip holds the particles whose centre is within this of the specimen's outermost centre; 2.2 "
                   "radii hold about one complete layer"),
          words);
    asked(loading.text("Area", area, Need::optional)
            .means("Section that stresses refer to: nominal, or a number [m^2]. Nominal: seen along the axis, the "
                   "rectangle around all particles, or the circle around them where that is smaller (a cylinder); in "
                   "the plane width times thickness"),
          words);
    asked(loading
            .choice("Gauge length", gauge,
                    {{"inner faces", dem::Gauge::inner_faces},
                     {"outermost centres", dem::Gauge::outermost_centres},
                     {"planes", dem::Gauge::planes}},
                    Need::optional)
            .means("Length that strains refer to. inner faces: between the innermost centres that the grips hold, all "
                   "that can strain; outermost centres: from end to end, as published tests have it (E then depends on "
                   "the grips); planes: strain is measured between two planes of your own, as by an extensometer, "
                   "while rates and the stop strain refer to the inner faces"),
          words);
    const auto between = [this, gripped] { return gauge == dem::Gauge::planes && (!gripped || gripped()); };
    loading.number("Gauge low plane", low_plane, "m", Range(), Need::required)
      .means("Place of the first plane along the axis")
      .only_if(between, "Gauge length = planes");
    loading.number("Gauge high plane", high_plane, "m", Range(), Need::required)
      .means("Place of the second plane along the axis")
      .only_if(between, "Gauge length = planes");
  }

  void GripEntries::check(const base::EntryPath &loading) const
  {
    const auto number = number_in(trimmed(area));
    if (trimmed(area) != nominal && !(number && *number > 0))
      loading.refuse("Area", "expected \"nominal\", or a number above 0 [m^2].");
    if (gauge == dem::Gauge::planes && !(low_plane < high_plane))
      loading.refuse("Gauge high plane", "must lie above Gauge low plane.");
  }

  dem::GripParameters GripEntries::parameters() const
  {
    dem::GripParameters p;
    p.thickness  = thickness;
    p.area       = number_in(trimmed(area)).value_or(0);
    p.gauge      = gauge;
    p.low_plane  = low_plane;
    p.high_plane = high_plane;
    return p;
  }

  std::string text_of(const dem::GripLayers &layers, const dem::GripParameters &asked)
  {
    const char *gauge = asked.gauge == dem::Gauge::inner_faces       ? "between the grips' inner faces" :
                        asked.gauge == dem::Gauge::outermost_centres ? "between the outermost centres" :
                                                                       "between planes";
    return fmt::format("section {:.5g} m^2 ({}), gauge length {:.5g} m ({}), {} and {} particles gripped",
                       layers.section, asked.area > 0 ? "as given" : nominal, layers.gauge_length, gauge,
                       layers.low.size(), layers.high.size());
  }
} // namespace apps

#include "apps/models/grips.h"

#include "apps/text/value_text.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    constexpr const char *nominal = "nominal";
  } // namespace

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

  std::string text_of(const dem::GripLayers &layers, const dem::GripParameters &requested)
  {
    const char *gauge = requested.gauge == dem::Gauge::inner_faces       ? "between the grips' inner faces" :
                        requested.gauge == dem::Gauge::outermost_centres ? "between the outermost centres" :
                                                                           "between planes";
    return fmt::format("section {:.5g} m^2 ({}), gauge length {:.5g} m ({}), {} and {} particles gripped",
                       layers.section, requested.area > 0 ? "as given" : nominal, layers.gauge_length, gauge,
                       layers.low.size(), layers.high.size());
  }
} // namespace apps

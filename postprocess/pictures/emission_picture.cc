#include "postprocess/pictures/emission_picture.h"

#include "dem/emission/frequency_law.h"
#include "dem/emission/moment_tensor.h"
#include "postprocess/pictures/plot.h"
#include "postprocess/vtk/emission_events.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace postprocess
{
  namespace
  {
    using Events = std::vector<dem::EmissionEvent>;

    PlotSeries line_of(const dem::FrequencyLaw &law, const double largest)
    {
      char name[64];
      std::snprintf(name, sizeof name, "b = %.2f +- %.2f", law.b, law.error);
      PlotSeries line;
      line.name  = name;
      line.style = PlotSeries::Style::line;
      for (const double magnitude : {law.completeness, largest})
        {
          line.x.push_back(magnitude);
          line.y.push_back(static_cast<double>(law.events) * std::pow(10, -law.b * (magnitude - law.completeness)));
        }
      return line;
    }

    PlotPanel frequencies(const Events &events)
    {
      PlotPanel panel;
      panel.title   = "Events at least so large";
      panel.x_label = "Magnitude";
      panel.y_label = "Number";
      panel.log_y   = true;
      PlotSeries points;
      points.name  = "events";
      points.style = PlotSeries::Style::points;
      points.x     = dem::magnitudes_of(events);
      std::sort(points.x.begin(), points.x.end());
      for (std::size_t i = 0; i < points.x.size(); ++i)
        points.y.push_back(static_cast<double>(points.x.size() - i));
      if (const auto law = dem::frequency_law(points.x))
        panel.series.push_back(line_of(*law, points.x.back()));
      panel.series.push_back(points);
      return panel;
    }

    /** A panel of points, one series per kind of event. @tparam Place gives abscissa and ordinate of an event */
    template <typename Place>
    void add_by_kind(PlotPanel &panel, const Events &events, const Place &place)
    {
      for (const char *kind : {"tensile", "shear", "implosive"})
        {
          PlotSeries points;
          points.name  = kind;
          points.style = PlotSeries::Style::points;
          for (const dem::EmissionEvent &e : events)
            if (std::string(kind) == kind_of(e))
              {
                const auto [x, y] = place(e);
                points.x.push_back(x);
                points.y.push_back(y);
              }
          if (!points.x.empty())
            panel.series.push_back(points);
        }
    }
  } // namespace

  std::string
  picture_of_emission(const std::filesystem::path &path, const Events &events, const int looking_along) noexcept
  try
    {
      PlotPanel in_time;
      in_time.title   = "In time";
      in_time.x_label = "Time [s]";
      in_time.y_label = "Magnitude";
      add_by_kind(in_time, events, [](const dem::EmissionEvent &e) {
        return std::make_pair(e.time, dem::moment_magnitude(dem::scalar_moment(e.moment)));
      });
      PlotPanel   in_place;
      const char *axes[] = {"x", "y", "z"};
      const int   across = looking_along == 0 ? 1 : 0, up = looking_along == 2 ? 1 : 2;
      in_place.title      = "In place";
      in_place.x_label    = std::string(axes[across]) + " [mm]";
      in_place.y_label    = std::string(axes[up]) + " [mm]";
      in_place.equal_axes = true;
      add_by_kind(in_place, events, [&](const dem::EmissionEvent &e) {
        return std::make_pair(1e3 * e.place[across], 1e3 * e.place[up]);
      });
      return plot(path, {frequencies(events), in_time, in_place});
    }
  catch (const std::exception &error)
    {
      return error.what();
    }
} // namespace postprocess

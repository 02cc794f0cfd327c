#include "apps/scene/particles/stops.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, StopSection &stop)
  {
    s.text("Column", stop.column, Need::required).means("Of series.csv: a probe, or another number that it holds");
    s.choice("When", stop.above, {{"above", true}, {"below", false}}, Need::optional)
      .means("The run ends when the column lies above the value, or below it");
    s.number("Value", stop.value, "", Range(), Need::required).means("In the unit of the column");
    s.number("From time", stop.from_time, "s", Range::at_least(0), Need::optional)
      .means("Before it the condition is not checked");
  }

  void declare(Section &root, StopsSection &stops)
  {
    root
      .section("Stop", "One sub-section per condition that ends the run before the end time, checked with every row "
                       "of series.csv but the first")
      .named_list("CONDITION", stops.stops, &StopSection::name);
  }
} // namespace apps

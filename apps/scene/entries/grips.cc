#include "apps/scene/entries/grips.h"

#include "apps/scene/section.h"
#include "apps/scene/usual_sizes.h"

namespace apps
{
  void
  declare(Section &loading, GripEntries &grip_entries, const std::function<bool()> &gripped, const std::string &words)
  {
    const Condition needed{gripped, words}; // where there is none, always
    loading.number("Grip thickness", grip_entries.thickness, "m", Range::positive(), Need::required)
      .means("A grip holds the particles whose centre is within this of the specimen's outermost centre; 2.2 "
             "radii hold about one complete layer")
      .only_if(needed);
    Entry &area = loading.text("Area", grip_entries.area, Need::optional);
    area
      .means("Section that stresses refer to: nominal, or a number [m^2]. Nominal: seen along the axis, the "
             "rectangle around all particles, or the circle around them where that is smaller (a cylinder); in "
             "the plane width times thickness")
      .only_if(needed);
    area.store = [store = area.store](const std::string &text, const Place &from) -> std::string {
      const std::string question = question_about_list("area", "m^2", text);
      return question.empty() ? store(list_without_units(text, "m^2"), from) : question;
    };
    loading
      .choice("Gauge length", grip_entries.gauge,
              {{"inner faces", dem::Gauge::inner_faces},
               {"outermost centres", dem::Gauge::outermost_centres},
               {"planes", dem::Gauge::planes}},
              Need::optional)
      .means("Length that strains refer to. inner faces: between the innermost centres that the grips hold, all "
             "that can strain; outermost centres: from end to end, as published tests have it (E then depends on "
             "the grips); planes: strain is measured between two planes of your own, as by an extensometer, "
             "while rates and the stop strain refer to the inner faces")
      .only_if(needed);
    const Condition between{
      [&grip_entries, gripped] { return grip_entries.gauge == dem::Gauge::planes && (!gripped || gripped()); },
      "Gauge length = planes"};
    loading.number("Gauge low plane", grip_entries.low_plane, "m", Range(), Need::required)
      .means("Place of the first plane along the axis")
      .only_if(between);
    loading.number("Gauge high plane", grip_entries.high_plane, "m", Range(), Need::required)
      .means("Place of the second plane along the axis")
      .only_if(between);
  }
} // namespace apps

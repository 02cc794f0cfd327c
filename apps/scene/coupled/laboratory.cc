#include "apps/scene/coupled/laboratory.h"

#include "apps/scene/coupled/couplings.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, LaboratorySection &laboratory)
  {
    Section   &s = root.section("Laboratory", "A specimen of particles between two faces of the solid, as in a press: "
                                                "stress and strain, positive in compression, become columns of series.csv, "
                                                "strength and modulus figures of summary.json");
    const auto asked = [&laboratory](Entry &entry) {
      entry.only_if([&laboratory] { return laboratory.given(); }, "High coupling is given");
    };
    s.text("High coupling", laboratory.high, Need::optional)
      .means("The coupling on the face at the high end of the axis; empty: there is no such test");
    asked(s.text("Low coupling", laboratory.low, Need::required).means("That at the low end"));
    asked(s.text("High point", laboratory.high_point, Need::required)
            .means("Of Continuum/Points; strain is the approach of the two points over the length"));
    asked(s.text("Low point", laboratory.low_point, Need::required).means("The other one"));
    asked(s.choice("Axis", laboratory.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
            .means("From the low end to the high"));
    asked(s.number("Area", laboratory.area, "m^2", Range::positive(), Need::required)
            .means("Section: stress is the mean of the forces on both faces over it"));
    asked(s.number("Length", laboratory.length, "m", Range::positive(), Need::required)
            .means("Of the specimen, between the faces"));
  }
} // namespace apps

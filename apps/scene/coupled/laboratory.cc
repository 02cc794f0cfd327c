#include "apps/scene/coupled/laboratory.h"

#include "apps/scene/coupled/couplings.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, LaboratorySection &laboratory)
  {
    Section &s = root.section("Laboratory", "A specimen of particles between two faces of the solid, as in a press: "
                                            "stress and strain, positive in compression, become columns of series.csv, "
                                            "strength and modulus figures of summary.json");
    const Condition given{[&laboratory] { return laboratory.given(); }, "High coupling is given"};
    s.text("High coupling", laboratory.high, Need::optional)
      .means("The coupling on the face at the high end of the axis; empty: there is no such test");
    s.text("Low coupling", laboratory.low, Need::required).means("That at the low end").only_if(given);
    s.text("High point", laboratory.high_point, Need::required)
      .means("Of Continuum/Points; strain is the approach of the two points over the length")
      .only_if(given);
    s.text("Low point", laboratory.low_point, Need::required).means("The other one").only_if(given);
    s.choice("Axis", laboratory.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
      .means("From the low end to the high")
      .only_if(given);
    s.number("Area", laboratory.area, "m^2", Range::positive(), Need::required)
      .means("Section: stress is the mean of the forces on both faces over it")
      .only_if(given);
    s.number("Length", laboratory.length, "m", Range::positive(), Need::required)
      .means("Of the specimen, between the faces")
      .only_if(given);
  }
} // namespace apps

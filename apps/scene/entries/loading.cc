#include "apps/scene/entries/loading.h"

#include "apps/scene/entries/grips.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    void declare_test(Section &loading, UniaxialLoadingSection &uniaxial_loading, const UniaxialLoad load)
    {
      using Test              = UniaxialLoadingSection::Test;
      const bool        pulls = load == UniaxialLoad::tension;
      const std::string word  = name_of(load);
      Test             &test  = pulls ? uniaxial_loading.tension : uniaxial_loading.compression;
      Section          &section =
        loading.section(pulls ? "Tension" : "Compression", pulls ? "The grips move apart" : "The grips move together");
      section.only_if([&uniaxial_loading, load] { return uniaxial_loading.asks_for(load); },
                      "Loading/Tests has " + word);
      section.number("Strain rate", test.rate, "1/s", Range::positive(), Need::required)
        .means("Speed of the grips over their distance; slow enough when half the rate gives the same strength");
      section
        .number("Stop fraction", test.stop_fraction, "-", {std::numeric_limits<double>::min(), 1.0, true},
                Need::optional)
        .means("The test ends when the stress has fallen to this part of its peak");
      section
        .number("Stop strain", test.stop_strain, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
        .means("The test ends at this strain at the latest");
    }
  } // namespace

  void declare(Section &root, UniaxialLoadingSection &uniaxial_loading)
  {
    Section &section = root.section("Loading", "Uniaxial tests between two gripped layers, each on a fresh specimen");
    section
      .choices("Tests", uniaxial_loading.tests,
               {{"tension", UniaxialLoad::tension}, {"compression", UniaxialLoad::compression}}, Need::optional)
      .means("Tests to make, in this order");
    section.choice("Axis", uniaxial_loading.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
      .means("Direction of loading");
    declare(section, uniaxial_loading.grips);
    section.flag("Grip lateral motion blocked", uniaxial_loading.lateral_blocked)
      .means("Grips hold their particles sideways too, as rough platens do");
    section.flag("Grip rotation blocked", uniaxial_loading.spin_blocked)
      .means("Grips keep their particles from spinning");
    section.flag("Grips turn", uniaxial_loading.grips_turn)
      .means("Each grip turns about its middle, as a platen on a spherical seat; otherwise both stay parallel. Their "
             "particles are held sideways then");
    declare_test(section, uniaxial_loading, UniaxialLoad::tension);
    declare_test(section, uniaxial_loading, UniaxialLoad::compression);
  }
} // namespace apps

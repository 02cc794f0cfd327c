#include "apps/scene/loading_section.h"

#include <algorithm>

namespace apps
{
  const char *name_of(const UniaxialLoad load) { return load == UniaxialLoad::tension ? "tension" : "compression"; }

  UniaxialLoadingSection::UniaxialLoadingSection()
  {
    // Stop as the published tests do: tension when the crack carries a fifth of the strength; compression when the
    // specimen has clearly softened, or at 5e-3 where softening is slow (Stransky, 2018). Tension far past any peak, in
    // case it has none.
    tension.stop_fraction     = 0.2;
    tension.stop_strain       = 1e-3;
    compression.stop_fraction = 0.7;
    compression.stop_strain   = 5e-3;
  }

  void UniaxialLoadingSection::declare(Section &root)
  {
    Section &section = root.section("Loading", "Uniaxial tests between two gripped layers, each on a fresh specimen");
    section
      .choices("Tests", tests, {{"tension", UniaxialLoad::tension}, {"compression", UniaxialLoad::compression}},
               Need::optional)
      .means("Tests to make, in this order");
    section.choice("Axis", axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional).means("Direction of loading");
    grips.declare(section);
    section.flag("Grip lateral motion blocked", lateral_blocked)
      .means("Grips hold their particles sideways too, as rough platens do");
    section.flag("Grip rotation blocked", spin_blocked).means("Grips keep their particles from spinning");
    declare_test(section, UniaxialLoad::tension);
    declare_test(section, UniaxialLoad::compression);
  }

  void UniaxialLoadingSection::declare_test(Section &loading, const UniaxialLoad load)
  {
    const bool        pulls = load == UniaxialLoad::tension;
    const std::string word  = name_of(load);
    Test             &test  = pulls ? tension : compression;
    Section          &section =
      loading.section(pulls ? "Tension" : "Compression", pulls ? "The grips move apart" : "The grips move together");
    section.only_if([this, load] { return asks_for(load); }, "Loading/Tests has " + word);
    section.number("Strain rate", test.rate, "1/s", Range::positive(), Need::required)
      .means("Speed of the grips over their distance; slow enough when half the rate gives the same strength");
    section
      .number("Stop fraction", test.stop_fraction, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
      .means("The test ends when the stress has fallen to this part of its peak");
    section
      .number("Stop strain", test.stop_strain, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
      .means("The test ends at this strain at the latest");
  }

  void UniaxialLoadingSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath section = root.at("Loading");
    if (dimension == 2 && axis == 2)
      section.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
    grips.check(section);
  }

  bool UniaxialLoadingSection::asks_for(const UniaxialLoad load) const
  {
    return std::find(tests.begin(), tests.end(), load) != tests.end();
  }

  dem::UniaxialParameters UniaxialLoadingSection::parameters(const UniaxialLoad load) const
  {
    const Test             &test = load == UniaxialLoad::tension ? tension : compression;
    dem::UniaxialParameters result;
    result.axis            = axis;
    result.strain_rate     = load == UniaxialLoad::tension ? test.rate : -test.rate;
    result.grips           = grips.parameters();
    result.lateral_blocked = lateral_blocked;
    result.spin_blocked    = spin_blocked;
    result.stop_fraction   = test.stop_fraction;
    result.stop_strain     = test.stop_strain;
    return result;
  }
} // namespace apps

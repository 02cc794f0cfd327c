#include "apps/models/loading.h"

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

  void UniaxialLoadingSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath section = root.at("Loading");
    if (dimension == 2 && axis == 2)
      section.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
    grips.check(section);
    if (grips_turn && !lateral_blocked)
      section.refuse("Grips turn", "the specimen would fall over: set Grip lateral motion blocked = true.");
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
    result.turning         = grips_turn;
    result.stop_fraction   = test.stop_fraction;
    result.stop_strain     = test.stop_strain;
    return result;
  }
} // namespace apps

#include "apps/scene/entries/contact_figures.h"

#include "apps/scene/section.h"

#include <nlohmann/json.hpp>

namespace apps
{
  void declare(Section &root, ReferencesSection &references)
  {
    Section &s =
      root.section("References", "Known answers: summary.json then gives the relative error of each figure");
    s.number("Peak force", references.peak_force, "N", Range::at_least(0), Need::optional)
      .means("Largest resultant between what touches; 0: not known")
      .housekeeping();
    s.number("Contact time", references.contact_time, "s", Range::at_least(0), Need::optional)
      .means("From the first touch to the last; 0: not known")
      .housekeeping();
  }
} // namespace apps

#include "apps/scene/particles/published_figures.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, PublishedFigures &published_figures, const std::function<bool()> &test)
  {
    const auto one = [&](const char *name, double &value, const char *unit, const char *words) {
      s.number(name, value, unit, Range::at_least(0), Need::optional)
        .means(words)
        .only_if(test, "Test is not none")
        .housekeeping();
    };
    one("Published strength", published_figures.strength, "Pa",
        "Found in this test by others: reported beside the strength found, and drawn into stress_strain.png; 0: none");
    one("Published modulus", published_figures.modulus, "Pa", "Young's modulus likewise; 0: none");
    one("Published Poisson ratio", published_figures.poisson, "-",
        "Likewise, beside the secant one by gauges; 0: none");
  }
} // namespace apps

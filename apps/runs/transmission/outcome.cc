#include "apps/runs/transmission/outcome.h"

#include <fmt/format.h>

namespace apps
{
  RunOutcome outcome(const TransmissionModel &model)
  {
    RunOutcome found;
    for (std::size_t k = 0; k < model.chosen().size() * model.wavelengths.size(); ++k)
      for (const char *share : {"reflected", "transmitted", "absorbed"})
        found.figures.push_back(fmt::format("waves/{}/{}", k, share));
    return found;
  }
} // namespace apps

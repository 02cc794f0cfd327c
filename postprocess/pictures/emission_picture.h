#pragma once

#include "dem/emission/emission_event.h"

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /**
   * Draw events of acoustic emission: how many are at least so large, with the law of their frequency where there is one; how large they were
   * when; and where they lay.
   * @param looking_along axis across the picture of places: 0, 1, 2
   * @return empty when drawn, otherwise why not; nothing is thrown (see plot()).
   */
  [[nodiscard]] std::string picture_of_emission(const std::filesystem::path           &path,
                                                const std::vector<dem::EmissionEvent> &events,
                                                int                                    looking_along) noexcept;
} // namespace postprocess

#pragma once

#include "dem/emission/emission_event.h"

#include <filesystem>
#include <vector>

namespace postprocess
{
  /** What an event was by its moment tensor: "tensile", "shear", "implosive" (Feignier and Young, 1992); "none" without a moment. */
  const char *kind_of(const dem::EmissionEvent &event);

  /**
   * A row per event: its kind, when and how long, where, what broke in it and how, its moment tensor, what follows from it. Magnitude -inf
   * without a moment. @throws OutputError
   */
  void write_emission_table(const std::filesystem::path &path, const std::vector<dem::EmissionEvent> &events);

  /** The same for ParaView, points. @throws OutputError */
  void write_vtk_emission(const std::filesystem::path &path, const std::vector<dem::EmissionEvent> &events);
} // namespace postprocess

#pragma once

#include "apps/models/gravity.h"
#include "dem/specimen/specimen.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace apps
{
  /** What a static start found; nothing where none was requested. */
  using StaticStart = std::optional<dem::InitialEquilibrium>;

  /** Bring a specimen that is held as the scene says to its initial equilibrium, if one is requested, and show how far that is. @throws base::InputError */
  StaticStart start_statically(dem::Specimen &specimen, const GravitySection &gravity);

  /** How far the search for it is, before the next solution. */
  std::string search_text(const dem::InitialEquilibrium &so_far);

  /** One line. */
  std::string    text_of(const dem::InitialEquilibrium &found);
  nlohmann::json json_of(const dem::InitialEquilibrium &found);
  void           visit_state(base::StateVisitor &visitor, StaticStart &found);
} // namespace apps

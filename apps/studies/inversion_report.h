#pragma once

#include "apps/studies/scaled_targets.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** What a terminal shows: targets and what the surfaces give, constants and how far equally good answers spread. */
  std::string words_of(const InversionQuestion &question, const Inversion &found);
  /** The same of a round: targets, those of the surfaces, and results of the runs. */
  std::string words_of(const InversionQuestion &question, const ScaledRound &round);

  /** What inversion.json holds (doc/formats.md). */
  nlohmann::json json_of(const InversionQuestion &question, const Inversion &found);
  /** Its part "checked". */
  nlohmann::json json_of(const InversionQuestion &question, const ScaledTargets &scaled);
} // namespace apps

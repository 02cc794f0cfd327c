#pragma once

#include "dem/model/energy.h"
#include "postprocess/files/series.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace apps
{
  // The account of a specimen's energies, as every kind of run writes it [J].

  /** At the end of a series: a column "energy_TERM" each. */
  void append_energy_columns(std::vector<postprocess::SeriesColumn> &columns);
  void append_energies(std::vector<double> &row, const dem::EnergyAccount &energy);

  /** Terms by name. */
  nlohmann::json json_of(const dem::EnergyAccount &energy);
  /** The same, with the unit and the largest error of the balance, over the largest energy, that was seen. */
  nlohmann::json json_of(const dem::EnergyAccount &energy, double worst_balance_error);
} // namespace apps

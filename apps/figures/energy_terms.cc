#include "apps/figures/energy_terms.h"

#include <nlohmann/json.hpp>

namespace apps
{
  void append_energy_columns(std::vector<postprocess::SeriesColumn> &columns)
  {
    dem::EnergyAccount().each([&](const std::string &term, double) { columns.push_back({"energy_" + term, "J"}); });
  }

  void append_energies(std::vector<double> &row, const dem::EnergyAccount &energy)
  {
    energy.each([&](const std::string &, const double value) { row.push_back(value); });
  }

  nlohmann::json json_of(const dem::EnergyAccount &energy)
  {
    nlohmann::json terms;
    energy.each([&](const std::string &term, const double value) { terms[term] = value; });
    return terms;
  }

  nlohmann::json json_of(const dem::EnergyAccount &energy, const double worst_balance_error)
  {
    nlohmann::json terms   = json_of(energy);
    terms["unit"]          = "J";
    terms["balance_error"] = worst_balance_error;
    return terms;
  }
} // namespace apps

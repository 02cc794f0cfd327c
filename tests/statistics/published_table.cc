#include "tests/statistics/published_table.h"

#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

const std::vector<std::string> orthogonal_columns = {"Ec_GPa",    "kn_ks",     "sigc_MPa", "tauc_MPa", "mu",
                                                     "Ecg_GPa",   "kn_ks_g",   "mu_g",     "Ecj_GPa",  "kn_ks_j",
                                                     "sigcj_MPa", "taucj_MPa", "mu_j",     "null_col"};

PublishedTable::PublishedTable(const std::string &name)
{
  std::ifstream file(places::sources() + "/apps/scenes/tables/" + name);
  REQUIRE(file);
  std::string line, field;
  std::getline(file, line);
  for (std::istringstream header(line); std::getline(header, field, ',');)
    names.push_back(field);
  while (std::getline(file, line))
    {
      rows.emplace_back();
      for (std::istringstream fields(line); std::getline(fields, field, ',');)
        rows.back().push_back(std::stod(field));
      REQUIRE(rows.back().size() == names.size());
    }
}

Eigen::VectorXd PublishedTable::column(const std::string &name) const
{
  const auto found = std::find(names.begin(), names.end(), name);
  INFO(name);
  REQUIRE(found != names.end());
  Eigen::VectorXd values(rows.size());
  for (std::size_t run = 0; run < rows.size(); ++run)
    values[run] = rows[run][found - names.begin()];
  return values;
}

std::vector<statistics::Factor> PublishedTable::factors(const std::vector<std::string> &wanted) const
{
  std::vector<statistics::Factor> all;
  for (const std::string &name : wanted)
    all.push_back({name, column(name)});
  return all;
}

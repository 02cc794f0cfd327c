#pragma once

#include "apps/statistics/factor.h"

#include <string>
#include <vector>

/** A table of apps/scenes/tables: published runs. */
class PublishedTable
{
public:
  explicit PublishedTable(const std::string &name);

  Eigen::VectorXd                 column(const std::string &name) const;
  std::vector<statistics::Factor> factors(const std::vector<std::string> &names) const;

private:
  std::vector<std::string>         names;
  std::vector<std::vector<double>> rows;
};

/** The fourteen columns of the orthogonal design of concrete, the one without a factor last. */
extern const std::vector<std::string> orthogonal_columns;

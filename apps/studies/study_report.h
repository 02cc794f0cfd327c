#pragma once

#include "apps/studies/study_journal.h"

namespace apps
{
  /**
   * report.html of a study that is complete: its table, what failed, pictures of every response over every factor, and in a design of one
   * factor at a time the elasticities. @param records of all runs
   */
  void write_report(const StudyFile              &study,
                    const StudyPlan              &plan,
                    const std::vector<RunRecord> &records,
                    const std::filesystem::path  &folder);

  /**
   * d ln(response) / d ln(factor), rows and columns, by least squares over the runs in which all other factors have the values of the
   * first run; NaN where there are none, or where signs change (doc/theory/studies.md, 1).
   */
  Eigen::MatrixXd elasticities(const StudyPlan &plan, const std::vector<RunRecord> &records);
} // namespace apps

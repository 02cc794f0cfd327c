#pragma once

#include "apps/studies/study_journal.h"

#include <string>

namespace apps
{
  /**
   * table.csv: a row for each run with the values of the factors and responses, `nan` where there is none; a comment after the row says
   * why. The same bytes however the runs came about. @param records of all runs
   */
  std::string table_of(const StudyFile &study, const StudyPlan &plan, const std::vector<RunRecord> &records);
} // namespace apps

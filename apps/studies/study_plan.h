#pragma once

#include "apps/studies/study_file.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace apps
{
  /** The runs of a study: values of the factors, and what they change in the scene. */
  struct StudyPlan
  {
    std::vector<std::string>              columns; ///< "cohesion [Pa]", of each factor
    Eigen::MatrixXd                       values;  ///< a run a row
    std::vector<std::vector<std::string>> changes; ///< of each run, "Material/CPM/Cohesion=3e6"
    std::string                           text;    ///< all that decides the results: a journal belongs to this text
  };

  /**
   * Make the plan, and read the scene with the changes of every run.
   * @throws base::InputError for a design that cannot be made, and for a run whose scene is refused, naming entry and run
   */
  StudyPlan plan_of(const StudyFile &study);
} // namespace apps

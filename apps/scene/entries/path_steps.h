#pragma once

#include "dem/linear/solver_method.h"

#include <string>

namespace apps
{
  class Section;

  /** How a path of equilibria of links that are damaged is followed. @param forces that the tolerance refers to: "link forces" */
  void declare_path_steps(
    Section &section, double &growth_step, double &tolerance, double &damping, const std::string &forces);

  /** How its linear systems are solved. */
  void declare_path_solver(Section &section, dem::SolverMethod &method);
} // namespace apps

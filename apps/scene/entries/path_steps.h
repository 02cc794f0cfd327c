#pragma once

#include <string>

namespace apps
{
  class Section;

  /** How a path of equilibria of links that are damaged is followed. @param forces that the tolerance refers to: "link forces" */
  void declare_path_steps(
    Section &section, double &growth_step, double &tolerance, double &damping, const std::string &forces);
} // namespace apps

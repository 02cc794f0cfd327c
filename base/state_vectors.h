#pragma once

#include "base/state.h"

#include <Eigen/Core>

namespace base
{
  /** A list of vectors as one column, three numbers each. */
  inline void visit_vectors(StateVisitor &visitor, const std::string &name, std::vector<Eigen::Vector3d> &values)
  {
    Column flat(3 * values.size());
    for (std::size_t i = 0; i < flat.size(); ++i)
      flat[i] = values[i / 3][static_cast<Eigen::Index>(i % 3)];
    visitor.column(name, flat);
    values.resize(flat.size() / 3);
    for (std::size_t i = 0; i < flat.size(); ++i)
      values[i / 3][static_cast<Eigen::Index>(i % 3)] = flat[i];
  }
} // namespace base

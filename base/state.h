#pragma once

#include "base/column.h"

#include <cstdint>
#include <string>
#include <vector>

namespace base
{
  /**
 * Walks over everything that a run must remember to go on to the same bits.
 *
 * A writer stores each item under its name; a reader fills it (and resizes columns). Every class with history has one
 * `visit_state(StateVisitor &)` that names each item once, so that writing and reading cannot differ.
 */
  class StateVisitor
  {
  public:
    virtual ~StateVisitor()                                                         = default;
    virtual void column(const std::string &name, Column &values)                    = 0;
    virtual void column(const std::string &name, std::vector<std::int32_t> &values) = 0;
    virtual void scalar(const std::string &name, double &value)                     = 0;
    virtual void scalar(const std::string &name, std::int64_t &value)               = 0;
  };
} // namespace base

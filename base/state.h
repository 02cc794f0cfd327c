#pragma once

#include "base/column.h"

#include <cstddef>
#include <cstdint>
#include <functional>
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
    /** Takes some numbers of a column, which follow those before. */
    using Take = std::function<void(const double *numbers, std::size_t count)>;
    /** Hands a whole column to what takes it, part by part; called once. */
    using Tell = std::function<void(const Take &take)>;

    virtual ~StateVisitor()                                                         = default;
    virtual void column(const std::string &name, Column &values)                    = 0;
    virtual void column(const std::string &name, std::vector<std::int32_t> &values) = 0;
    /** A column of which no one has the memory: a writer takes one part after the other. To other visitors it is one as others. */
    virtual void column_in_parts(const std::string &name, const std::size_t count, const Tell &tell)
    {
      Column whole;
      whole.reserve(count);
      tell([&](const double *const numbers, const std::size_t more) {
        whole.insert(whole.end(), numbers, numbers + more);
      });
      column(name, whole);
    }
    /** Whether it fills items by their names, in whatever order these are visited. */
    virtual bool finds_by_name() const { return false; }
    /** Read a column of which no one has the memory, one part after the other. @pre finds_by_name() */
    virtual void read_in_parts(const std::string &name, const Take &take)
    {
      Column whole;
      column(name, whole);
      take(whole.data(), whole.size());
    }
    virtual void scalar(const std::string &name, double &value)       = 0;
    virtual void scalar(const std::string &name, std::int64_t &value) = 0;
  };
} // namespace base

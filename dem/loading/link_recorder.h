#pragma once

#include "dem/loading/link_path.h"

#include <string>

namespace dem
{
  /** Columns of a link history, filled row by row in the order in which they were first named. */
  class LinkRecorder
  {
  public:
    void operator()(const std::string &name, const std::string &unit, const double value)
    {
      if (next == history.columns.size())
        history.columns.push_back({name, unit, {}});
      history.columns[next++].values.push_back(value);
    }
    void end_row() { next = 0; }

    LinkHistory history;

  private:
    std::size_t next = 0;
  };
} // namespace dem

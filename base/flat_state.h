#pragma once

#include "base/state.h"

#include <cstddef>
#include <stdexcept>

namespace base
{
  /** Lays a state down as one row of numbers, in the order of the visit: where a checkpoint or a copy wants a single column. */
  class FlatStateWriter : public StateVisitor
  {
  public:
    explicit FlatStateWriter(Column &row_)
      : row(row_)
    {
    }
    void column(const std::string &, Column &values) override { append(values); }
    void column(const std::string &, std::vector<std::int32_t> &values) override { append(values); }
    void scalar(const std::string &, double &value) override { row.push_back(value); }
    /** Exact up to 2^53. */
    void scalar(const std::string &, std::int64_t &value) override { row.push_back(static_cast<double>(value)); }

  private:
    template <typename Values>
    void append(const Values &values)
    {
      row.push_back(static_cast<double>(values.size()));
      row.insert(row.end(), values.begin(), values.end());
    }
    Column &row;
  };

  /** Takes it up again. @throws std::out_of_range where the row ends too early */
  class FlatStateReader : public StateVisitor
  {
  public:
    explicit FlatStateReader(const Column &row_)
      : row(row_)
    {
    }
    void column(const std::string &, Column &values) override { take(values); }
    void column(const std::string &, std::vector<std::int32_t> &values) override { take(values); }
    void scalar(const std::string &, double &value) override { value = row.at(next++); }
    void scalar(const std::string &, std::int64_t &value) override
    {
      value = static_cast<std::int64_t>(row.at(next++));
    }

    /** How many numbers have been taken up. */
    std::size_t position() const { return next; }

  private:
    template <typename Values>
    void take(Values &values)
    {
      const auto size = static_cast<std::size_t>(row.at(next++));
      if (size > row.size() - next)
        throw std::out_of_range("state: the row of numbers ends too early.");
      values.resize(size);
      for (auto &value : values)
        value = static_cast<typename Values::value_type>(row[next++]);
    }
    const Column &row;
    std::size_t   next = 0;
  };
} // namespace base

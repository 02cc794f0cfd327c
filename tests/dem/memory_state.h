#pragma once

#include "base/state.h"

#include <catch2/catch.hpp>

#include <map>
#include <string>
#include <vector>

/** A run's state in memory: written by one visitor, read back by the other; a name that is read must have been written. */
struct MemoryState
{
  std::map<std::string, base::Column>              columns;
  std::map<std::string, std::vector<std::int32_t>> integer_columns;
  std::map<std::string, double>                    numbers;
  std::map<std::string, std::int64_t>              integers;

  class Writer : public base::StateVisitor
  {
  public:
    explicit Writer(MemoryState &memory)
      : m(memory)
    {
    }
    void column(const std::string &name, base::Column &values) override { put(m.columns, name, values); }
    void column(const std::string &name, std::vector<std::int32_t> &values) override
    {
      put(m.integer_columns, name, values);
    }
    void scalar(const std::string &name, double &value) override { put(m.numbers, name, value); }
    void scalar(const std::string &name, std::int64_t &value) override { put(m.integers, name, value); }

  private:
    template <typename T>
    void put(std::map<std::string, T> &where, const std::string &name, const T &value)
    {
      INFO("written twice: " << name);
      REQUIRE(where.emplace(name, value).second);
    }
    MemoryState &m;
  };

  class Reader : public base::StateVisitor
  {
  public:
    explicit Reader(const MemoryState &memory)
      : m(memory)
    {
    }
    void column(const std::string &name, base::Column &values) override { get(m.columns, name, values); }
    void column(const std::string &name, std::vector<std::int32_t> &values) override
    {
      get(m.integer_columns, name, values);
    }
    void scalar(const std::string &name, double &value) override { get(m.numbers, name, value); }
    void scalar(const std::string &name, std::int64_t &value) override { get(m.integers, name, value); }

  private:
    template <typename T>
    void get(const std::map<std::string, T> &where, const std::string &name, T &value)
    {
      INFO("not written: " << name);
      REQUIRE(where.count(name) == 1);
      value = where.at(name);
    }
    const MemoryState &m;
  };

  friend bool operator==(const MemoryState &a, const MemoryState &b)
  {
    return a.columns == b.columns && a.integer_columns == b.integer_columns && a.numbers == b.numbers &&
           a.integers == b.integers;
  }
};

#pragma once

#include "base/state.h"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/**
 * A run's state in memory: written by one visitor, read back by the other; a name that is read must have been written, once.
 * It throws where not, instead of asserting, as Catch2 asserts on one thread alone and ranks of tests are threads.
 */
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
      if (!where.emplace(name, value).second)
        throw std::logic_error("written twice: " + name);
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
    bool finds_by_name() const override { return true; }
    void scalar(const std::string &name, double &value) override { get(m.numbers, name, value); }
    void scalar(const std::string &name, std::int64_t &value) override { get(m.integers, name, value); }

  private:
    template <typename T>
    void get(const std::map<std::string, T> &where, const std::string &name, T &value)
    {
      const auto found = where.find(name);
      if (found == where.end())
        throw std::logic_error("not written: " + name);
      value = found->second;
    }
    const MemoryState &m;
  };

  /** The state of some things that visit_state() shows, in this order. */
  template <typename... Parts>
  static MemoryState of(Parts &...parts)
  {
    MemoryState memory;
    Writer      writer(memory);
    (parts.visit_state(writer), ...);
    return memory;
  }

  /** What of() kept, back into the same things. */
  template <typename... Parts>
  void restore(Parts &...parts) const
  {
    Reader reader(*this);
    (parts.visit_state(reader), ...);
  }

  friend bool operator==(const MemoryState &a, const MemoryState &b)
  {
    return a.columns == b.columns && a.integer_columns == b.integer_columns && a.numbers == b.numbers &&
           a.integers == b.integers;
  }
};

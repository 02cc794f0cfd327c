#pragma once

#include "dem/specimen/core.h"

#include <string>

namespace dem
{
  /**
   * Shows the state of a specimen that several ranks share to a visitor that writes it: columns of which each rank has its part are told to all
   * some lines at a time, so that none needs the memory of a whole one. All ranks visit.
   */
  class GatheredState : public base::StateVisitor
  {
  public:
    /** @pre core.shares() */
    GatheredState(SpecimenCore &core, base::StateVisitor &inner);

    void column(const std::string &name, base::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override { inner.column(name, values); }
    void scalar(const std::string &name, double &value) override { inner.scalar(name, value); }
    /** @throws std::logic_error where the visitor is one that reads: a state is taken up before a specimen's first step */
    void scalar(const std::string &name, std::int64_t &value) override;

  private:
    SpecimenCore       &core;
    base::StateVisitor &inner;
  };
} // namespace dem

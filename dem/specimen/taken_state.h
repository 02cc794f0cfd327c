#pragma once

#include "dem/specimen/core.h"

#include <string>
#include <vector>

namespace dem
{
  /**
   * Reads the state of a specimen that several ranks share, before its first step, so that none of them has all of it: what links remember and
   * do is left to the end, when it is known who updates which, and each keeps its own of each part that is read. All ranks visit.
   */
  class TakenState : public base::StateVisitor
  {
  public:
    /** @pre inner.finds_by_name(); ranks share the specimen, and nothing has been shared out so far */
    TakenState(SpecimenCore &core, base::StateVisitor &inner);

    void column(const std::string &name, base::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override { inner.column(name, values); }
    void scalar(const std::string &name, double &value) override { inner.scalar(name, value); }
    void scalar(const std::string &name, std::int64_t &value) override { inner.scalar(name, value); }

    /** All else has been visited. @throws base::InputError where a column is of another length than the links */
    void take_rest();

  private:
    /** A column of a set, which is read at the end. */
    struct Left
    {
      std::string    name;
      base::Column  *values;
      std::size_t    numbers_of_line;
      const LinkSet *links;
    };
    void read_own(const Left &left);

    SpecimenCore       &core;
    base::StateVisitor &inner;
    std::vector<Left>   rest;
  };
} // namespace dem

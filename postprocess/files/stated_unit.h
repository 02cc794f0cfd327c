#pragma once

#include "base/length_unit.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace postprocess
{
  /**
   * What the comments of a text file say of the unit of its lengths: "lengths in mm", "unit: mm", "all in millimetres".
   *
   * A unit behind a number, as in "spheres of 4 mm", is a size and no statement. One that stands elsewhere without a mention of lengths
   * is a doubt, which only a clear statement takes away.
   */
  class StatedUnit
  {
  public:
    explicit StatedUnit(std::string origin_)
      : origin(std::move(origin_))
    {
    }

    /** @param names_columns units in brackets are those of columns. @throws base::InputError where two lines contradict each other */
    void read(std::string_view comment, std::size_t line, bool names_columns);

    const std::optional<base::LengthUnit> &unit() const { return said; } ///< empty: nothing clear is said
    std::size_t                            line() const { return said_in; }
    /** @throws base::InputError if a unit is named, and nothing says whether the lengths are in it */
    void require_no_doubt() const;

  private:
    std::string                     origin;
    std::optional<base::LengthUnit> said, doubted;
    std::size_t                     said_in = 0, doubted_in = 0;
  };

  /** Whether a comment says clearly in what unit lengths are. */
  bool states_unit(std::string_view comment);
} // namespace postprocess

#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace base
{
  /** A value found here beside what it should be. */
  struct Comparison
  {
    std::string quantity, unit; ///< unit "": a pure number
    double      found = 0, reference = 0;
    double      limit    = 0;    ///< of the error
    bool        relative = true; ///< the error is over the reference

    double error() const { return std::fabs(found - reference) / (relative ? std::fabs(reference) : 1.0); }
    bool   holds() const { return error() <= limit; } ///< not of a NaN
  };

  /** What a reference is compared by: rows.of("stress", "Pa", found).within(1e-4, 2.5e6). */
  class Comparisons
  {
  public:
    /** A value that waits for its reference. */
    class Found
    {
    public:
      /** @param part of the reference by which it may err [-] */
      void within(const double part, const double reference) { add(part, reference, true); }
      /** @param margin by which it may err, in its unit: half a digit of what is printed, or where the reference is zero */
      void within_margin(const double margin, const double reference) { add(margin, reference, false); }

    private:
      friend class Comparisons;
      void add(const double limit, const double reference, const bool relative)
      {
        value.reference = reference;
        value.limit     = limit;
        value.relative  = relative;
        all.push_back(value);
      }

      std::vector<Comparison> &all;
      Comparison               value;

      Found(std::vector<Comparison> &rows, Comparison found)
        : all(rows)
        , value(std::move(found))
      {
      }
    };

    Found of(const std::string &quantity, const std::string &unit, const double found)
    {
      Comparison value;
      value.quantity = quantity;
      value.unit     = unit;
      value.found    = found;
      return {rows, value};
    }

    const std::vector<Comparison> &all() const { return rows; }

  private:
    std::vector<Comparison> rows;
  };

  /** Published values, closed forms or answers of another program, and the computation that is compared with them. */
  struct Reference
  {
    std::string                        subject; ///< "concrete in uniaxial tension"
    std::string                        source;  ///< author, year, table; or what the closed form is
    std::function<void(Comparisons &)> compare;
  };
} // namespace base

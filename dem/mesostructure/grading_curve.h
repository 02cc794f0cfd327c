#pragma once

#include <cstddef>
#include <vector>

namespace dem
{
  /** A sieve, and what part of the solid goes through or stays on it. */
  struct SievePart
  {
    double size = 0; ///< of its openings [m], > 0
    double part = 0; ///< of the solid [-]
  };

  /**
   * Cumulative grading: part of the solid that is finer than a size, linear in the logarithm of the size between sieves
   * (doc/theory/mesostructure.md, 2). What passes the finest sieve is of no known size.
   */
  class GradingCurve
  {
  public:
    /** @param passing what is finer than each sieve, in any order
     *  @throws base::InputError naming a sieve (from 1) for sizes that are none or occur twice, parts outside [0, 1] or that fall with the
     *  size, fewer than two sieves, or a coarsest sieve that not all passes (within 1e-6) */
    static GradingCurve of_passing(const std::vector<SievePart> &passing);
    /** @param retained what lies on each sieve, having passed the next coarser one; what their sum lacks to 1 passes the finest. @throws likewise */
    static GradingCurve of_retained(const std::vector<SievePart> &retained);
    /** Fuller and Thompson (1907): (d/largest)^exponent at `classes` + 1 sizes, evenly spaced in the logarithm. @throws base::InputError */
    static GradingCurve fuller(double smallest, double largest, double exponent = 0.5, std::size_t classes = 32);

    double passing(double size) const; ///< constant beyond both ends
    double smallest() const { return sieves.front().size; }
    double largest() const { return sieves.back().size; }
    /** Sieves in ascending order, with what passes. */
    const std::vector<SievePart> &points() const { return sieves; }
    /** Volume of aggregate between two sizes over that of all. */
    double between(const double low, const double high) const { return passing(high) - passing(low); }

  private:
    explicit GradingCurve(std::vector<SievePart> ascending)
      : sieves(std::move(ascending))
    {
    }

    std::vector<SievePart> sieves;
  };
} // namespace dem

#include "operation_count.h"

#include "dem/kernels/kinematics.h"
#include "dem/laws/cpm.h"
#include "tests/dem/clusters.h"

#include <cmath>

namespace performance
{
  namespace
  {
    Operations counted;

    /** A double that counts what is done to it. */
    struct Counted
    {
      double value;
      Counted() = default;
      Counted(const double v)
        : value(v)
      {
      }
    };

    Counted operator+(const Counted &a, const Counted &b) { return ++counted.additions, a.value + b.value; }
    Counted operator-(const Counted &a, const Counted &b) { return ++counted.additions, a.value - b.value; }
    Counted operator*(const Counted &a, const Counted &b) { return ++counted.multiplications, a.value * b.value; }
    Counted operator/(const Counted &a, const Counted &b) { return ++counted.divisions, a.value / b.value; }
    bool    operator>(const Counted &a, const Counted &b) { return ++counted.comparisons, a.value > b.value; }
    bool    operator<(const Counted &a, const Counted &b) { return ++counted.comparisons, a.value < b.value; }
    Counted select(const bool mask, const Counted &yes, const Counted &no) { return mask ? yes : no; }
    Counted maximum(const Counted &a, const Counted &b) { return ++counted.comparisons, a.value > b.value ? a : b; }
    // A fused operation is a product and a sum.
    Counted multiply_add(const Counted &a, const Counted &b, const Counted &c) { return a * b + c; }
    Counted multiply_subtract(const Counted &a, const Counted &b, const Counted &c) { return a * b - c; }
    Counted negative_multiply_add(const Counted &a, const Counted &b, const Counted &c) { return c - a * b; }
    Counted square_root(const Counted &a) { return ++counted.roots, std::sqrt(a.value); }
    template <typename Function>
    Counted each_lane(const Counted &a, Function &&f)
    {
      return f(a.value);
    }
    Counted round_to_integer(const Counted &a) { return std::nearbyint(a.value); }
    Counted power_of_two(const Counted &k) { return std::exp2(k.value); }
  } // namespace
  Operations count_link_update()
  {
    using dem::Vec;
    const dem::CpmConstants law(cluster::concrete());

    counted = {};
    // Branch, increment, half sums of rotations: three differences each, and three products for each half sum.
    dem::PairMotion<Counted> motion{{{{1e-3}, {1e-3}, {1e-3}}},
                                    {{{1e-9}, {-1e-9}, {2e-9}}},
                                    {{{1e-7}, {1e-7}, {-1e-7}}},
                                    {{{1e-7}, {1e-7}, {-1e-7}}}};
    counted.additions += 12;
    counted.multiplications += 6;
    const Counted             reference(std::sqrt(3.0) * 1e-3), area(3e-6);
    Vec<Counted, 3>           shear[1] = {{{{0.0}, {0.0}, {0.0}}}};
    const Counted             inverse  = Counted(1.0) / reference;
    const auto                frame    = dem::advance_shear<true>(motion, inverse, shear);
    const Counted             strain   = (frame.length - reference) * inverse;
    dem::CpmState<Counted, 3> state{0.0, 0.0, shear[0]};
    const auto                response = dem::Cpm<true, true>::update(law, strain, Counted(0.0), state);
    const Vec<Counted, 3>     tangent  = area * response.shear_stress;
    const Vec<Counted, 3>     force    = (area * response.normal_stress) * frame.direction + tangent;
    const Vec<Counted, 3>     couple   = (Counted(0.5) * frame.length) * dem::cross(frame.direction, tangent);
    (void)force;
    (void)couple;
    return counted;
  }
} // namespace performance

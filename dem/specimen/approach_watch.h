#pragma once

#include "base/state.h"
#include "dem/contacts/deepest_overlap.h"

#include <cstdint>

namespace dem
{
  /** Measures how deep unbonded particles are pressed into each other, as often as some might pass through meanwhile. */
  class OverlapWatch
  {
  public:
    /** What is allowed, and where the run is. */
    struct Frame
    {
      double       limit;           ///< deepest overlap, over the smaller radius
      double       smallest_radius; ///< [m]
      std::int64_t step;
      double       time; ///< [s]
    };
    /** Whether moved() by this would measure [m]. */
    bool looks_after(const double largest, const Frame &frame) const
    {
      return !(path + largest <
               frame.limit / 5 * frame.smallest_radius); // two of them come two fifths of the limit nearer meanwhile
    }
    /** They have, and nothing is measured. */
    void moved(const double largest) { path += largest; }
    /**
     * They have, and this is the deepest overlap.
     * @throws base::NumericalError, naming two of them, where they are pressed into each other beyond the limit
     */
    void   measured(const DeepestOverlap &overlap, const Frame &frame, const Particles &particles);
    double deepest() const { return deepest_seen; } ///< that was found so far, over the smaller radius

    void visit_state(base::StateVisitor &visitor);

  private:
    double path         = 0; ///< not below the way of any particle since overlaps were last found [m]
    double deepest_seen = 0;
  };

  /** When the stable step of contacts that stiffen must be found again: before overlaps outgrow those that it was found for. */
  class StiffeningWatch
  {
  public:
    explicit StiffeningWatch(const double at_least_)
      : at_least(at_least_)
      , allowed(at_least_)
    {
    }

    double ahead() const { return allowed; } ///< by which overlaps may grow until then [m]
    /** Particles have moved by this much at most [m]. @return whether the step must be found again, for ahead() as it is now */
    bool moved(double largest);

    void visit_state(base::StateVisitor &visitor);

  private:
    double at_least; ///< allow at least this [m]
    double allowed;
    double path = 0; ///< not below the way of any particle since the step was found [m]
  };
} // namespace dem

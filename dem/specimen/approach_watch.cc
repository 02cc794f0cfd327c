#include "dem/specimen/approach_watch.h"

#include "base/errors.h"

#include <algorithm>
#include <sstream>

namespace dem
{
  namespace
  {
    /** For how many steps the stable step of contacts that stiffen is found in advance. */
    constexpr double steps_ahead = 50;

    [[noreturn]] void
    refuse(const DeepestOverlap &overlap, const OverlapWatch::Frame &frame, const Particles &particles)
    {
      std::ostringstream message;
      message << "step " << frame.step << ", time " << frame.time << " s: particles "
              << particles.number[overlap.first] + 1 << " and " << particles.number[overlap.second] + 1
              << " are pressed into each other by " << overlap.depth << " radii of the smaller one";
      if (overlap.depth < DeepestOverlap::gone_through)
        message << ", above Physics/Largest overlap = " << frame.limit;
      else
        message << " and would pass through";
      message << ": their contact is too soft for what it has to stop. Make it stiffer or what meets slower.";
      throw base::NumericalError(message.str());
    }
  } // namespace

  void OverlapWatch::measured(const DeepestOverlap &overlap, const Frame &frame, const Particles &particles)
  {
    path         = 0;
    deepest_seen = std::max(deepest_seen, overlap.depth);
    if (!(overlap.depth < frame.limit))
      refuse(overlap, frame, particles);
  }

  void OverlapWatch::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("deepest_overlap", deepest_seen);
    visitor.scalar("path_unlooked", path);
  }

  bool StiffeningWatch::moved(const double largest)
  {
    path += largest;
    if (2 * (path + largest) <= allowed) // two of them come nearer by twice the path
      return false;
    allowed = std::max(at_least, 2 * steps_ahead * largest);
    path    = 0;
    return true;
  }

  void StiffeningWatch::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("overlap_ahead", allowed);
    visitor.scalar("path_since_step", path);
  }
} // namespace dem

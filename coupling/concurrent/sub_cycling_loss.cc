#include "coupling/concurrent/sub_cycling_loss.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coupling
{
  namespace
  {
    /** Of what may still be lost, in one window by the power of the last: as contact begins, power grows four times from one to the next. */
    constexpr double share_of_a_window = 1.0 / 8;
    /** Of a power that is not measured any more, since no side takes several steps: contact may be over. */
    constexpr double memory = 0.9;
  } // namespace

  double SubCyclingLoss::longest_window(const double shorter, const double known) const
  {
    const double power = std::max({now, before, known});
    if (allowed >= 1 || !(power > 0))
      return std::numeric_limits<double>::infinity();
    const double may = share_of_a_window * std::max(0.0, allowed * largest - std::fabs(gone));
    return 0.5 * shorter + std::sqrt(0.25 * shorter * shorter + may / power);
  }

  void SubCyclingLoss::note(const WindowSteps &taken, const double made)
  {
    gone -= made;
    const int most = std::max(taken.particles, taken.solid);
    if (most == 1)
      {
        now *= memory;
        before *= memory;
        return;
      }
    expect(taken, made);
    several += 1;
    of_several += most;
  }

  bool SubCyclingLoss::loses_too_much(const WindowSteps &taken, const double made) const
  {
    return allowed < 1 && std::max(taken.particles, taken.solid) > 1 &&
           std::fabs(made) > 0.5 * std::max(0.0, allowed * largest - std::fabs(gone));
  }

  void SubCyclingLoss::expect(const WindowSteps &taken, const double made)
  {
    before = now;
    now    = std::fabs(made) / (taken.window * taken.window * (1 - 1.0 / std::max(taken.particles, taken.solid)));
  }

  void SubCyclingLoss::note_energy(const double energy) { largest = std::max(largest, energy); }

  void SubCyclingLoss::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("sub_cycling/largest_energy", largest);
    visitor.scalar("sub_cycling/lost", gone);
    visitor.scalar("sub_cycling/power", now);
    visitor.scalar("sub_cycling/power_before", before);
    visitor.scalar("sub_cycling/windows", several);
    visitor.scalar("sub_cycling/steps", of_several);
  }
} // namespace coupling

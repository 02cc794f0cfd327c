#pragma once

#include "base/state.h"
#include "coupling/concurrent/window_steps.h"

namespace coupling
{
  /**
   * Keeps what sub-cycling loses to a part of the energy (doc/theory/surface-coupling.md, 2). In a window of the length T, t the shorter of
   * both steps, that is p T (T - t), with a power p per time that forces and masses decide: it is measured in the account of the couplings,
   * window by window, and the next window may lose a share of what is left.
   */
  class SubCyclingLoss
  {
  public:
    /** @param part of the largest energy that may be lost in all; 1 and more: whatever is lost */
    void set_part(double part) { allowed = part; }

    /**
     * Longest window now [s], not below the shorter step. @param shorter step [s] @param known p, where it follows from forces and masses: what was
     * measured counts where it is more [W/s]
     */
    double longest_window(double shorter, double known = 0) const;

    /**
     * Whether a window has lost more than half of what could still be lost: taken again and again, such windows would not keep to the part.
     * @param taken, made as of note()
     */
    bool loses_too_much(const WindowSteps &taken, double made) const;
    /** Of a window that is taken again: what it would have lost is known for the next. */
    void expect(const WindowSteps &taken, double made);

    /** @param taken window of several steps of one side @param made in it by the couplings, negative where lost [J] */
    void note(const WindowSteps &taken, double made);
    /** @param energy of now, of which the largest counts [J] */
    void note_energy(double energy);

    double lost() const { return gone; } ///< by windows of several steps so far [J]
    /** Windows of several steps, and how many steps the shorter-stepped side has taken in them. */
    double windows() const { return several; }
    double steps() const { return of_several; }

    void visit_state(base::StateVisitor &visitor);

  private:
    double allowed = 1;
    double largest = 0;         ///< energy so far [J]
    double gone    = 0;         ///< [J]
    double now = 0, before = 0; ///< p in the last two windows [W/s]
    double several = 0, of_several = 0;
  };
} // namespace coupling

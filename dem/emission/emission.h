#pragma once

#include "base/state.h"
#include "dem/emission/emission_event.h"
#include "dem/model/break_log.h"
#include "dem/model/link_law.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** What makes one event of several breaks. */
  struct EmissionWindow
  {
    double reach = 0; ///< a break this near to one of an event belongs to it [m]; 0: nothing is listened to
    double lasts = 0; ///< as long as it comes this soon after the event's last one [s]
  };

  /**
   * The window of a reach given in mean diameters of the particles: an event lasts while a crack at half the speed of shear waves crosses
   * twice the reach (Hazzard and Young, 2000). The speed is that of the bonds if every particle followed the mean strain.
   * @throws base::InputError where no bonds are, which could break
   */
  EmissionWindow emission_window(
    double reach_in_diameters, int dimension, const Particles &particles, const LinkSet &bonds, const LinkLaw &law);

  /**
   * Listens to a specimen that breaks. Each event has a body, the particles whose bonds broke in it; its moment tensor is what the forces of
   * the links around this body have changed by since, times where they act (Hazzard and Young, 2002; doc/theory/acoustic-emission.md, 1).
   * Forces of surfaces, grips and weight do not count.
   */
  class Emission
  {
  public:
    Emission() = default;
    explicit Emission(const EmissionWindow &window_)
      : window(window_)
    {
    }

    bool listens() const { return window.reach > 0; }
    /** Whether listen() would read forces now. */
    bool hears(const BreakLog &log) const { return !sources.empty() || logged < log.size(); }
    /** Forces at t_n are known, and particles have not moved on yet: take up new breaks, and follow the moments of those that still go on. */
    void
    listen(const Particles &particles, const LinkSet &bonds, const LinkSet &contacts, const BreakLog &log, double time);
    /** In the order of their first breaks; the last may still go on. */
    const std::vector<EmissionEvent> &events() const { return heard; }

    void visit_state(base::StateVisitor &visitor);

  private:
    /** An event that may still grow. */
    struct Source
    {
      std::size_t                  event = 0; ///< number of it
      double                       ends  = 0; ///< unless something breaks near before [s]
      Eigen::Vector3d              origin;    ///< of the moments [m]
      std::vector<Eigen::Vector3d> places;    ///< of its breaks
      std::vector<std::int32_t>    body;      ///< particles, ascending
      Eigen::Matrix3d at_start; ///< moment of the forces around the body less the tensor, when it was last enlarged
    };

    void
    take_up(const Break &b, double time, const Particles &particles, const LinkSet &bonds, const LinkSet &contacts);
    /** The nearest that a break belongs to, of several as near the first; none: the end. */
    std::vector<Source>::iterator source_near(const Break &b);
    void                          follow(const Source &source, const Eigen::Matrix3d &around);

    EmissionWindow             window;
    std::size_t                logged = 0; ///< of the log's breaks so many are taken up
    std::vector<EmissionEvent> heard;
    std::vector<Source>        sources;
  };
} // namespace dem

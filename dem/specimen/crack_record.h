#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/measures/link_measures.h"
#include "dem/model/break_log.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  struct LinkOutput;

  /** What has broken in a specimen: bonds that are gone, with their last geometry, and a log of every element that broke. */
  class CrackRecord
  {
  public:
    /** Enter in the log what has broken of a bond and is not in it yet. @param link set to the bond, before motion moves it */
    void log(const Particles  &particles,
             const LinkSet    &bonds,
             const LinkReader &link,
             std::size_t       number,
             double            time,
             std::int64_t      step);
    /** Enter an event of another kind of bond, unless it is known. */
    void log(const Break &event);
    /** A bond holds no longer: its ends count it among their broken links. */
    void note(Particles &particles, const LinkSet &bonds, const LinkReader &link, std::size_t number);

    std::size_t count() const { return ends.size() / 2; } ///< of bonds that are gone
    /** Two particles of each of these. */
    const std::vector<std::int32_t> &ends_of_gone() const { return ends; }
    double                           dissipated() const { return damage_energy; } ///< by their damage [J]
    const BreakLog                  &events() const { return breaks; }
    /** How many have an end among these. @param is_of by the particles' order */
    std::size_t count_of(const std::vector<bool> &is_of) const;
    /** Append them to the links of an observer. @param pairs whether links carry the number of their pair of materials */
    void append(LinkOutput &out, const Particles &particles, bool pairs) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    std::vector<std::int32_t> ends;     ///< two of each
    base::Column              geometry; ///< records: last branch (3) [m] | contact point (3) [m] | dissipated [J] | 0
    double                    damage_energy = 0;
    BreakLog                  breaks;
  };
} // namespace dem

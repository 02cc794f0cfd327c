#pragma once

#include "base/state.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** Section "References": known answers of an impact. */
  struct ReferencesSection
  {
    double peak_force = 0, contact_time = 0; ///< [N], [s]; 0: not known
  };

  /** How two bodies have touched, of every step. */
  struct ContactFigures
  {
    double peak_force = 0, peak_time = 0;     ///< largest resultant on a body [N], and when [s]
    double first_touch = -1, last_touch = -1; ///< [s]; -1: never
    double patch = 0,
           face  = 0; ///< at the largest: where they touch, and a face of an element there [m^2]; 0: not known

    bool   touched() const { return first_touch >= 0; }
    double contact_time() const { return last_touch - first_touch; }

    /** They touch now. @param force between them [N] @return whether it is the largest so far */
    bool note(double time, double force);
    /** What casts doubt on the figures: less than four faces of elements touch where the force is largest; "": nothing. */
    std::string doubt() const;
    /** Of figures that put_into() adds. */
    static std::vector<std::string> names() { return {"peak_force", "contact_time", "first_contact"}; }
    /** Beside what is known of them. @pre touched() */
    void put_into(nlohmann::json &figures, const ReferencesSection &known) const;
    /** @param between "bodies", say @pre touched() */
    std::string text(const std::string &between) const;
    void        visit_state(base::StateVisitor &visitor);
  };
} // namespace apps

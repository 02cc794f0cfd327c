#pragma once

#include "apps/scene/section.h"
#include "base/state.h"

#include <nlohmann/json_fwd.hpp>

namespace apps
{
  /** Section "References": known answers of an impact. */
  struct ReferencesSection
  {
    double peak_force = 0, contact_time = 0; ///< [N], [s]; 0: not known

    void declare(Section &root);
  };

  /** How two bodies have touched, of every step. */
  struct ContactFigures
  {
    double peak_force = 0, peak_time = 0;     ///< largest resultant on a body [N], and when [s]
    double first_touch = -1, last_touch = -1; ///< [s]; -1: never

    bool   touched() const { return first_touch >= 0; }
    double contact_time() const { return last_touch - first_touch; }

    /** They touch now. @param force between them [N] */
    void note(double time, double force);
    /** peak_force, contact_time and first_contact, beside what is known of them. @pre touched() */
    void        put_into(nlohmann::json &figures, const ReferencesSection &known) const;
    std::string text() const; ///< @pre touched()
    void        visit_state(base::StateVisitor &visitor);
  };
} // namespace apps

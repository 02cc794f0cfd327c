#pragma once

#include "apps/scene/section.h"
#include "dem/laws/linear_contact.h"

namespace apps
{
  /** How particles touch a wall or the surface of a body. */
  inline void declare_contact(Section &s, dem::LinearContactParameters &contact)
  {
    s.number("Effective modulus", contact.effective_modulus, "Pa", Range::positive(), Need::required)
      .means("E*: normal stiffness with a sphere of radius r is pi r E*; with a disc 2 t E*");
    s.number("Stiffness ratio", contact.stiffness_ratio, "-", Range::positive(), Need::optional)
      .means("Normal over shear stiffness");
    s.number("Friction coefficient", contact.friction_coefficient, "-", Range::at_least(0), Need::optional)
      .means("Shear force that sliding keeps over the normal one");
  }
} // namespace apps

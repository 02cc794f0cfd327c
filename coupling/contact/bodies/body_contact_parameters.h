#pragma once

namespace coupling::bodies
{
  /** Form of the force between two overlapping bodies (doc/theory/body-contact.md). */
  enum class BodyContactForm
  {
    potential, ///< slope of an energy of the overlap
    penalty    ///< in proportion to the volume of the overlap
  };

  /** How deformable bodies push and rub each other. */
  struct BodyContactParameters
  {
    BodyContactForm form                 = BodyContactForm::potential;
    double          stiffness            = 0; ///< k_v [N/m^3]: pressure over the overlap of two flat surfaces
    double          shear_ratio          = 1; ///< stiffness against sliding over k_v [-]
    double          friction_coefficient = 0; ///< mu [-]
    bool            self_contact         = false;
  };
} // namespace coupling::bodies

#include "coupling/contact/contact_motion.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  template <int dim>
  ContactMotion<dim>::ContactMotion(const fem::Solid<dim>          &solid,
                                    fem::ExplicitSolver<dim>       &motion_,
                                    SolidParticipant<dim>          &participant_,
                                    const std::vector<std::string> &rigid_)
    : motion(motion_)
    , participant(participant_)
    , bodies(solid, participant_)
    , rigid(solid, motion_, participant_, rigid_)
  {
  }

  template <int dim>
  double ContactMotion<dim>::step() const
  {
    return step_with_contacts(motion, bodies.stiffest());
  }

  template <int dim>
  void ContactMotion<dim>::advance(const double rest)
  {
    constexpr double rounding = 1e-12;
    const double     length   = rest / std::max(1.0, std::ceil(rest / step() * (1 - rounding)));
    bodies.push(kick_of(length, last_step));
    rigid.drive(last_step > 0 ? kick_of(length, last_step) : 0.5 * length, length);
    participant.advance(length, 1);
    bodies.find();
    last_step = length;
  }

  template <int dim>
  void ContactMotion<dim>::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("last_step", last_step);
    bodies.visit_state(visitor);
    rigid.visit_state(visitor);
  }

  template <int dim>
  double step_with_contacts(const fem::ExplicitSolver<dim> &motion, const double added)
  {
    const double safety = motion.step() / motion.critical_step();
    return 2 * safety / std::sqrt(motion.largest_element_eigenvalue() + added);
  }

  template double step_with_contacts(const fem::ExplicitSolver<2> &, double);
  template double step_with_contacts(const fem::ExplicitSolver<3> &, double);
  template class ContactMotion<2>;
  template class ContactMotion<3>;
} // namespace coupling

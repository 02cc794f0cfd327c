#include "apps/runs/continuum/softening_watch.h"

#include "apps/process/mpi_session.h"

namespace apps
{
  namespace
  {
    constexpr double through_and_through = 0.999; // damage that has no way to grow by anything to speak of

    template <int dim>
    std::vector<double> damage_of(fem::Solid<dim> &solid)
    {
      std::vector<double> damage;
      solid.visit_histories([&damage](const fem::PointQuantity &of, const double *value) {
        if (of.role == fem::PointQuantity::Role::damage)
          damage.push_back(*value);
      });
      return damage;
    }

    bool grows(const std::vector<double> &before, const std::vector<double> &now)
    {
      if (before.size() != now.size())
        return false;
      for (std::size_t i = 0; i < now.size(); ++i)
        if (!(now[i] > before[i] || now[i] > through_and_through))
          return false;
      return true;
    }
  } // namespace

  template <int dim>
  void SofteningWatch<dim>::update(fem::Solid<dim> &solid, const double force)
  {
    std::vector<double> now     = damage_of(solid);
    const bool          damaged = on_any_rank(!now.empty()), stands = on_any_rank(!grows(damage, now));
    in_a_row   = damaged && !stands && force < last_force ? in_a_row + 1 : 0;
    damage     = std::move(now);
    last_force = force;
  }

  template <int dim>
  void SofteningWatch<dim>::visit_state(base::StateVisitor &visitor, fem::Solid<dim> &solid)
  {
    visitor.scalar("softening_force", last_force);
    visitor.scalar("softening_states", in_a_row);
    damage = damage_of(solid);
  }

  template class SofteningWatch<2>;
  template class SofteningWatch<3>;
} // namespace apps

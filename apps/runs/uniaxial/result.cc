#include "apps/runs/uniaxial/result.h"

namespace apps
{
  namespace
  {
    void visit_counts(base::StateVisitor &visitor, const std::string &when, dem::Counts &counts)
    {
      const auto count = [&](const char *what, std::size_t &value) {
        auto stored = static_cast<std::int64_t>(value);
        visitor.scalar(when + "_" + what, stored);
        value = static_cast<std::size_t>(stored);
      };
      count("particles", counts.particles);
      count("links", counts.links);
      count("contacts", counts.contacts);
      count("broken", counts.broken);
    }

    void visit_energy(base::StateVisitor &visitor, dem::EnergyAccount &energy)
    {
      visitor.scalar("energy_initial", energy.initial);
      visitor.scalar("energy_external_work", energy.external_work);
      visitor.scalar("energy_gravity", energy.gravity);
      visitor.scalar("energy_kinetic", energy.kinetic);
      visitor.scalar("energy_elastic", energy.elastic);
      visitor.scalar("energy_damage", energy.damage);
      visitor.scalar("energy_friction", energy.friction);
      visitor.scalar("energy_released", energy.released);
      visitor.scalar("energy_damping", energy.damping);
    }
  } // namespace

  void UniaxialResult::visit_state(base::StateVisitor &visitor)
  {
    apps::visit_state(visitor, start);
    notes.name = name_of(load);
    notes.visit_state(visitor);
    visit_energy(visitor, energy);
    visitor.scalar("worst_balance_error", worst_balance_error);
    visitor.scalar("time_step", time_step);
    visit_counts(visitor, "start", at_start);
    visit_counts(visitor, "end", at_end);
    visitor.scalar("steps", steps);
    visitor.scalar("link_updates", link_updates);
    visitor.scalar("stepping_seconds", stepping_seconds);
    visitor.column("strain", strain);
    visitor.column("stress", stress);
    visitor.column("link_classes", link_classes);
    visitor.column("emission_figures", emission);
    visitor.scalar("fracture_zone_width", fracture_zone_width);
  }
} // namespace apps

#include "dem/specimen/core.h"

#include <string>

namespace dem
{
  void SpecimenCore::visit_state(base::StateVisitor &visitor)
  {
    particles.visit_state(visitor);
    bonds.visit_state(visitor, "bonds", particles.count);
    contacts.visit_state(visitor, "contacts", particles.count);
    search.visit_state(visitor);
    cracks.visit_state(visitor);
    emission.visit_state(visitor);
    if (parameters.physics.periodic)
      for (int c = 0; c < 9; ++c)
        visitor.scalar("cell/stress_moment_" + std::to_string(c), stress_moment.data()[c]);
    visitor.scalar("step", step_count);
    visitor.scalar("time", time);
    visitor.scalar("time_step", time_step);
    visitor.scalar("last_step", last_step);
    visitor.scalar("longest_step", longest_step);
    visitor.scalar("damping", parameters.damping);
    visitor.scalar("largest_turn", largest_turn);
    book.visit_state(visitor);
    overlaps.visit_state(visitor);
    if (contact_law->stiffens())
      stiffening.visit_state(visitor);
    held.visit_state(visitor);
    clumps.visit_state(visitor);
    kicks.visit_state(visitor);
    visit_glide(visitor);
    gather_wall_contacts();
    surfaces.visit_state(visitor);
    base::Column kinetic(accounts.size());
    for (std::size_t b = 0; b < kinetic.size(); ++b)
      kinetic[b] = accounts[b].kinetic;
    visitor.column("energy/kinetic", kinetic);
    for (std::size_t b = 0; b < accounts.size(); ++b)
      accounts[b].kinetic = kinetic.at(b);
  }
} // namespace dem

#include "dem/specimen/rigid_clumps.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/specimen/core.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dem
{
  namespace
  {
    void refuse_clump(const RigidClump &clump, const bool planar)
    {
      if (clump.particles.empty())
        throw base::InputError("Clump: has no particle.");
      if (!(clump.mass > 0 && std::isfinite(clump.mass)))
        throw base::InputError("Clump: mass of " + base::number_text(clump.mass) + " kg: must be above 0.");
      const bool turns =
        planar ? clump.inertia(2, 2) > 0 : clump.inertia.ldlt().isPositive() && clump.inertia.determinant() > 0;
      if (!turns || !clump.inertia.allFinite())
        throw base::InputError("Clump: its inertia must be symmetric and positive.");
    }
  } // namespace

  std::size_t ClumpReadings::size() const { return core->clumps.size(); }

  ClumpState ClumpReadings::state(const std::size_t number) const { return core->clumps.state(number); }

  std::optional<std::size_t> ClumpReadings::of(const std::size_t particle) const
  {
    const std::int32_t clump = core->particles.clump_of(static_cast<std::size_t>(core->slot.at(particle)));
    return clump < 0 ? std::nullopt : std::optional<std::size_t>(clump);
  }

  std::size_t RigidClumps::add(const RigidClump &clump)
  {
    core->refuse_late("Clumps");
    const bool planar = core->parameters.physics.dimension == 2;
    refuse_clump(clump, planar);
    Particles        &p = core->particles;
    std::vector<bool> pebble(p.count, false);
    p.body.resize(p.count, Particles::alone);
    double whole = 0;
    for (const std::size_t number : clump.particles)
      {
        const auto i = static_cast<std::size_t>(core->slot.at(number));
        if (p.clump_of(i) >= 0 || p.inverse_mass[record_size * i] == 0)
          throw base::InputError("Clump: particle " + std::to_string(number + 1) +
                                 " is held, left to a partner or a pebble of another clump.");
        pebble[i] = true;
        whole += p.mass[i];
      }
    std::vector<std::int32_t> members;
    std::vector<double>       shares;
    for (std::size_t i = 0; i < p.count; ++i)
      if (pebble[i])
        {
          members.push_back(static_cast<std::int32_t>(i));
          shares.push_back(p.mass[i] / whole);
          p.body[i] = static_cast<std::int32_t>(core->clumps.size());
          p.mass[i] = p.inertia[i] = 0;
          std::fill_n(&p.inverse_mass[record_size * i], 6, 0.0);
        }
    core->clumps.add(clump, members, shares, p, planar);
    core->accounts.resize(particle_blocks(p.count) + 1);
    core->remove_bonds(pebble);
    core->remove_contacts_within_bodies();
    const double step =
      core->bond_law->bonds() ? core->stable() : std::min(core->stable(), core->step_of_lone_particles());
    core->longest_step = core->time_step = core->parameters.step_factor * step;
    return core->clumps.size() - 1;
  }
} // namespace dem

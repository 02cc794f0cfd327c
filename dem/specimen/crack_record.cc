#include "dem/specimen/crack_record.h"

#include "dem/specimen/results.h"

namespace dem
{
  namespace
  {
    /** From the first end of a link to where it acts [m]. */
    double first_arm(const Particles &particles, const LinkSet &bonds, const std::size_t l, const double length)
    {
      return 0.5 * (length + particles.radius_of(bonds.first[l]) - particles.radius_of(bonds.second[l]));
    }
  } // namespace

  void CrackRecord::log(const Particles   &particles,
                        const LinkSet     &bonds,
                        const LinkReader  &link,
                        const std::size_t  l,
                        const double       time,
                        const std::int64_t step)
  {
    const LinkView &seen = link.view();
    const double    arm  = first_arm(particles, bonds, l, seen.length);
    for (const BrokenElement &broken : link.broken_elements())
      {
        Break event;
        event.time    = time;
        event.step    = step;
        event.ends    = {bonds.first[l], bonds.second[l]};
        event.image   = bonds.periodic ? bonds.image[l] : 0;
        event.pair    = static_cast<std::int32_t>(bonds.pair_of(l));
        event.element = broken.element;
        event.mode    = broken.mode;
        event.place   = particles.position_of(bonds.first[l]) + arm * seen.direction + broken.offset;
        event.normal  = seen.direction;
        event.area    = bonds.area[l] * broken.share;
        log(event);
      }
  }

  void CrackRecord::log(const Break &event)
  {
    if (!breaks.knows(event))
      breaks.add(event);
  }

  void CrackRecord::note(Particles &particles, const LinkSet &bonds, const LinkReader &link, const std::size_t l)
  {
    const std::int32_t    J = bonds.first[l], K = bonds.second[l];
    const Eigen::Vector3d branch     = branch_of(particles, bonds, l);
    const double          dissipated = link.damage_dissipation(), length = branch.norm();
    const double          arm     = first_arm(particles, bonds, l, length);
    const Eigen::Vector3d contact = particles.position_of(J) + arm / length * branch;
    damage_energy += dissipated;
    geometry.insert(geometry.end(), branch.data(), branch.data() + 3);
    geometry.insert(geometry.end(), contact.data(), contact.data() + 3);
    geometry.insert(geometry.end(), {dissipated, 0.0});
    ++particles.broken_links[J];
    ++particles.broken_links[K];
    ends.push_back(J);
    ends.push_back(K);
  }

  std::size_t CrackRecord::count_of(const std::vector<bool> &is_of) const
  {
    std::size_t found = 0;
    for (std::size_t i = 0; i < ends.size(); i += 2)
      found += is_of[static_cast<std::size_t>(ends[i])] || is_of[static_cast<std::size_t>(ends[i + 1])] ? 1 : 0;
    return found;
  }

  void CrackRecord::append(LinkOutput &out, const Particles &particles, const bool pairs) const
  {
    for (std::size_t i = 0; i < ends.size(); i += 2)
      {
        const std::int32_t first = ends[i], second = ends[i + 1];
        out.ends.push_back(
          {static_cast<std::size_t>(particles.number[first]), static_cast<std::size_t>(particles.number[second])});
        out.kind.push_back(LinkOutput::broken);
        if (pairs)
          out.pair.push_back(particles.pair_of(first, second));
        out.damage.push_back(1.0);
        out.strength_damage.push_back(1.0);
        const double         *record = &geometry[record_size * (i / 2)];
        const Eigen::Vector3d branch(record), contact(record + 3);
        const double          arm = 0.5 * (branch.norm() + particles.radius_of(first) - particles.radius_of(second));
        out.dissipated.push_back(record[6]);
        out.load.push_back({contact - arm * branch.normalized(), branch, contact, {0, 0, 0}, {0, 0, 0}});
        for (auto &column : out.history)
          column.push_back(0.0);
        for (auto *column :
             {&out.normal_force, &out.shear_force, &out.normal_stress, &out.shear_stress, &out.normal_strain})
          column->push_back(0.0);
      }
  }

  void CrackRecord::visit_state(base::StateVisitor &visitor)
  {
    breaks.visit_state(visitor);
    visitor.column("crack_log", ends);
    visitor.column("crack_geometry", geometry);
    visitor.scalar("energy/broken_damage", damage_energy);
  }
} // namespace dem

#include "dem/specimen/shown.h"

#include "dem/measures/link_measures.h"
#include "dem/specimen/core.h"

#include <numeric>
#include <utility>

namespace dem
{
  namespace
  {
    std::size_t place_of(const ShownParticles &shown, const Particles &particles, const std::size_t i)
    {
      return shown.as_packed ? static_cast<std::size_t>(particles.number[i]) : i - shown.first;
    }

    std::vector<LinkRange> lines_to_read(const LinkSet &links, const bool in_parts)
    {
      return in_parts ? updated_lines(links) : std::vector<LinkRange>{all_lines(links)};
    }
  } // namespace

  ShownParticles all_of(const Particles &particles) { return {0, particles.count, true}; }

  // --- Particles ---

  Eigen::Vector3d displacement_of(const Particles &particles, const std::size_t i)
  {
    return particles.position_of(i) - Eigen::Vector3d(&particles.reference[3 * i]);
  }

  ParticleKinematics kinematics_of(const SpecimenCore &core, const ShownParticles &shown)
  {
    const Particles   &p = core.particles;
    const std::size_t  n = shown.size();
    ParticleKinematics out;
    out.position.resize(n);
    out.displacement.resize(n);
    out.velocity.resize(n);
    out.angular_velocity.resize(n);
    out.radius.resize(n);
    out.mass.resize(n);
    out.held.assign(n, 0);
    for (const std::int32_t held : core.held.members())
      if (const auto i = static_cast<std::size_t>(held); shown.has(i))
        out.held[place_of(shown, p, i)] = 1;
    for (std::size_t i = shown.first; i < shown.last; ++i)
      {
        const std::size_t to     = place_of(shown, p, i);
        out.position[to]         = p.position_of(i);
        out.displacement[to]     = displacement_of(p, i);
        out.velocity[to]         = Eigen::Vector3d(&p.velocity[record_size * i]) + p.cell.gradient() * p.position_of(i);
        out.angular_velocity[to] = Eigen::Vector3d(&p.velocity[record_size * i + 3]);
        out.radius[to]           = p.radius_of(i);
        out.mass[to]             = core.mass_of(i);
      }
    return out;
  }

  LinkEffects effects_of_links(const SpecimenCore &core, const ShownParticles &shown, const bool in_parts)
  {
    return {moments_of_links(core, shown, in_parts), damage_of_links(core, shown, in_parts)};
  }

  std::vector<Eigen::Matrix3d>
  moments_of_links(const SpecimenCore &core, const ShownParticles &shown, const bool in_parts)
  {
    std::vector<Eigen::Matrix3d> moments(shown.size(), Eigen::Matrix3d::Zero());
    for (const LinkSet *links : {&core.bonds, &core.contacts})
      for (const LinkRange &lines : lines_to_read(*links, in_parts))
        each_stress_moment(core.particles, *links, lines, [&](const std::size_t i, const Eigen::Matrix3d &moment) {
          if (shown.has(i))
            moments[i - shown.first] += moment;
        });
    return moments;
  }

  std::vector<double> damage_of_links(const SpecimenCore &core, const ShownParticles &shown, const bool in_parts)
  {
    std::vector<double> damage(shown.size(), 0.0);
    LinkReader          reader(core.particles, core.bonds, *core.bond_law);
    for (const LinkRange &lines : lines_to_read(core.bonds, in_parts))
      each_living(core.bonds, lines, [&](const std::size_t l) {
        if (core.bonds.is_broken(l))
          return;
        reader.read(l);
        const double lost = reader.damage().stiffness;
        for (const std::int32_t end : {core.bonds.first[l], core.bonds.second[l]})
          if (const auto i = static_cast<std::size_t>(end); shown.has(i))
            damage[i - shown.first] += lost;
      });
    return damage;
  }

  void
  add_moments_of_surfaces(const SpecimenCore &core, const ShownParticles &shown, std::vector<Eigen::Matrix3d> &moments)
  {
    const auto add = [&](const std::int32_t particle, const Eigen::Matrix3d &moment) {
      if (const auto i = static_cast<std::size_t>(particle); shown.has(i))
        moments[i - shown.first] += moment;
    };
    for (const SurfaceContact &contact : core.surfaces.list())
      add(contact.particle, contact.distance * contact.direction * contact.force.transpose());
    for (const SurfaceBonds &glue : core.surfaces.bonds())
      for (std::size_t bond = 0; bond < glue.count(); ++bond)
        if (glue.is_alive(bond))
          add(glue.particle_of(bond), glue.branch(bond) * glue.force(bond).transpose());
  }

  double volume_of(const SpecimenCore &core, const std::size_t i)
  {
    const double space = core.space_per_solid * core.particles.cell.deformation().determinant(); // 1 without a cell
    return space * core.shape.volume(core.particles.radius_of(i));
  }

  Eigen::Matrix3d stress_of(const SpecimenCore &core, const std::size_t i, const Eigen::Matrix3d &moments)
  {
    const Eigen::Matrix3d moment = moments / volume_of(core, i);
    return 0.5 * (moment + moment.transpose());
  }

  double mean_damage_of(const Particles &particles, const std::size_t i, const double damage)
  {
    return particles.made_links[i] > 0 ? (damage + particles.broken_links[i]) / particles.made_links[i] : 0.0;
  }

  ParticleOutput particles_of(const SpecimenCore &core, const ShownParticles &shown, LinkEffects effects)
  {
    const Particles  &p = core.particles;
    const std::size_t n = shown.size();
    ParticleOutput    out;
    static_cast<ParticleKinematics &>(out) = kinematics_of(core, shown);
    add_moments_of_surfaces(core, shown, effects.moments);
    out.damage.resize(n);
    out.broken_links.resize(n);
    out.volume.resize(n);
    out.stress.resize(n);
    out.material.resize(p.material.empty() ? 0 : n);
    for (std::size_t i = shown.first; i < shown.last; ++i)
      {
        const std::size_t to = place_of(shown, p, i), at = i - shown.first;
        out.damage[to]       = mean_damage_of(p, i, effects.damage[at]);
        out.broken_links[to] = p.broken_links[i];
        if (!p.material.empty())
          out.material[to] = p.material[i];
        out.volume[to] = volume_of(core, i);
        out.stress[to] = stress_of(core, i, effects.moments[at]);
      }
    return out;
  }

  // --- Links ---

  LinkOutput without_links(const SpecimenCore &core)
  {
    LinkOutput out;
    for (const LinkQuantity &quantity : core.bond_law->columns())
      if (quantity.shown && core.bond_law->bonds())
        out.quantities.push_back(quantity);
    out.history.resize(out.quantities.size());
    return out;
  }

  namespace
  {
    void append_line(LinkOutput       &out,
                     const Particles  &particles,
                     const LinkSet    &links,
                     const LinkLaw    &law,
                     const LinkReader &reader,
                     const std::size_t l)
    {
      if (links.several_pairs)
        out.pair.push_back(links.pair[l]);
      const LinkView &view     = reader.view();
      const bool      cohesive = law.bonds() && !links.is_broken(l);
      const double    normal = view.force.dot(view.direction), shear = (view.force - normal * view.direction).norm();
      out.ends.push_back({static_cast<std::size_t>(particles.number[links.first[l]]),
                          static_cast<std::size_t>(particles.number[links.second[l]])});
      out.kind.push_back(cohesive ? LinkOutput::cohesive : LinkOutput::contact);
      out.normal_force.push_back(normal);
      out.shear_force.push_back(shear);
      out.normal_stress.push_back(normal / links.area[l]);
      out.shear_stress.push_back(shear / links.area[l]);
      out.normal_strain.push_back(view.strain);
      out.damage.push_back(reader.damage().stiffness);
      out.strength_damage.push_back(reader.damage().strength);
      out.dissipated.push_back(cohesive ? reader.damage_dissipation() : 0.0);
      out.load.push_back(load_at(particles, links, l));
      std::size_t shown = 0;
      for (std::size_t c = 0; c < links.quantities.size(); ++c)
        if (law.bonds() && links.quantities[c].shown)
          out.history[shown++].push_back(links.history[c][l]);
      for (; shown < out.history.size(); ++shown)
        out.history[shown].push_back(0.0);
    }

    const LinkLaw &law_of(const SpecimenCore &core, const LinkSet &links)
    {
      return &links == &core.bonds ? *core.bond_law : *core.contact_law;
    }

    /** Of some lines those that begin at particles that are shown; calls took(line) for each that is. */
    template <typename Took>
    void append(LinkOutput           &out,
                const SpecimenCore   &core,
                const ShownParticles &shown,
                const LinkSet        &links,
                const LinkRange      &lines,
                const Took           &took)
    {
      const LinkLaw &law = law_of(core, links);
      LinkReader     reader(core.particles, links, law);
      each_living(links, lines, [&](const std::size_t l) {
        if (!shown.has(static_cast<std::size_t>(links.first[l])))
          return;
        reader.read(l);
        if (law.waits() && reader.phase() == LinkPhase::apart)
          return;
        append_line(out, core.particles, links, law, reader, l);
        took(l);
      });
    }
  } // namespace

  LinkOutput links_among(const SpecimenCore &core, const LinkSet &links, const LinkRange &lines)
  {
    LinkOutput out = without_links(core);
    append(out, core, all_of(core.particles), links, lines, [](std::size_t) {});
    return out;
  }

  LinkOutput broken_links(const SpecimenCore &core)
  {
    LinkOutput out = without_links(core);
    core.cracks.append(out, core.particles, core.bond_law->several());
    return out;
  }

  GlueOutput glue_of(const SpecimenCore &core)
  {
    GlueOutput out;
    for (const SurfaceBonds &glue : core.surfaces.bonds())
      glue.show(out, core.particles, core.surfaces.surfaces()[static_cast<std::size_t>(glue.surface())]);
    return out;
  }

  ShownLinks links_of(const SpecimenCore &core, const ShownParticles &shown, const bool in_parts)
  {
    ShownLinks  out{without_links(core), {}};
    std::size_t before = 0;
    for (const LinkSet *links : {&core.bonds, &core.contacts})
      {
        for (const LinkRange &lines : lines_to_read(*links, in_parts))
          append(out.links, core, shown, *links, lines,
                 [&](const std::size_t l) { out.line.push_back(static_cast<std::int64_t>(before + l)); });
        before += links->count;
      }
    core.cracks.append(out.links, core.particles, core.bond_law->several());
    out.links.glue         = glue_of(core);
    const std::size_t read = out.line.size();
    out.line.resize(out.links.ends.size() + out.links.glue.particle.size());
    std::iota(out.line.begin() + static_cast<std::ptrdiff_t>(read), out.line.end(), static_cast<std::int64_t>(before));
    return out;
  }
} // namespace dem

#include "dem/specimen/rank_output.h"

#include "dem/ranks/bricks.h"
#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"
#include "dem/specimen/observation.h"
#include "dem/specimen/shown.h"

#include <algorithm>
#include <unordered_map>

namespace dem
{
  namespace
  {
    ShownParticles particles_of_rank(const SpecimenCore &core, const std::size_t rank, const std::size_t ranks)
    {
      if (core.shares())
        {
          const auto [first, last] = core.own_particles();
          return {first, last};
        }
      const std::size_t count = core.particles.count, bricks = particle_blocks(count);
      const auto begin = [&](const std::size_t r) { return std::min(bricks * r / ranks * particles_per_brick, count); };
      return {begin(rank), begin(rank + 1)};
    }

    /** Some rows of a column; of one that there is not, none. */
    template <typename Value>
    void keep(std::vector<Value> &column, const std::vector<std::size_t> &rows)
    {
      if (column.empty())
        return;
      for (std::size_t to = 0; to < rows.size(); ++to)
        column[to] = column[rows[to]];
      column.resize(rows.size());
    }

    void keep(LinkOutput &links, const std::vector<std::size_t> &rows)
    {
      keep(links.ends, rows);
      keep(links.kind, rows);
      keep(links.pair, rows);
      keep(links.load, rows);
      for (std::vector<double> *column :
           {&links.normal_force, &links.shear_force, &links.normal_stress, &links.shear_stress, &links.normal_strain,
            &links.damage, &links.strength_damage, &links.dissipated})
        keep(*column, rows);
      for (std::vector<double> &column : links.history)
        keep(column, rows);
    }

    void keep(GlueOutput &glue, const std::vector<std::size_t> &rows)
    {
      keep(glue.particle, rows);
      keep(glue.surface, rows);
      keep(glue.anchor, rows);
      keep(glue.moved, rows);
      keep(glue.torn, rows);
      for (std::vector<double> *column : {&glue.normal_force, &glue.shear_force, &glue.normal_stress,
                                          &glue.shear_stress, &glue.normal_strain, &glue.damage})
        keep(*column, rows);
    }

    /** Of what broke and is glued, too, that which begins at particles of a rank. */
    void keep_own(ShownLinks &all, const SpecimenCore &core, const ShownParticles &own)
    {
      const auto is_own = [&](const std::size_t number) {
        return own.has(static_cast<std::size_t>(core.slot[number]));
      };
      std::vector<std::size_t> of_links, of_glue, of_lines;
      for (std::size_t l = 0; l < all.links.ends.size(); ++l)
        if (is_own(all.links.ends[l][0]))
          of_links.push_back(l);
      of_lines = of_links;
      for (std::size_t g = 0; g < all.links.glue.particle.size(); ++g)
        if (is_own(all.links.glue.particle[g]))
          {
            of_glue.push_back(g);
            of_lines.push_back(all.links.ends.size() + g);
          }
      keep(all.line, of_lines);
      keep(all.links, of_links);
      keep(all.links.glue, of_glue);
    }

    /** The points that links join: particles of a rank, and others as they are met. */
    class Points
    {
    public:
      Points(const SpecimenCore &from, const ShownParticles &of, RankOutput &output)
        : core(from)
        , own(of)
        , out(output)
      {
        out.points.position     = out.particles.position;
        out.points.displacement = out.particles.displacement;
        out.points.radius       = out.particles.radius;
        out.number_of_point     = out.number;
      }

      std::size_t place_of(const std::size_t number)
      {
        const auto i = static_cast<std::size_t>(core.slot[number]);
        if (own.has(i))
          return i - own.first;
        const auto [found, is_new] = others.try_emplace(i, out.number_of_point.size());
        if (is_new)
          add(i);
        return found->second;
      }

    private:
      void add(const std::size_t i)
      {
        const Particles &p = core.particles;
        out.points.position.push_back(p.position_of(i));
        out.points.displacement.push_back(displacement_of(p, i));
        out.points.radius.push_back(p.radius_of(i));
        out.number_of_point.push_back(p.number[i]);
      }

      const SpecimenCore                          &core;
      ShownParticles                               own;
      RankOutput                                  &out;
      std::unordered_map<std::size_t, std::size_t> others;
    };
  } // namespace

  RankOutput::RankOutput(const ObservedSpecimen &specimen, const std::size_t rank, const std::size_t ranks)
  {
    const SpecimenCore  &core = core_in_parts_of(specimen);
    const ShownParticles own  = particles_of_rank(core, rank, ranks);
    several_materials         = !core.particles.material.empty();
    glued                     = std::any_of(core.surfaces.bonds().begin(), core.surfaces.bonds().end(),
                                            [](const SurfaceBonds &glue) { return glue.count() > 0; });
    particles                 = particles_of(core, own, effects_of_links(core, own, true));
    number.assign(core.particles.number.begin() + static_cast<std::ptrdiff_t>(own.first),
                  core.particles.number.begin() + static_cast<std::ptrdiff_t>(own.last));
    ShownLinks shown = links_of(core, own, true);
    keep_own(shown, core, own);
    links = std::move(shown.links);
    line  = std::move(shown.line);
    Points joined(core, own, *this);
    for (std::array<std::size_t, 2> &ends : links.ends)
      ends = {joined.place_of(ends[0]), joined.place_of(ends[1])};
    for (std::size_t &particle : links.glue.particle)
      particle = joined.place_of(particle);
  }
} // namespace dem

#include "apps/bench/size_effect_beams.h"

#include "apps/bench/scene_variant.h"
#include "apps/runs/structure/promotion.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace apps
{
  namespace
  {
    /** Shape of the beams, over their depth. */
    constexpr double length = 3, span = 2.5;
    /** Of a smooth beam, from mid-span: where the elastic stress of the lower face is 60 % of the largest, 0.4 of half the span. */
    constexpr double half_of_smooth_core = 0.4 * 0.5 * span;
    /** Load over the peak at which a beam has shown its strength. */
    constexpr double peak_is_past = 0.7;

    /** Entries of one beam, put down one after the other. In space z is up, in the plane y. */
    class Entries
    {
    public:
      explicit Entries(const int dimension)
        : plane(dimension == 2)
      {
      }
      const char *up() const { return plane ? "y" : "z"; }
      /** A place or lengths: along the beam, across it, upwards. */
      std::string at(const double along, const double across, const double upwards) const
      {
        return plane ? fmt::format("{:.9g}, {:.9g}, {:.9g}", along, upwards, across) :
                       fmt::format("{:.9g}, {:.9g}, {:.9g}", along, across, upwards);
      }
      void set(const std::string &entry, const std::string &value) { all.push_back(entry + "=" + value); }
      void set(const std::string &entry, const double value) { set(entry, fmt::format("{:.9g}", value)); }
      void box(const std::string &section, const std::string &low, const std::string &high)
      {
        set(section + "/Shape", "box");
        set(section + "/Lower", low);
        set(section + "/Upper", high);
      }
      std::vector<std::string> all;

    private:
      bool plane;
    };

    struct BeamShape
    {
      double depth, width, middle, notch;
      double half_core;

      double support(const double side) const { return middle + 0.5 * side * span * depth; }
    };

    BeamShape shape_of(const StructureModel &one, const BeamCase &beam)
    {
      const auto &core = one.handshakes.handshakes.front();
      BeamShape   shape{};
      shape.depth     = beam.size * one.bending_test.depth;
      shape.width     = one.bending_test.width;
      shape.middle    = 0.5 * length * shape.depth;
      shape.notch     = beam.notched ? notch_of_beams * shape.depth : 0;
      shape.half_core = 0.5 * (core.high[0] - core.low[0]);
      if (!beam.notched)
        shape.half_core = std::max(shape.half_core, half_of_smooth_core * shape.depth);
      return shape;
    }

    void put_notch(Entries &entries, const BeamShape &s)
    {
      constexpr double slit = 0.9e-3, lip = 3e-3, foot = 2.5e-3,
                       high = 4e-3; // half its width, and how far groups reach
      const double top      = std::max(s.notch, high);
      if (s.notch > 0)
        entries.box("Voids/notch", entries.at(s.middle - slit, -1, -1), entries.at(s.middle + slit, 1, s.notch));
      else
        entries.box("Voids/notch", entries.at(-2, -2, -2), entries.at(-1, -1, -1)); // beside the beam
      entries.box("Groups/left lip", entries.at(s.middle - slit - lip, -1, top - high),
                  entries.at(s.middle - slit, 1, top));
      entries.box("Groups/right lip", entries.at(s.middle + slit, -1, top - high),
                  entries.at(s.middle + slit + lip, 1, top));
      entries.box("Groups/load", entries.at(s.middle - foot, -1, s.depth - foot),
                  entries.at(s.middle + foot, 1, s.depth + 1));
    }

    constexpr std::array sides = {std::pair{"left support", -1.0}, std::pair{"right support", 1.0}};

    /** Elements as large as those of the smallest, so that they fit the core, on a line of nodes each side. */
    void put_solid(Entries &entries, const BeamShape &s, const StructureModel &one, const int size)
    {
      const auto &divisions = one.continuum.mesh.box_divisions;
      entries.set("Continuum/Mesh/Box/Size", entries.at(length * s.depth, s.width, s.depth));
      entries.set("Continuum/Mesh/Box/Divisions x", static_cast<double>(size * divisions[0]));
      entries.set(std::string("Continuum/Mesh/Box/Divisions ") + entries.up(),
                  static_cast<double>(size * divisions[one.dimension == 2 ? 1 : 2]));
      entries.set("Handshakes/core/Low", entries.at(s.middle - s.half_core, -1, -1));
      entries.set("Handshakes/core/High", entries.at(s.middle + s.half_core, 1, s.depth + 1));
      for (const auto &[name, side] : sides)
        {
          const std::string support = std::string("Continuum/Supports/") + name;
          entries.set(support + "/From", entries.at(s.support(side), 0, 0));
          if (one.dimension == 3)
            entries.set(support + "/To", entries.at(s.support(side), s.width, 0));
        }
    }

    /** Another packing and other places of aggregates for each geometry. */
    void put_particles(Entries &entries, const BeamShape &s, const StructureModel &one, const int geometry)
    {
      const bool grown = one.source.source == SpecimenSection::Source::genesis;
      entries.set(grown ? "Specimen/Genesis/Size" : "Specimen/Box size",
                  entries.at(length * s.depth, s.width, s.depth));
      entries.set(grown ? "Specimen/Genesis/Seed" : "Specimen/Generator/Seed", geometry);
      entries.set("Specimen/Mix/Seed", geometry);
    }

    /** Where particles do: a row of them, as narrow as finds one in each place across. */
    void put_particle_supports(Entries &entries, const BeamShape &s, const double radius)
    {
      for (const auto &[name, side] : sides)
        {
          entries.box(std::string("Groups/") + name, entries.at(s.support(side) - 1.5 * radius, -1, -1),
                      entries.at(s.support(side) + 1.5 * radius, 1, 2.5 * radius));
          entries.set(std::string("Supports/") + name + "/Displacement " + entries.up(), "0");
        }
    }

    double radius_of(const SpecimenSection &source)
    {
      return source.source == SpecimenSection::Source::genesis ? source.genesis.mean_radius : source.generator.radius;
    }

    /** The same beam without elements. */
    StructureModel particles_alone(const StructureModel &model)
    {
      StructureModel alone;
      alone.source       = model.source;
      alone.mix          = model.mix;
      alone.material     = model.material;
      alone.dimension    = model.dimension;
      alone.rotations    = model.rotations;
      alone.voids        = model.voids;
      alone.groups       = model.groups;
      alone.supports     = model.supports;
      alone.probes       = model.probes;
      alone.path         = model.path;
      alone.bending_test = model.bending_test;
      return alone;
    }

    BrokenBeam broken_beam(const CheckedScene &checked, const StructureModel &model, const BeamCase &beam)
    {
      if (model.gravity.acts())
        refuse_scene(checked, "Gravity: this bench compares works of fracture without any weight.");
      const double                start = base::processor_seconds();
      std::optional<dem::Packing> cell;
      const dem::Packing          packing = model.packing(&cell);
      const ParticleMedia         media   = model.media(cell);
      Promotion                   promotion(model, packing, media);
      const std::string           up       = Entries(model.dimension).up();
      const auto                  columns  = promotion.structure().columns();
      const auto                  reaction = std::find_if(columns.begin(), columns.end(),
                                                          [&up](const auto &column) { return column.name == "reaction_load_" + up; });
      if (reaction == columns.end())
        refuse_scene(checked, "Groups/load: this bench needs it driven along " + up + ".");
      const auto load = static_cast<std::size_t>(reaction - columns.begin());
      double     peak = 0, last = 0;
      while (!promotion.structure().finished())
        {
          promotion.structure().advance();
          do
            last = std::fabs(promotion.structure().row().values[load]);
          while (promotion.promote());
          peak = std::max(peak, last);
        }
      const Structure          &structure = promotion.structure();
      const BendingTestSection &test      = model.bending_test;
      BrokenBeam                found;
      found.of        = beam;
      found.depth     = test.depth;
      found.strength  = 1.5 * peak * test.span / (test.width * test.depth * test.depth);
      found.work      = structure.last().external_work / test.ligament();
      found.left      = peak > 0 ? last / peak : 0;
      found.particles = static_cast<double>(structure.network().network.particles());
      found.points    = static_cast<double>(structure.way().points().size() - 1);
      for (const auto &[bonds, damaged] : structure.shared_bonds())
        found.shared =
          std::max(found.shared, bonds > 0 ? static_cast<double>(damaged) / static_cast<double>(bonds) : 0);
      found.balance = structure.last().balance_error();
      found.cost    = base::processor_seconds() - start;
      return found;
    }
  } // namespace

  std::string BeamCase::name() const
  {
    return fmt::format("size {}, geometry {}{}{}", size, geometry, notched ? "" : ", without notch",
                       all_particles ? ", all particles" : "");
  }

  RunRecord BrokenBeam::record() const
  {
    RunRecord kept;
    for (const auto &[value, unit] : {std::pair{depth, "m"},
                                      {strength, "Pa"},
                                      {work, "J/m^2"},
                                      {left, "-"},
                                      {particles, "-"},
                                      {points, "-"},
                                      {shared, "-"},
                                      {balance, "-"},
                                      {cost, "s"}})
      {
        kept.responses.emplace_back(value);
        kept.units.emplace_back(unit);
        kept.reasons.emplace_back();
      }
    kept.seconds = cost;
    return kept;
  }

  BrokenBeam BrokenBeam::read(const BeamCase &of, const RunRecord &record)
  {
    BrokenBeam  beam;
    std::size_t next = 0;
    beam.of          = of;
    for (double *const member : {&beam.depth, &beam.strength, &beam.work, &beam.left, &beam.particles, &beam.points,
                                 &beam.shared, &beam.balance, &beam.cost})
      *member = record.responses.at(next++).value();
    return beam;
  }

  CheckedScene scene_of_beam(const std::string              &scene,
                             const std::vector<std::string> &overrides,
                             const StructureModel           &one,
                             const BeamCase                 &beam)
  {
    const BeamShape s    = shape_of(one, beam);
    const double    path = s.depth / one.bending_test.depth;
    Entries         entries(one.dimension);
    put_particles(entries, s, one, beam.geometry);
    entries.set("Bending test/Span", span * s.depth);
    entries.set("Bending test/Depth", s.depth);
    entries.set("Bending test/Notch depth", s.notch);
    entries.set("Path/End", one.path.end * path);
    entries.set("Path/Step", one.path.step * path);
    if (!beam.whole)
      entries.set("Path/Stop fraction", std::max(one.path.stop_fraction, peak_is_past));
    put_notch(entries, s);
    put_solid(entries, s, one, beam.size);
    if (beam.all_particles)
      put_particle_supports(entries, s, radius_of(one.source));
    return SceneVariant{"beam", beam.name(), entries.all}.of(scene, overrides);
  }

  BrokenBeam broken(const CheckedScene &checked, const BeamCase &beam)
  {
    const StructureModel &model = model_of_kind<StructureModel>(checked, "structure");
    if (!beam.all_particles)
      return broken_beam(checked, model, beam);
    const StructureModel alone = particles_alone(model);
    return broken_beam(checked, alone, beam);
  }
} // namespace apps

#include "apps/drivers/cell/scene.h"

#include "apps/drivers/cell/run.h"
#include "apps/forecasts/duration.h"
#include "apps/scene/physics_section.h"
#include "apps/scene/tension_beyond_apex.h"
#include "apps/scene/value_text.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/specimen_packing.h"
#include "base/voigt.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

namespace apps
{
  namespace
  {
    struct Aim
    {
      bool   stress;
      double value;
    };

    /** "strain 1e-4", "stress -2e6"; nothing if it is neither. */
    std::optional<Aim> aim_in(const std::string &text)
    {
      std::istringstream words(text);
      std::string        kind, value, more;
      if (!(words >> kind >> value) || words >> more || (kind != "strain" && kind != "stress"))
        return std::nullopt;
      const auto number = number_in(value);
      if (!number)
        return std::nullopt;
      return Aim{kind == "stress", *number};
    }
  } // namespace

  void CellScene::declare(Section &root)
  {
    physics.periodic = true;
    SpecimenSection::Use use;
    use.box  = false;
    use.cell = true;
    source.declare(root, physics.dimension, use);
    material.declare(root);
    declare_physics(root, physics);
    time.declare(root);
    declare_loading(root);
    output.declare(root);
  }

  void CellScene::declare_loading(Section &root)
  {
    Section &section = root.section("Loading", "The path that the cell is led along, leg by leg");
    section.integer("Legs", legs, "", Range::between(1, most_legs), Need::optional).means("Legs of the path");
    section.number("Servo time", servo_time, "-", Range::positive(), Need::optional)
      .means("Time constant with which stresses are reached, over the time of a pressure wave across the cell");
    section.number("Strain limit", strain_limit, "-", Range::positive(), Need::optional)
      .means("Largest strain that may be used to reach a stress; beyond, the cell cannot carry it and the path ends");
    section.number("Localised above", localised_above, "-", Range::between(0.01, 0.99), Need::optional)
      .means("Concentration of the strength lost since softening began at which the cell counts as localised; 0.5: a "
             "band of 60 % of it");
    for (int i = 0; i < most_legs; ++i)
      {
        Section &leg =
          section.section(fmt::format("Leg {}", i + 1), "Targets at its end; they are approached evenly in time");
        leg.only_if([this, i] { return i < legs; }, fmt::format("Loading/Legs is at least {}", i + 1));
        leg.number("Duration", path[i].duration, "s", Range::positive(), Need::required).means("Of the leg");
        for (int c = 0; c < 6; ++c)
          {
            path[i].target[c] = "stress 0";
            leg.text(base::voigt_names[c], path[i].target[c], Need::optional)
              .means(c < 3 ? "\"strain VALUE\" [-] or \"stress VALUE\" [Pa], tension positive" :
                             "\"strain VALUE\" (engineering shear) [-] or \"stress VALUE\" [Pa]");
          }
      }
  }

  void CellScene::check() const
  {
    const base::EntryPath root;
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    for (int i = 0; i < legs; ++i)
      for (int c = 0; c < 6; ++c)
        if (!aim_in(path[i].target[c]))
          root.at("Loading")
            .at(fmt::format("Leg {}", i + 1))
            .refuse(base::voigt_names[c],
                    "expected \"strain VALUE\" or \"stress VALUE\", e.g. strain 1e-4 or stress -2e6.");
  }

  CellModel CellScene::model() const
  {
    CellModel model;
    model.source                     = source;
    model.specimen.physics           = physics;
    model.specimen.density           = source.density;
    model.specimen.interaction_ratio = source.interaction_ratio;
    model.specimen.thickness         = source.thickness;
    model.specimen.step_factor       = time.step_factor;
    model.specimen.damping           = time.damping;
    model.material                   = material;
    model.output                     = output;
    model.loading.servo_time         = servo_time;
    model.loading.strain_limit       = strain_limit;
    model.loading.localised_above    = localised_above;
    for (int i = 0; i < legs; ++i)
      {
        dem::CellLeg leg;
        leg.duration = path[i].duration;
        for (int c = 0; c < 6; ++c)
          {
            const bool exists   = physics.dimension == 3 || c < 2 || c == 5;
            const Aim  aim      = *aim_in(path[i].target[c]);
            leg.stress_given[c] = exists && aim.stress;
            leg.target[c]       = exists ? aim.value : 0;
          }
        model.loading.path.push_back(leg);
      }
    return model;
  }

  std::string CellScene::forecast() const
  {
    const base::Stopwatch set_up;
    const CellModel       asked   = model();
    const dem::Packing    packing = make_packing(asked.source, asked.material, physics.dimension);
    dem::Specimen         body(packing, asked.specimen, asked.material.materials());
    dem::CellTest         test(body, asked.loading); // refuses what a run would refuse
    const double          set_up_seconds = set_up.seconds();
    double                duration       = 0;
    for (const dem::CellLeg &leg : asked.loading.path)
      duration += leg.duration;
    std::string text;
    text += fmt::format("  particles    {}\n", body.counts().particles);
    text += fmt::format("  links        {}\n", body.counts().links);
    text += extent_lines(packing, physics.dimension);
    text += lines_of_tension_beyond_apex(asked.material);
    text += MaterialCounts(packing.material_names, body).text();
    if (!test.holds_together())
      text += "  joined       not against every strain: stresses are reached only once particles touch\n";
    text += fmt::format("  time step    {:.4g} s\n", body.time_step());
    const double steps = duration / body.time_step();
    text += fmt::format("  steps        {:.0f}\n", steps);
    const double cost = seconds_per_step(body, [&](const std::int64_t count) { test.advance(count); });
    return text + duration_line(set_up_seconds + steps * cost);
  }

  RunResult CellScene::run(const RunRequest &request) const { return CellRun(request, model()).execute(); }
} // namespace apps

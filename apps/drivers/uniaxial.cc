#include "apps/drivers/uniaxial.h"

#include "apps/drivers/material_counts.h"
#include "apps/drivers/specimen_packing.h"
#include "apps/drivers/static_start.h"
#include "apps/drivers/uniaxial_run.h"
#include "apps/drivers/uniaxial_stage.h"
#include "apps/exit_status.h"
#include "apps/progress.h"
#include "apps/scene/physics_section.h"

#include <fmt/format.h>

#include <chrono>

namespace apps
{
  void UniaxialScene::declare(Section &root)
  {
    specimen.declare(root, physics.dimension);
    material.declare(root);
    declare_physics(root, physics);
    time.declare(root);
    gravity.declare(root);
    loading.declare(root);
    output.declare(root);
  }

  void UniaxialScene::validate(const Section &root) const
  {
    specimen.validate(root, physics.dimension);
    material.validate(root, physics.dimension);
    gravity.validate(root, physics.dimension);
    loading.validate(root, physics.dimension);
  }

  UniaxialModel UniaxialScene::model() const
  {
    UniaxialModel model;
    model.source                     = specimen;
    model.specimen.physics           = physics;
    model.specimen.density           = specimen.density;
    model.specimen.interaction_ratio = specimen.interaction_ratio;
    model.specimen.thickness         = specimen.thickness;
    model.specimen.step_factor       = time.step_factor;
    model.specimen.damping           = time.damping;
    model.specimen.gravity           = gravity.vector();
    model.gravity                    = gravity;
    model.material                   = material;
    model.loading                    = loading;
    model.output                     = output;
    return model;
  }

  namespace
  {
    /** Seconds per step, from as many steps as fit into about half a second. */
    double measured_step_cost(dem::Specimen &model)
    {
      using Clock        = std::chrono::steady_clock;
      const auto   start = Clock::now();
      double       spent = 0;
      std::int64_t steps = 0;
      for (std::int64_t batch = 1; spent < 0.5; batch *= 2)
        {
          model.advance(batch);
          steps += batch;
          spent = std::chrono::duration<double>(Clock::now() - start).count();
        }
      return spent / static_cast<double>(steps);
    }

    std::string megabytes(const std::size_t bytes)
    {
      return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
    }
  } // namespace

  std::string UniaxialScene::forecast() const
  {
    const UniaxialModel asked     = model();
    const dem::Packing  packing   = make_packing(asked.source, asked.material, physics.dimension);
    const auto          materials = asked.material.materials();
    dem::Specimen       body(packing, asked.specimen, materials);
    std::string         text;
    text += fmt::format("  particles    {}\n", body.counts().particles);
    text += fmt::format("  links        {}\n", body.counts().links);
    text += MaterialCounts(packing.material_names, body.particles().material, body.links().law).text();
    text += fmt::format("  time step    {:.4g} s = {} of the bound of its particles\n", body.time_step(),
                        asked.specimen.step_factor);
    text += fmt::format("               {:.4g} s would be critical: sharp, by the largest eigenvalue\n",
                        body.critical_step());
    text += fmt::format("  memory       {} for particles and links\n", megabytes(body.bytes()));
    double steps = 0;
    for (const UniaxialLoad load : asked.loading.tests)
      {
        // Refuses what a run would refuse.
        dem::Specimen           fresh(packing, asked.specimen, materials);
        const dem::UniaxialTest test(fresh, asked.loading.parameters(load));
        const std::int64_t      most = most_steps(asked.loading, load, fresh.time_step());
        if (load == asked.loading.tests.front()) // the grips hold alike in all of them
          text += fmt::format("  basis        {}\n", text_of(test.grip_layers(), asked.loading.grips.parameters()));
        if (load == asked.loading.tests.front())
          if (const StaticStart start = start_statically(fresh, asked.gravity))
            text += fmt::format("  start        {}\n", text_of(*start));
        steps += static_cast<double>(most);
        text += fmt::format("  {:<12} at most {} steps\n", name_of(load), most);
      }
    const double seconds = steps * measured_step_cost(body);
    text += fmt::format("  duration     roughly {} at most, on this machine as it is now\n", duration_text(seconds));
    return text;
  }

  int UniaxialScene::run(const RunRequest &request) const { return UniaxialRun(request, model()).execute(); }
} // namespace apps

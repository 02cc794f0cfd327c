#include "apps/scene/particles/model.h"

#include "apps/scene/entries/emission.h"
#include "apps/scene/entries/gravity.h"
#include "apps/scene/entries/joints.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/precice.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/entries/time.h"
#include "apps/scene/particles/clumps.h"
#include "apps/scene/particles/forces.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/particles/initial_velocity.h"
#include "apps/scene/particles/laboratory_section.h"
#include "apps/scene/particles/more_particles.h"
#include "apps/scene/particles/motion.h"
#include "apps/scene/particles/probes.h"
#include "apps/scene/particles/stops.h"
#include "apps/scene/particles/walls.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    void declare_output(Section &root, OutputSection &output, std::string &horizontal, std::string &vertical)
    {
      declare_for_ranks(root, output);
      Section &section = *root.find_section("Output");
      Entry   &samples = *section.find_entry("Samples");
      samples.means("Rows of series.csv from the start to the end time, besides that of the start; stop conditions are "
                    "checked with each. A test of section Laboratory has so many during its ramp and again from the "
                    "beginning of the loading; whenever it has lasted twice as long, they lie twice as far apart");
      samples.decides = true; // when a stop condition is seen
      section.find_entry("Snapshots")
        ->means("ParaView files from the start to the end time, the first and last state "
                "besides; 0: none at all. Of a test of section Laboratory spread over its rows in the same proportion");
      section.text("Curve horizontal", horizontal, Need::optional)
        .means("Column of series.csv for curve.png; empty: the time. A test of section Laboratory, which draws "
               "stress_strain.png, has a curve.png only where a column is given")
        .housekeeping();
      section.text("Curve vertical", vertical, Need::optional)
        .means(
          "Column of series.csv for curve.png; empty: the stress of a test, the first probe, or the kinetic energy")
        .housekeeping();
    }
  } // namespace

  void declare(Section &root, ParticlesModel &model)
  {
    declare_as_part(root, model);
    declare(root, model.joints);
    declare_course(root, model);
    declare(root, model.precice, "Group", "Whose particles are the vertices of the mesh");
    declare(root, model.laboratory);
  }

  void declare_as_part(Section &root, ParticlesModel &model)
  {
    SpecimenSection::Use use;
    use.genesis = use.other_particles = true;
    declare(root, model.source, model.physics.dimension, use);
    declare(*root.find_section("Specimen"), model.mix);
    declare(root, model.more);
    declare(root, model.material);
    declare_physics(root, model.physics);
    declare(root, model.groups);
    declare(root, model.clumps);
    declare(root, model.motion);
    declare(root, model.forces);
    declare(root, model.walls);
    declare(root, model.initial_velocity);
    declare(root, model.probes);
  }

  void declare_course(Section &root, ParticlesModel &model, const char *const weight)
  {
    declare(root, model.time);
    declare_by_time(root, model.time);
    root.find_section("Time")
      ->number("End time", model.end_time, "s", Range::positive(), Need::required)
      .means("When the run ends, unless a stop condition or the test of section Laboratory ends it before")
      .only_if([&model] { return !model.laboratory.given(); }, "there is no section Laboratory that ends the run");
    declare(root, model.gravity, weight);
    declare(root, model.emission);
    declare(root, model.stops);
    declare_output(root, model.output, model.horizontal, model.vertical);
  }
} // namespace apps

#include "apps/bench/surface.h"

#include "apps/bench/impact_of_bodies.h"
#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/coupled/body.h"
#include "apps/runs/coupled/model.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <cmath>

namespace apps
{
  namespace
  {
    /** Few elements that are as small where it matters: they grow by the square of what they grew by. */
    std::string faster_growth(const CoupledModel &model)
    {
      const auto &g = model.continuum.mesh.box_growth;
      return fmt::format("Continuum/Mesh/Box/Growth={}, {}, {}", g[0] * g[0], g[1] * g[1], g[2] * g[2]);
    }

    std::vector<SceneVariant> cases_of(const bool quick, const CoupledModel &model)
    {
      const std::string         coupling = model.couplings.couplings.front().name;
      const std::vector<int>    meshes   = quick ? std::vector<int>{9, 10} : std::vector<int>{11, 14, 17, 20, 22};
      const int                 other    = quick ? 9 : 14; // for all but the mesh
      std::vector<SceneVariant> all;
      const auto add = [&](const char *study, const std::string &value, const int mesh, const std::string &change) {
        std::vector<std::string> changes = box_divisions({mesh, mesh, mesh});
        if (quick)
          changes.push_back(faster_growth(model));
        if (!change.empty())
          changes.push_back(change);
        changes.push_back("Couplings/" + coupling + "/Energy limit=1e9"); // what is made is measured
        all.push_back({study, value, changes});
      };
      for (const int n : meshes)
        add("mesh", fmt::format("{0}x{0}x{0}", n), n, "");
      for (const char *safety : {"0.9", "0.45", "0.2"})
        add("step", safety, other, std::string("Continuum/Motion/Safety=") + safety);
      for (const char *ratio : {"1", "2", "5"}) // of particles whose own step is short
        {
          add("sub-cycling", ratio, other, std::string("Time/Largest ratio=") + ratio);
          all.back().changes.push_back("Time/Step factor=0.005");
          if (ratio != std::string("1"))
            all.back().changes.push_back("Time/Sub-cycling loss=1"); // what is lost is measured
        }
      for (const char *ratio : {"1", "2", "5"}) // of a solid whose own step is short
        {
          add("solid sub-cycled", ratio, other, std::string("Time/Largest ratio=") + ratio);
          all.back().changes.insert(all.back().changes.end(), {"Continuum/Motion/Safety=0.1", "Time/Step factor=0.3"});
          if (ratio != std::string("1"))
            all.back().changes.push_back("Time/Sub-cycling loss=1");
        }
      for (const char *spreading : {"none", "automatic", "footprint"})
        {
          add("spreading", spreading, other, "Couplings/" + coupling + "/Contact=point");
          all.back().changes.push_back("Couplings/" + coupling + "/Spreading=" + spreading);
        }
      for (const char *skin : {"1e-4", "2e-5", "5e-6"})
        add("skin [m]", skin, other, "Couplings/" + coupling + "/Skin thickness=" + skin);
      for (const int n : meshes)
        {
          add("point", fmt::format("{0}x{0}x{0}", n), n, "Couplings/" + coupling + "/Contact=point");
          all.back().changes.push_back("Couplings/" + coupling + "/Spreading=none");
        }
      return all;
    }

    const CoupledModel &model_of(const CheckedScene &scene)
    {
      const CoupledModel &model = model_of_kind<CoupledModel>(scene, "coupled");
      if (model.continuum.mesh.source != MeshSection::Source::box || model.couplings.couplings.size() != 1)
        refuse_scene(scene, "this bench varies the divisions of a box (Continuum/Mesh/Source) and one coupling.");
      if (!(model.references.peak_force > 0 && model.references.contact_time > 0))
        refuse_scene(scene, "References: this bench needs Peak force and Contact time.");
      return model;
    }

    /** Where the scene is one of bodies that touch; nullptr: it is of particles on a solid. */
    const ContinuumModel *bodies_of(const CheckedScene &scene)
    {
      const auto *found = dynamic_cast<const SceneOf<ContinuumModel> *>(scene.scene.get());
      if (!found)
        return nullptr;
      const ContinuumModel &model = found->model();
      if (model.mesh.source != MeshSection::Source::bodies || model.mesh.balls.empty() ||
          model.contacts.contacts.size() != 1)
        refuse_scene(scene, "this bench varies the elements of balls (Mesh/Balls) and one contact.");
      if (!(model.references.peak_force > 0 && model.references.contact_time > 0))
        refuse_scene(scene, "References: this bench needs Peak force and Contact time.");
      return &model;
    }

    std::vector<SceneVariant> cases_of(const bool quick, const CheckedScene &scene)
    {
      const ContinuumModel *bodies = bodies_of(scene);
      return bodies ? impacts_of_bodies(*bodies, quick) : cases_of(quick, model_of(scene));
    }

    ImpactMeasurement measure(const CoupledModel &model, const SceneVariant &which, Progress &progress)
    {
      const dem::Packing packing = model.particles.packing();
      const auto         body    = make_coupled_body(model, packing);
      body->start();
      const double  start   = base::processor_seconds();
      const double  end     = model.particles.end_time;
      constexpr int samples = 50;
      for (int n = 1; n <= samples && !interrupted(); ++n)
        {
          body->advance_to(end * n / samples);
          progress.update(body->time() / end, fmt::format("time {:.3g} s", body->time()));
        }
      ImpactMeasurement found;
      found.which                  = which;
      found.cost                   = base::processor_seconds() - start;
      const auto           columns = body->columns();
      const auto           row     = body->row();
      const ContactFigures seen    = body->interface();
      const double         initial = body->particles().specimen().energy().initial;
      found.elements               = body->elements();
      found.windows                = body->windows();
      found.force_error            = seen.peak_force / model.references.peak_force - 1;
      found.time_error             = seen.contact_time() / model.references.contact_time - 1;
      const std::string suffix     = "_spurious";
      for (std::size_t c = 0; c < columns.size(); ++c)
        {
          const std::string &name = columns[c].name;
          if (name.size() > suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0)
            found.made = row[c] / initial;
          if (name == "energy_residual")
            found.missing = row[c] / initial;
        }
      return found;
    }

    void write(const BenchResults &results, const std::vector<ImpactMeasurement> &rows)
    {
      std::string csv = "study,value,elements,force_error [-],time_error [-],made [-],missing [-],windows,cost [s]\n";
      std::string md =
        "| Study | Value | Elements | Peak force | Contact time | Made by the coupling | Missing | Windows | "
        "Cost [s] |\n|---|---|---|---|---|---|---|---|---|\n";
      for (const ImpactMeasurement &r : rows)
        {
          csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.which.study, r.which.value, r.elements, r.force_error,
                             r.time_error, r.made, r.missing, r.windows, r.cost);
          md += fmt::format("| {} | {} | {} | {:+.2f} % | {:+.2f} % | {:.1e} | {:.1e} | {} | {:.1f} |\n", r.which.study,
                            r.which.value, r.elements, 100 * r.force_error, 100 * r.time_error, r.made, r.missing,
                            r.windows, r.cost);
        }
      results.write(csv, md);
    }

    std::vector<postprocess::PlotPanel> panels_of(const std::vector<ImpactMeasurement> &rows)
    {
      postprocess::PlotPanel force, time;
      force.title   = "peak force";
      time.title    = "contact time";
      force.y_label = time.y_label = "Relative error";
      for (postprocess::PlotPanel *panel : {&force, &time})
        {
          panel->x_label = "Processor time [s]";
          panel->log_x = panel->log_y = true;
        }
      for (const ImpactMeasurement &r : rows)
        {
          if (force.series.empty() || force.series.back().name != r.which.study)
            for (postprocess::PlotPanel *panel : {&force, &time})
              panel->series.emplace_back().name = r.which.study;
          force.series.back().x.push_back(r.cost);
          force.series.back().y.push_back(std::fabs(r.force_error));
          time.series.back().x.push_back(r.cost);
          time.series.back().y.push_back(std::fabs(r.time_error));
        }
      return {force, time};
    }
  } // namespace

  int run_surface_bench(const SurfaceBench &bench)
  {
    start_mpi();
    std::vector<std::pair<std::string, SceneVariant>> cases; ///< with their scenes
    for (const std::string &scene : bench.scenes)
      for (const SceneVariant &which : cases_of(bench.quick, read_scene(scene, bench.overrides)))
        cases.emplace_back(scene, which);
    const BenchResults results(bench.folder, "surface");
    catch_interrupts();
    std::vector<ImpactMeasurement> rows;
    for (const auto &[file, which] : cases)
      {
        const CheckedScene scene = which.of(file, bench.overrides);
        Progress progress(fmt::format("case {} of {}, {} {}", rows.size() + 1, cases.size(), which.study, which.value));
        const ContinuumModel   *bodies = bodies_of(scene);
        const ImpactMeasurement found =
          bodies ? measure_bodies(*bodies, which, progress) : measure(model_of(scene), which, progress);
        if (interrupted())
          return exit_interrupted; // the table has every complete case
        rows.push_back(found);
        fmt::print("{:<12} {:<10} force {:+.2f} %, time {:+.2f} %, made {:.1e}, missing {:.1e}, {} windows, {:.1f} s\n",
                   which.study, which.value, 100 * found.force_error, 100 * found.time_error, found.made, found.missing,
                   found.windows, found.cost);
        std::fflush(stdout);
        write(results, rows);
      }
    return results.finish(panels_of(rows));
  }
} // namespace apps

#include "apps/bench/sequential.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/results/result_folder.h"
#include "apps/results/terminal.h"
#include "apps/runs/sequential/continuation.h"
#include "apps/runs/sequential/groundwork.h"
#include "apps/runs/sequential/particles.h"
#include "apps/runs/sequential/study.h"
#include "apps/scene/description.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace apps
{
  namespace
  {
    struct SequentialRow
    {
      SceneVariant variant; ///< one way of transferring
      std::string  instant;
      double       strain = 0, error = 0, near = 0, reaches = 1, seconds = 0, seconds_saved = 0;
    };

    std::string number_text(const double value) { return fmt::format("{}", value); }

    std::vector<SceneVariant> variants_of(const double radius, const bool quick)
    {
      std::vector<SceneVariant> all;
      const auto                kernel = [](const std::string &name, const double width) {
        return std::vector<std::string>{"Transfer/Kernel=" + name, "Transfer/Width=" + number_text(width)};
      };
      all.push_back({"kernel", "specimen", kernel("specimen", 0)});
      for (const char *name : {"gaussian", "moving least squares", "ball"})
        for (const double widths : quick ? std::vector<double>{3} : std::vector<double>{3, 5, 8})
          all.push_back({"kernel", fmt::format("{} {} r", name, widths), kernel(name, widths * radius)});
      all.push_back({"kernel", "nearest", kernel("nearest", 0)});
      for (SceneVariant &v : all) // a mesh on which kernels can differ
        for (const std::string &change : box_divisions({2, 2, 4}))
          v.changes.push_back(change);
      for (const int n : quick ? std::vector<int>{1, 2} : std::vector<int>{1, 2, 3, 4})
        {
          std::vector<std::string> mesh = kernel("gaussian", 3 * radius);
          for (const std::string &change : box_divisions({n, n, 2 * n}))
            mesh.push_back(change);
          all.push_back({"mesh", fmt::format("{0} x {0} x {1} elements", n, 2 * n), mesh});
        }
      return all;
    }

    /** Where softening is averaged over a length: with parts of it, down to none. */
    std::vector<SceneVariant> lengths_of(const SequentialModel &model, const bool quick)
    {
      std::vector<SceneVariant> all;
      for (const MaterialOfGroup *group : model.receivers())
        if (const double whole = group->chosen().constants->averaging_length(); whole > 0)
          for (const double share : quick ? std::vector<double>{0, 1} : std::vector<double>{0, 0.25, 0.5, 1})
            {
              const double length = share * whole;
              all.push_back({"length",
                             fmt::format("{:g} m", length),
                             {fmt::format("Continuum/Materials/{}/{}/Nonlocal length={}", group->group,
                                          group->law->name(), length)}});
            }
      return all;
    }

    const SequentialModel &sequential(const CheckedScene &scene)
    {
      const SequentialModel &model = model_of_kind<SequentialModel>(scene, "sequential");
      if (model.particles.source != ParticleEventSection::Source::uniaxial || model.particles.end_strain == 0)
        refuse_scene(scene, "this bench compares with an all-particle run: it wants Particles/Source = uniaxial and "
                            "Particles/Uniaxial/End strain.");
      if (model.continuum.mesh.source != MeshSection::Source::box)
        refuse_scene(scene, "Continuum/Mesh/Source: this bench varies the divisions of a box.");
      return model;
    }

    /** The continuation of one instant by one variant, as far as it comes. */
    SequentialRow measure(const SequentialBench                     &bench,
                          const SceneVariant                        &variant,
                          const ParticleCases                       &particles,
                          const std::size_t                          instant,
                          const std::optional<coupling::MappingLaw> &identified)
    {
      std::vector<std::string> overrides = bench.overrides;
      overrides.emplace_back("Continuum/Output/Snapshots=0");
      const CheckedScene     scene   = variant.of(bench.scene, overrides);
      const SequentialModel &model   = sequential(scene);
      const ParticleOutcome &outcome = particles.outcomes()[instant], &all = *particles.reference();
      SequentialRow          row{variant, outcome.name, outcome.severity, std::nan(""), std::nan("")};
      const double           done = std::abs(outcome.severity / all.curve_strain.back());
      row.seconds_saved           = (1 - done) * all.seconds;
      RunRequest request          = request_of(scene);
      request.output_folder.clear(); // only the result is wanted
      ProgressLine line;
      request.observers = {&line};
      const base::Stopwatch watch;
      const auto            compare = [&](const RunResult &continuation) {
        ContinuationCurve curve = curve_of(model.study, continuation);
        curve.offset            = outcome.curve_strain.back();
        row.error               = error_against(curve, all);
        row.near                = error_against(near_the_transfer(curve), all);
        row.reaches             = near_reaches(curve);
        if (!std::isfinite(row.error))
          fmt::print(stderr, "{}, {}: ends too soon to be compared.\n", variant.value, outcome.name);
      };
      try
        {
          const auto                field   = coupling::particle_field(outcome.state, model.transfer.field);
          coupling::TransferOptions options = model.transfer.chosen();
          options.strength                  = model.tensile_strength();
          if (identified)
            options.law = *identified;
          const RunResult continuation = continue_from(request, model.continuum, field, options,
                                                       model.study.least_force, [](const TransferredState &) {});
          if (continuation.end == RunResult::End::interrupted)
            return row;
          compare(continuation); // what was found, if it broke off
        }
      catch (const base::NumericalError &failure)
        {
          fmt::print(stderr, "{}, {}: {}\n", variant.value, outcome.name, failure.what());
        }
      catch (const base::InputError &refusal) // past the limits of the transfer
        {
          fmt::print(stderr, "{}, {}: {}\n", variant.value, outcome.name, refusal.what());
        }
      row.seconds = watch.seconds();
      return row;
    }

    std::string csv_of(const std::vector<SequentialRow> &rows)
    {
      std::string text = "study,variant,instant,strain,error,error_near,near_reaches [strains of the "
                         "transfer],continuum_seconds [s],particle_seconds_saved [s]\n";
      for (const SequentialRow &r : rows)
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.variant.study, r.variant.value, r.instant, r.strain,
                            r.error, r.near, r.reaches, r.seconds, r.seconds_saved);
      return text;
    }

    std::string table_of(const std::vector<SequentialRow> &rows)
    {
      std::string text =
        "# When a transfer pays\n\nError: mean |stress of the continuation - stress of the all-particle run| over the "
        "mean of the latter, past the transfer; near: to 1.5 times the strain of the transfer; both as far as the "
        "continuation came, in such strains: up to.\n\n"
        "| study | variant | handed over at | error | near | up to | continuum s | particle s saved |\n"
        "|---|---|---|---|---|---|---|---|\n";
      for (const SequentialRow &r : rows)
        text += fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} |\n", r.variant.study,
                            r.variant.value, r.instant, r.error, r.near, r.reaches, r.seconds, r.seconds_saved);
      return text;
    }

    std::vector<postprocess::PlotPanel> panels_of(const std::vector<SequentialRow> &rows)
    {
      std::map<std::string, postprocess::PlotPanel> over_instant, over_cost;
      for (const SequentialRow &r : rows)
        for (auto *panels : {&over_instant, &over_cost})
          {
            postprocess::PlotPanel &panel = (*panels)[r.variant.study];
            const bool              cost  = panels == &over_cost;
            panel.title                   = r.variant.study + (cost ? ": error over cost" : ": error over instant");
            panel.x_label                 = cost ? "Continuation [s]" : "Strain at the transfer [1e-3]";
            panel.y_label                 = "Error against all particles";
            panel.log_y                   = true;
            panel.log_x                   = cost;
            if (panel.series.empty() || panel.series.back().name != r.variant.value)
              {
                panel.series.emplace_back();
                panel.series.back().name = r.variant.value;
                panel.series.back().style =
                  cost ? postprocess::PlotSeries::Style::points : postprocess::PlotSeries::Style::line_and_points;
              }
            panel.series.back().x.push_back(cost ? r.seconds : 1e3 * std::abs(r.strain));
            panel.series.back().y.push_back(r.error);
          }
      std::vector<postprocess::PlotPanel> panels;
      for (auto *group : {&over_instant, &over_cost})
        for (auto &[study, panel] : *group)
          panels.push_back(panel);
      return panels;
    }
  } // namespace

  int run_sequential_bench(const SequentialBench &bench)
  {
    const CheckedScene         base  = read_scene(bench.scene, bench.overrides);
    const SequentialModel     &model = sequential(base);
    ResultFolder               folder(bench.folder, ResultFolder::Start::afresh);
    ParticleCases              particles(model.particles, folder.running(),
                                         completed_scene(*base.root, Completed::what_decides_results));
    const SequentialGroundwork ground = groundwork_of(model_of_kind<SequentialModel>(base, "sequential"));
    if (!particles.complete(ground.packing))
      return exit_interrupted;
    std::optional<coupling::MappingLaw> identified; // one for all variants: with the kernel of the scene
    if (model.transfer.identifies())
      {
        LawIdentification identification(model, ground.origin, ground.element_size);
        if (!identification.complete(ground.packing, folder.running(),
                                     completed_scene(*base.root, Completed::what_decides_results)))
          return exit_interrupted;
        identified = identification.result().found.law;
      }
    std::vector<SequentialRow> rows;
    const auto                 instants = model.particles.instants;
    std::vector<SceneVariant>  variants = variants_of(model.particles.specimen.generator.radius, bench.quick);
    for (SceneVariant &variant : lengths_of(model, bench.quick))
      variants.push_back(std::move(variant));
    for (const SceneVariant &variant : variants)
      for (std::size_t k = 0; k < instants.size(); ++k)
        {
          if (instants[k].back) // the all-particle run does not unload
            continue;
          rows.push_back(measure(bench, variant, particles, k, identified));
          if (interrupted())
            return exit_interrupted;
        }
    const BenchResults results(folder.running(), "sequential");
    results.write(csv_of(rows), table_of(rows));
    results.draw(panels_of(rows));
    folder.publish();
    fmt::print("{}", table_of(rows));
    return exit_success;
  }
} // namespace apps

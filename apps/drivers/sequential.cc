#include "apps/drivers/sequential.h"

#include "apps/drivers/sequential_continuation.h"
#include "apps/drivers/sequential_particles.h"
#include "apps/drivers/sequential_study.h"
#include "apps/drivers/transfer_output.h"
#include "apps/exit_status.h"
#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/results/life_cycle.h"
#include "apps/results/result_listing.h"
#include "apps/version.h"
#include "coupling/sequential/identify.h"
#include "postprocess/atomic_file.h"
#include "postprocess/numeric_text.h"
#include "postprocess/plot.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace apps
{
  namespace
  {
    double seconds_since(const std::chrono::steady_clock::time_point &start)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string continuation_name(const std::size_t number) { return fmt::format("continuation_{:03}", number); }

    /** The folder of a study, with the mark by which an interrupted one is known, and can go on. */
    class StudyFolder
    {
    public:
      explicit StudyFolder(const RunRequest &asked)
        : request(asked)
        , folder(opened(asked))
      {
        const std::filesystem::path mark = folder.running() / checkpoint_name;
        if (request.resume)
          require_same_content(request.inputs, postprocess::numeric_text::read_whole(mark));
        postprocess::write_text(folder.running() / "scene.prm", request.scene_text);
        postprocess::write_text(mark, listed(request.inputs)); // states and continuations have checkpoints of their own
        set_last_words("interrupted in work that cannot be stopped half-way; what was finished is kept. " +
                       way_to_go_on(request));
      }

      const std::filesystem::path &running() const { return folder.running(); }

      int interrupted() const
      {
        fmt::print(stderr, "breccia: interrupted, state saved. {}\n", way_to_go_on(request));
        return exit_interrupted;
      }

      void publish() { folder.publish(); }

    private:
      static ResultFolder opened(const RunRequest &request)
      {
        if (!request.resume && !request.restart)
          refuse_to_overwrite(request.output_folder);
        return ResultFolder(request.output_folder,
                            request.resume ? ResultFolder::Start::resume : ResultFolder::Start::afresh);
      }

      const RunRequest &request;
      ResultFolder      folder;
    };

    nlohmann::json head_of(const RunRequest &request, const char *kind)
    {
      return {{"scene", request.scene_file},
              {"asked", {{"kind", kind}, {"overrides", request.overrides}}},
              {"version", version()}};
    }

    /** What the transfers of a run tell, case by case. */
    class TransferRecord
    {
    public:
      TransferRecord(const SequentialModel &model_, const std::filesystem::path &folder_)
        : model(model_)
        , folder(folder_)
        , picture(folder_)
      {
      }

      coupling::ParticleField field_of(const ParticleOutcome &outcome) const
      {
        return coupling::particle_field(outcome.state, model.transfer.field);
      }

      /** Transfer without going on: for the record, and the mesh in ParaView. */
      void add(const std::size_t number, const ParticleOutcome &outcome)
      {
        const coupling::ParticleField   field   = field_of(outcome);
        const coupling::TransferOptions options = model.transfer.chosen();
        const auto                      mesh    = fmt::format("transfer/mesh_{:03}", number);
        const Continuation              done    = initialise_only(model.continuum, field, options, folder / mesh);
        const auto                      cuts    = compare_cuts(field, done.report);
        picture.add(number, field, options, done.report,
                    std::filesystem::relative(done.mesh_file, folder).generic_string());
        nlohmann::json entry = json_of(done.report, cuts, done.settled);
        entry["event"]       = outcome.name;
        entry["particles"]   = {{"used", field.size()}, {"left_out", field.left_out}};
        json.push_back(entry);
        fmt::print("transfer of {} ({} particles, {} left out)\n{}", outcome.name, field.size(), field.left_out,
                   text_of(done.report, cuts, done.settled));
      }

      nlohmann::json json = nlohmann::json::array();

    private:
      const SequentialModel &model;
      std::filesystem::path  folder;
      TransferPicture        picture;
    };
  } // namespace

  void SequentialScene::declare(Section &root)
  {
    model.particles.declare(root);
    model.transfer.declare(root);
    Section &continuum =
      root.section("Continuum", "The solid that carries on; the sections of a scene of kind continuum");
    model.continuum.declare(continuum);
    Section &s = root.section("Study", "How the continuations are read and compared");
    s.number("Length", model.study.length, "m", Range::positive(), Need::optional)
      .means("Displacement over it is the strain of the continuation; 1: displacements as they are")
      .housekeeping();
    s.number("Area", model.study.area, "m^2", Range::positive(), Need::optional)
      .means("Force over it is the stress; 1: forces as they are")
      .housekeeping();
    s.number("Sign", model.study.sign, "-", Range::between(-1, 1), Need::optional)
      .means("-1 turns both around")
      .housekeeping();
    s.text("Horizontal", model.study.horizontal, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
    s.text("Vertical", model.study.vertical, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
  }

  void SequentialScene::validate(const Section &root) const
  {
    model.particles.validate(root);
    model.transfer.validate(root);
    const Section &continuum = *root.find_section("Continuum");
    model.continuum.validate(continuum);
    if (!model.continuum.is_static())
      continuum.find_section("Model")->refuse("Analysis", "a transferred state is carried on in equilibrium: static.");
    if (model.particles.source != ParticleStageSection::Source::file &&
        model.particles.physics.dimension != model.continuum.solid.dimension)
      continuum.find_section("Model")->refuse("Dimension",
                                              "must be that of the particles (Particles/Physics/Dimension).");
    if (model.study.sign != 1 && model.study.sign != -1)
      root.find_section("Study")->refuse("Sign", "must be 1 or -1.");
    const auto &groups = model.continuum.materials.groups;
    if (std::none_of(groups.begin(), groups.end(),
                     [](const auto &g) { return g->law == MaterialOfGroup::Law::concrete; }))
      continuum.find_section("Materials")
        ->refuse("Law", "at least one group must be damage-plastic concrete, or there is nothing to transfer to.");
  }

  std::string SequentialScene::forecast() const
  {
    std::string text  = fmt::format("  transfers    {}\n", model.particles.cases());
    const auto  first = make_particle_case(model.particles, stage_packing(model.particles), 0);
    if (const dem::Specimen *body = first->body())
      text += fmt::format("  particles    {}\n  links        {}\n  time step    {:.4g} s\n", body->counts().particles,
                          body->counts().links, body->time_step());
    if (const StaticStart start = first->settle())
      text += fmt::format("  start        {}\n", text_of(*start));
    return text;
  }

  int SequentialScene::run(const RunRequest &request) const
  {
    const auto    start = std::chrono::steady_clock::now();
    StudyFolder   folder(request);
    const auto    running = folder.running();
    ParticleCases particles(model.particles, running, request.deciding_text);
    if (!particles.complete())
      return folder.interrupted();

    TransferRecord                 record(model, running);
    std::vector<ContinuationCurve> curves;
    for (std::size_t k = 0; k < particles.outcomes().size(); ++k)
      {
        const ParticleOutcome &outcome = particles.outcomes()[k];
        record.add(k, outcome);
        RunRequest part    = request;
        part.quiet         = true;
        part.output_folder = running / continuation_name(k);
        part.deciding_text += fmt::format("\n# continuation {}", k);
        const auto begun = std::chrono::steady_clock::now();
        if (!std::filesystem::exists(part.output_folder / "summary.json"))
          {
            part.resume = std::filesystem::exists(part.output_folder / "running" / checkpoint_name);
            const Continuation done =
              continue_from(part, model.continuum, record.field_of(outcome), model.transfer.chosen());
            if (done.status == exit_interrupted)
              return folder.interrupted();
          }
        ContinuationCurve curve = read_continuation(model.study, part.output_folder);
        curve.name              = outcome.name;
        curve.severity          = outcome.severity;
        curve.absorbed          = outcome.absorbed;
        curve.offset            = outcome.curve_strain.empty() ? 0 : outcome.curve_strain.back();
        curve.seconds           = seconds_since(begun);
        curves.push_back(std::move(curve));
      }

    const StudyReport report{model, particles.outcomes(), particles.reference(), curves};
    nlohmann::json    summary = head_of(request, "sequential");
    summary["figures"]        = {{"cases", report.json()}};
    summary["transfers"]      = record.json;
    summary["cost"]           = {{"wall_seconds", seconds_since(start)}};
    postprocess::write_text(running / "study.csv", report.csv());
    postprocess::write_json(running / "summary.json", summary);
    if (const std::string problem = report.draw(running / "study.png"); !problem.empty())
      fmt::print(stderr, "breccia: warning: no study.png: {}\n", problem);
    folder.publish();
    fmt::print("{}", report.text());
    fmt::print("{}", result_listing(request.output_folder));
    return exit_success;
  }

  int SequentialScene::transfer_only(const RunRequest &request) const
  {
    StudyFolder   folder(request);
    const auto    running = folder.running();
    ParticleCases particles(model.particles, running, request.deciding_text);
    if (!particles.complete())
      return folder.interrupted();
    TransferRecord record(model, running);
    for (std::size_t k = 0; k < particles.outcomes().size(); ++k)
      record.add(k, particles.outcomes()[k]);
    nlohmann::json summary = head_of(request, "sequential");
    summary["transfers"]   = record.json;
    postprocess::write_json(running / "summary.json", summary);
    folder.publish();
    fmt::print("{}", result_listing(request.output_folder));
    return exit_success;
  }

  namespace
  {
    const fem::DamagePlasticConcrete::Parameters &concrete_of(const ContinuumModel &model)
    {
      for (const auto &group : model.materials.groups)
        if (group->law == MaterialOfGroup::Law::concrete)
          return group->concrete;
      throw dem::InputError("identify: no group of elements is damage-plastic concrete.");
    }

    std::string prm_of(const coupling::MappingLaw &law)
    {
      return fmt::format(
        "subsection Transfer\n  subsection Mapping law\n    set Law             = own\n"
        "    set Weights         = {}, {}, {}\n    set Factor          = {}\n    set Exponent        = {}\n"
        "    set Switch damage   = {}\n    set Hardening start = {}\n    set Hardening slope = {}\n  end\nend\n",
        law.weights[0], law.weights[1], law.weights[2], law.factor, law.exponent, law.switch_damage,
        law.hardening_start, law.hardening_slope);
    }

    nlohmann::json json_of(const coupling::Identification &found)
    {
      const coupling::MappingLaw &law = found.law;
      return {{"law",
               {{"weights", law.weights},
                {"factor", law.factor},
                {"exponent", law.exponent},
                {"switch_damage", law.switch_damage},
                {"hardening_start", law.hardening_start},
                {"hardening_slope", law.hardening_slope}}},
              {"states_after_peak", found.damaged},
              {"states_before_peak", found.undamaged},
              {"damage_error", found.damage_error},
              {"hardening_error", found.hardening_error}};
    }

    /** Wanted and mapped damage over the particles' relative stress, before and after identification. */
    std::string draw_identification(const std::filesystem::path                                     &file,
                                    const std::vector<coupling::ParticleObservation>                &observations,
                                    const coupling::ContinuumReference                              &reference,
                                    const std::vector<std::pair<std::string, coupling::MappingLaw>> &laws)
    {
      using Style = postprocess::PlotSeries::Style;
      postprocess::PlotPanel  panel;
      postprocess::PlotSeries wanted;
      wanted.name   = "continuum at the same stress";
      wanted.style  = Style::line_and_points;
      panel.title   = "Damage after the peak";
      panel.x_label = "Stress of the particles over their peak";
      panel.y_label = "Damage of the continuum";
      for (const auto &o : observations)
        if (o.after_peak)
          {
            wanted.x.push_back(o.relative_stress);
            wanted.y.push_back(reference.damage_at(o.relative_stress));
          }
      panel.series.push_back(wanted);
      for (const auto &[name, law] : laws)
        {
          postprocess::PlotSeries mapped;
          mapped.name  = name;
          mapped.style = Style::points;
          for (const auto &o : observations)
            if (o.after_peak)
              {
                mapped.x.push_back(o.relative_stress);
                mapped.y.push_back(coupling::map_damage(o.damage_tensor, law).damage);
              }
          panel.series.push_back(mapped);
        }
      return postprocess::plot(file, {panel});
    }
  } // namespace

  int SequentialScene::identify(const RunRequest &request) const
  {
    if (model.particles.source != ParticleStageSection::Source::uniaxial)
      throw dem::InputError(
        "--identify: wants a scene whose particles are strained between grips (Particles/Source = uniaxial): "
        "the same test is made on one continuum element.");
    StudyFolder   folder(request);
    const auto    running = folder.running();
    ParticleCases particles(model.particles, running, request.deciding_text);
    if (!particles.complete())
      return folder.interrupted();

    double peak = 0, strain_at_peak = 0;
    for (const ParticleOutcome &outcome : particles.outcomes())
      for (std::size_t i = 0; i < outcome.curve_stress.size(); ++i)
        if (std::abs(outcome.curve_stress[i]) > peak)
          {
            peak           = std::abs(outcome.curve_stress[i]);
            strain_at_peak = std::abs(outcome.curve_strain[i]);
          }
    std::vector<coupling::ParticleObservation> observations;
    const auto                                 asked = model.particles.instants_asked();
    for (std::size_t k = 0; k < asked.size(); ++k)
      {
        if (asked[k].back)
          continue; // the continuum's reference has no unloading
        const ParticleOutcome        &outcome = particles.outcomes()[k];
        const coupling::ParticleField field   = coupling::particle_field(outcome.state, model.transfer.field);
        coupling::AveragingOptions    mean;
        mean.kernel = coupling::Kernel::specimen;
        observations.push_back({coupling::Averaging(field, mean).at(field.place.front(), 0).damage,
                                std::abs(outcome.stress) / peak,
                                std::abs(outcome.curve_strain.back()) > strain_at_peak});
      }
    const auto                        &material = concrete_of(model.continuum);
    const double                       size = material.element_size > 0 ? material.element_size : model.study.length;
    const coupling::ContinuumReference reference(material, size, model.particles.compresses(), 1e-5, 0.05);
    const coupling::MappingLaw         start = model.transfer.chosen().law;
    const coupling::Identification     found = coupling::identify(observations, reference, start);

    nlohmann::json summary    = head_of(request, "sequential");
    summary["identification"] = json_of(found);
    summary["particle_peak"]  = {{"value", peak}, {"unit", "Pa"}};
    summary["continuum_peak"] = {{"value", reference.peak()}, {"unit", "Pa"}};
    postprocess::write_json(running / "summary.json", summary);
    postprocess::write_text(running / "mapping_law.prm", prm_of(found.law));
    if (const std::string problem = draw_identification(running / "identified.png", observations, reference,
                                                        {{"law of the scene", start}, {"identified", found.law}});
        !problem.empty())
      fmt::print(stderr, "breccia: warning: no identified.png: {}\n", problem);
    folder.publish();
    fmt::print("{}", prm_of(found.law));
    fmt::print("fit          damage within {:.4f} (root mean square, {} states after the peak), kappa_P within {:.3f} "
               "({} before)\n",
               found.damage_error, found.damaged, found.hardening_error, found.undamaged);
    fmt::print("{}", result_listing(request.output_folder));
    return exit_success;
  }
} // namespace apps

#include "apps/runs/sequential/run.h"

#include "apps/figures/summary_head.h"
#include "apps/results/terminal.h"
#include "apps/results/warning.h"
#include "apps/runs/continuum/summary.h"
#include "apps/runs/sequential/continuation.h"
#include "apps/runs/sequential/study.h"
#include "apps/runs/sequential/transfer_output.h"
#include "apps/specimens/left_out_of_balance.h"
#include "base/stopwatch.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"

#include <fmt/format.h>

#include <fstream>
#include <map>

namespace apps
{
  namespace
  {
    std::string continuation_name(const std::size_t number) { return fmt::format("continuation_{:03}", number); }

    /** The mesh at the start of a finished continuation; "" if it left no snapshots. */
    std::filesystem::path first_snapshot(const std::filesystem::path &continuation)
    {
      std::filesystem::path first;
      if (std::filesystem::exists(continuation / "solid"))
        for (const auto &file : std::filesystem::directory_iterator(continuation / "solid"))
          if (file.path().extension() == ".vtu" && (first.empty() || file.path() < first))
            first = file.path();
      return first;
    }

    nlohmann::json json_in(const std::filesystem::path &file)
    {
      std::ifstream stream(file);
      return nlohmann::json::parse(stream);
    }

    /** What a continuation found that was finished before an interrupt. */
    RunResult earlier_result(const std::filesystem::path &folder)
    {
      RunResult result;
      result.summary = json_in(folder / "summary.json");
      if (std::filesystem::exists(folder / "series.csv"))
        result.series = postprocess::read_csv_table(folder / "series.csv", true);
      return result;
    }

    std::string
    lines_of(const ParticleOutcome &outcome, const coupling::ParticleField &field, const TransferredState &state)
    {
      return fmt::format("transfer of {} ({} particles, {} left out)\n{}", outcome.name, field.size(), field.left_out,
                         text_of(state.report, state.settled));
    }

    /** The request of a study in this folder. */
    RunRequest placed(RunRequest request, const postprocess::ScratchFolder *scratch)
    {
      if (scratch)
        request.output_folder = scratch->path() / "study";
      return request;
    }

    /** A case that cannot be transferred says which it is. */
    template <typename Work>
    auto in_case(const ParticleOutcome &outcome, const Work &work)
    {
      try
        {
          return work();
        }
      catch (const base::InputError &refusal)
        {
          throw base::InputError(outcome.name + ": " + refusal.what());
        }
    }
  } // namespace

  /** Reports of the transfers of a run, case by case; kept in OUTPUT/transfer for a run that goes on after an interrupt. */
  class SequentialRun::TransferRecord
  {
  public:
    explicit TransferRecord(const std::filesystem::path &folder_)
      : folder(folder_)
      , picture(folder_)
    {
    }

    void write(const std::size_t                number,
               const ParticleOutcome           &outcome,
               const coupling::ParticleField   &field,
               const coupling::TransferOptions &options,
               const TransferredState          &state)
    {
      picture.write(number, field, options, state.report);
      nlohmann::json entry = json_of(state.report, state.settled);
      entry["event"]       = outcome.name;
      entry["particles"]   = {{"used", field.size()}, {"left_out", field.left_out}};
      postprocess::write_json(file(number), entry);
      written[number] = std::move(entry);
    }

    /** Add a case that was written, perhaps before an interrupt. @param mesh_file in the output folder; "" without */
    void add(const std::size_t number, const std::filesystem::path &mesh_file)
    {
      picture.show(number, mesh_file.empty() ? "" : std::filesystem::relative(mesh_file, folder).generic_string());
      json.push_back(written.count(number) > 0 ? written[number] : json_in(file(number)));
    }

    nlohmann::json json = nlohmann::json::array();

  private:
    std::filesystem::path file(const std::size_t number) const
    {
      return folder / fmt::format("transfer/transfer_{:03}.json", number);
    }

    std::filesystem::path                 folder;
    TransferPicture                       picture;
    std::map<std::size_t, nlohmann::json> written; ///< in this process, by number
  };

  SequentialRun::SequentialRun(const SequentialModel &what, SequentialGroundwork known, const RunRequest &requested)
    : model(what)
    , ground(std::move(known))
    , results(requested.output_folder)
    , scratch(results.empty() ? std::make_unique<postprocess::ScratchFolder>("study") : nullptr)
    , request(placed(requested, scratch.get()))
    , folder(request)
    , running(folder.running())
    , options(model.transfer.chosen())
    , particles(model.particles, running, requested.deciding_text)
  {
    for (const std::string &doubt : ground.doubts)
      notify(request, &RunObserver::warns, doubt);
    options.strength = model.tensile_strength();
  }

  /** @return false when interrupted. */
  bool SequentialRun::find_law()
  {
    if (!model.transfer.identifies())
      return true;
    LawIdentification identification(model, ground.origin, ground.element_size);
    if (!identification.complete(ground.packing, running, request.deciding_text))
      return false;
    law         = identification.result();
    options.law = law->found.law;
    notify(request, &RunObserver::says, law->text());
    return true;
  }

  nlohmann::json SequentialRun::summary() const
  {
    nlohmann::json json = summary_head(request, "sequential");
    if (!ground.doubts.empty())
      json["warnings"] = ground.doubts;
    if (const std::string left_out = not_in_balance(); !left_out.empty())
      json["energy"]["not_in_balance"] = left_out;
    if (law)
      json["identification"] = law->json();
    if (model.particles.source != ParticleEventSection::Source::file)
      model.particles.mixed().put_into(json);
    return json;
  }

  std::string SequentialRun::not_in_balance() const
  {
    const ParticleEventSection &event = model.particles;
    if (event.source == ParticleEventSection::Source::file)
      return "";
    std::vector<double> radius = ground.packing.radius;
    if (event.source == ParticleEventSection::Source::impact)
      radius.push_back(event.impact.impactor_radius);
    return left_out_of_balance(*event.mixed().materials(ground.packing.material_names).bonds(event.physics), radius);
  }

  RunResult SequentialRun::interrupted() const
  {
    RunResult result = folder.interrupted();
    result.folder    = results;
    if (scratch) // gone with this run
      result.go_on.clear();
    return ended(std::move(result));
  }

  RunResult SequentialRun::finish(nlohmann::json json, std::string words)
  {
    postprocess::write_json(running / "summary.json", json);
    folder.publish();
    RunResult result;
    result.summary = std::move(json);
    result.words   = std::move(words);
    result.folder  = results;
    return ended(std::move(result));
  }

  RunResult SequentialRun::ended(RunResult result) const
  {
    notify(request, &RunObserver::ends, result);
    return result;
  }

  RunResult SequentialRun::continue_case(const std::size_t number, TransferRecord &record) const
  {
    const ParticleOutcome &outcome = particles.outcomes()[number];
    ProgressLine           line;
    RunRequest             part = request;
    part.observers.clear();
    if (shows_progress(request))
      part.observers.push_back(&line);
    part.output_folder = running / continuation_name(number);
    part.deciding_text += fmt::format("\n# continuation {}", number);
    if (std::filesystem::exists(part.output_folder / "summary.json"))
      return earlier_result(part.output_folder);
    part.resume      = std::filesystem::exists(part.output_folder / "running" / checkpoint_name);
    const auto field = coupling::particle_field(outcome.state, model.transfer.field);
    const auto note  = [&](const TransferredState &state) {
      record.write(number, outcome, field, options, state);
      notify(request, &RunObserver::says, lines_of(outcome, field, state));
    };
    const base::Stopwatch watch;
    try
      {
        return in_case(
          outcome, [&] { return continue_from(part, model.continuum, field, options, model.study.least_force, note); });
      }
    catch (
      const base::NumericalError &failure) // there is nothing to carry on: the study says so, and the other cases go on
      {
        RunResult none;
        none.summary = {{"ended_by", no_equilibrium + failure.what()}, {"cost", {{"wall_seconds", watch.seconds()}}}};
        postprocess::write_json(part.output_folder / "summary.json", none.summary);
        return none;
      }
  }

  RunResult SequentialRun::carry_on()
  {
    const base::Stopwatch watch;
    if (!find_law() || !particles.complete(ground.packing))
      return interrupted();
    TransferRecord                 record(running);
    std::vector<ContinuationCurve> curves;
    for (std::size_t k = 0; k < particles.outcomes().size(); ++k)
      {
        const RunResult continuation = continue_case(k, record);
        if (continuation.end == RunResult::End::interrupted)
          return interrupted();
        record.add(k, first_snapshot(running / continuation_name(k)));
        const ParticleOutcome &outcome = particles.outcomes()[k];
        curves.push_back(curve_of(model.study, continuation));
        curves.back().name     = outcome.name;
        curves.back().severity = outcome.severity;
        curves.back().absorbed = outcome.absorbed;
        curves.back().offset   = outcome.curve_strain.empty() ? 0 : outcome.curve_strain.back();
      }

    const StudyReport report{
      model, {ground.horizontal_unit, ground.vertical_unit}, particles.outcomes(), particles.reference(), curves};
    nlohmann::json json = summary();
    json["figures"]     = {{"cases", report.json()}};
    for (const std::string &warning : report.warnings())
      json["warnings"].push_back(warning);
    json["transfers"] = record.json;
    json["cost"]      = {{"wall_seconds", watch.seconds()}};
    postprocess::write_text(running / "study.csv", report.csv());
    warn_of_missing("study.png", report.draw(running / "study.png"));
    return finish(std::move(json), report.text() + balance_note(not_in_balance()));
  }

  RunResult SequentialRun::transfer_only()
  {
    if (!find_law() || !particles.complete(ground.packing))
      return interrupted();
    TransferRecord record(running);
    for (std::size_t k = 0; k < particles.outcomes().size(); ++k)
      {
        const ParticleOutcome        &outcome = particles.outcomes()[k];
        const coupling::ParticleField field   = coupling::particle_field(outcome.state, model.transfer.field);
        const auto                    mesh    = running / fmt::format("transfer/mesh_{:03}", k);
        const TransferredState        state =
          in_case(outcome, [&] { return initialise_only(model.continuum, field, options, mesh); });
        record.write(k, outcome, field, options, state);
        notify(request, &RunObserver::says, lines_of(outcome, field, state));
        record.add(k, state.mesh_file);
      }
    nlohmann::json json = summary();
    json["transfers"]   = record.json;
    return finish(std::move(json), "");
  }

  RunResult SequentialRun::identify_only()
  {
    if (!find_law())
      return interrupted();
    return finish(summary(), law->prm());
  }

  RunResult run(const SequentialModel &model, const RunRequest &request)
  {
    return SequentialRun(model, groundwork_of(model), request).carry_on();
  }

  RunResult transfer_only(const SequentialModel &model, const RunRequest &request)
  {
    return SequentialRun(model, groundwork_of(model), request).transfer_only();
  }

  RunResult identify(const SequentialModel &model, const RunRequest &request)
  {
    return SequentialRun(model, groundwork_of(model), request).identify_only();
  }
} // namespace apps

#include "apps/bench/size_effect.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/bench/size_effect_report.h"
#include "apps/process/exit_status.h"
#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace apps
{
  namespace
  {
    bool among(const std::vector<int> &numbers, const int one)
    {
      return std::find(numbers.begin(), numbers.end(), one) != numbers.end();
    }

    void demand_scene(const SizeEffectBench &bench, const CheckedScene &scene, const StructureModel &one)
    {
      if (!one.bending_test.evaluate() || one.handshakes.handshakes.size() != 1)
        refuse_scene(scene, "Bending test, Handshakes: this bench needs the test, and one handshake \"core\".");
      if (!among(bench.sizes, bench.calibrated))
        throw base::InputError("command line: --calibrated: must be one of --sizes.");
    }

    /** Smaller ones first, so that most is known soon. */
    std::vector<BeamCase> cases_of(const SizeEffectBench &bench)
    {
      std::vector<int> sizes = bench.sizes;
      std::sort(sizes.begin(), sizes.end());
      std::vector<BeamCase> all;
      for (const int size : sizes)
        for (const bool notched : {true, false})
          for (const bool alone : {false, true})
            for (int geometry = 1; geometry <= bench.geometries; ++geometry)
              if ((notched || !bench.notched_only) && (!alone || among(bench.particles, size)))
                all.push_back({size, geometry, notched, alone, size == bench.calibrated && notched && !alone});
      return all;
    }

    /** All that decides what beams bear: a journal belongs to it. */
    StudyPlan plan_of(const SizeEffectBench &bench, const StructureModel &one, const std::vector<BeamCase> &cases)
    {
      StudyPlan plan;
      for (const BeamCase &beam : cases)
        plan.text +=
          beam.name() + "\n" + request_of(scene_of_beam(bench.scene, bench.overrides, one, beam)).deciding_text + "\n";
      return plan;
    }

    /** Young's modulus of the elements, which is that of the particles together. */
    double young_of(const StructureModel &one)
    {
      const auto   made = one.continuum.materials.groups.front()->make_points(fem::Plane::strain);
      const auto   D    = made->elastic_stiffness();
      const double G = D(3, 3), lambda = D(0, 1);
      return G * (3 * lambda + 2 * G) / (lambda + G);
    }

    void say(const BrokenBeam &b, const bool kept)
    {
      fmt::print(
        "D {:g} mm, {}: {:.0f} particles, strength {:.3f} MPa, work over ligament {:.1f} J/m2 with {:.0f} % of "
        "the load left, balance {:.1e}, {:.0f} s{}\n",
        1e3 * b.depth, b.of.name(), b.particles, 1e-6 * b.strength, b.work, 100 * b.left, b.balance, b.cost,
        kept ? ", as the folder has it" : "");
      std::fflush(stdout);
    }

    /** The beams of this part, but those that are there already. */
    void work_off(const SizeEffectBench       &bench,
                  const StructureModel        &one,
                  const std::vector<BeamCase> &cases,
                  const StudyJournal          &journal)
    {
      for (std::size_t run = bench.part - 1; run < cases.size(); run += bench.parts)
        {
          const std::optional<RunRecord> kept = journal.find(static_cast<Eigen::Index>(run));
          const BrokenBeam               beam = kept ?
                                                  BrokenBeam::read(cases[run], *kept) :
                                                  broken(scene_of_beam(bench.scene, bench.overrides, one, cases[run]), cases[run]);
          if (!kept)
            journal.keep(static_cast<Eigen::Index>(run), beam.record());
          say(beam, kept.has_value());
        }
    }

    /** Of all parts. */
    std::vector<BrokenBeam> kept_beams(const std::vector<BeamCase> &cases, const StudyJournal &journal)
    {
      std::vector<BrokenBeam> all;
      for (std::size_t run = 0; run < cases.size(); ++run)
        if (const std::optional<RunRecord> kept = journal.find(static_cast<Eigen::Index>(run)))
          all.push_back(BrokenBeam::read(cases[run], *kept));
      return all;
    }
  } // namespace

  int run_size_effect_bench(const SizeEffectBench &requested)
  {
    start_mpi();
    SizeEffectBench bench = requested;
    if (bench.quick)
      {
        bench.sizes        = {1, 2};
        bench.particles    = {};
        bench.geometries   = 1;
        bench.notched_only = true;
      }
    const CheckedScene    scene = read_scene(bench.scene, bench.overrides);
    const StructureModel &one   = model_of_kind<StructureModel>(scene, "structure");
    demand_scene(bench, scene, one);
    const std::vector<BeamCase> cases = cases_of(bench);
    const BenchResults          results(bench.folder, "size_effect");
    const StudyJournal journal(bench.folder, plan_of(bench, one, cases), bench.part, bench.parts, bench.restart);
    work_off(bench, one, cases, journal);
    const std::vector<BrokenBeam> all = kept_beams(cases, journal);
    if (all.size() < cases.size())
      {
        fmt::print("{} of {} beams are there; the part that is done last writes the table.\n", all.size(),
                   cases.size());
        return exit_success;
      }
    const FolderLock       alone  = journal.lock_of_all_parts();
    const SizeEffectAnswer answer = size_effect_answer(all, bench.calibrated, young_of(one));
    const std::string      table  = table_of_sizes(all, answer);
    results.write(csv_of_beams(all), table);
    fmt::print("{}", table);
    return results.finish(panels_of_sizes(all, answer));
  }
} // namespace apps

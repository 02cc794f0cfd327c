#pragma once

#include "apps/figures/sampling.h"
#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/results/run_work.h"
#include "apps/runs/particles/body.h"
#include "apps/runs/particles/driven_particles.h"
#include "apps/specimens/genesis_work.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/specimen_snapshots.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /**
   * The work of a scene of kind "particles".
   *
   * Where the particles are grown, that comes first: with the files of GenesisWork::write().
   *
   * In the result folder, besides what every run has (run_files.h): packing.h5, particles_particles.pvd and particles_links.pvd with
   * their snapshots, and at the end packing_at_end.h5 and curve.png; of bonded particles crack.png and state.h5 as well.
   */
  class ParticlesRun : public RunWork
  {
  public:
    ParticlesRun(const RunRequest &request, const ParticlesModel &model);

    /** Throws as Scene::run(). */
    RunResult execute();

  private:
    bool                                   whole_on_each_rank() const override { return true; }
    void                                   prepare() override;
    void                                   reopen(const std::filesystem::path &folder) override;
    void                                   keep_files(const std::filesystem::path &folder, bool fresh) override;
    void                                   begin(const Record &record) override;
    void                                   visit_state(RunState &state) override;
    std::vector<postprocess::SeriesColumn> series_columns() const override { return model.columns(); }
    std::string                            size() const override;
    std::string                            stage() const override
    {
      return genesis ? genesis->stage() : sampling.finished() && slow ? "loading at half the speed" : "motion";
    }
    double      done() const override;
    std::string details() const override;
    bool        finished() const override { return !genesis && sampling.finished() && !checks_speed(); }
    void        advance(const Record &record) override;
    RunFindings findings(const postprocess::CsvTable &series, double wall_seconds) override;
    void        write_results(const std::filesystem::path &folder, const postprocess::CsvTable &series) override;

    void make_body();
    /** The body and its initial state. */
    void make_start();
    /** What a run in motion begins with, to its folder and series. */
    void begin_motion(const Record &record);
    /** Where the loading of a test has begun whose speed is to be checked: a copy that shall do it at half the speed. */
    void   keep_start_of_loading();
    void   visit_slow(RunState &state);
    double last_time_of_slow() const { return 2 * model.last_time(); } ///< [s]
    /** Between two reports of progress [s]. */
    double seconds_of_a_row() const { return body->specimen().time() / static_cast<double>(model.output.samples); }
    /** Rows of a test are counted anew from the beginning of its motion, and of its loading. */
    void begin_rows_of_test();
    /** Some further. @return whether a row is due */
    bool move();
    /** Whether that copy still has something to do. */
    bool checks_speed() const;
    /** Some further; where particles have grown up, they begin to move. */
    void grow(const Record &record);
    void open(const std::filesystem::path &folder);
    /** The row of now: recorded, and checked by the stop conditions. */
    void        record_row(const Record &record);
    std::string draw_crack(const std::filesystem::path &file,
                           const dem::ParticleOutput   &particles,
                           const dem::LinkOutput       &links) const;
    /** What bonds have become, by all ranks. @param particles on the first */
    void write_cracks(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const;
    /** Grading and curves, by one. */
    void write_curves(const std::filesystem::path &folder, const postprocess::CsvTable &series) const;

    RunRequest                     request;
    ParticlesModel                 model;
    dem::Packing                   packing;
    std::string                    grown_text; ///< what genesis has reached, of a run that saw its end
    std::filesystem::path          location;   ///< where this process writes results that grow
    std::filesystem::path          resumed;    ///< where a run that goes on left them
    std::unique_ptr<GenesisWork>   genesis;    ///< while particles grow; then there is the body
    std::shared_ptr<ParticlesBody> body;       ///< shared with the result, which holds its specimen
    std::unique_ptr<ParticlesBody>
      slow; ///< as it was when the loading began, to load at half the speed when the test is over

    std::unique_ptr<DrivenParticles>           driven;   ///< where they are coupled with other programs
    std::unique_ptr<coupling::PreciceExchange> exchange; ///< likewise

    MaterialCounts    materials; ///< before anything moves
    StaticStart       start;
    Sampling          sampling;
    OpenEndedSampling rows_of_test; ///< where there is a test of the laboratory
    SpecimenSnapshots snapshots;
    double            stepping_seconds = 0; ///< wall clock, since the run began or was resumed
    std::int64_t      steps_before     = 0; ///< when it did
  };

  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const ParticlesModel &model, const RunRequest &request);
} // namespace apps

#pragma once

#include "apps/drivers/cell_scene.h"
#include "apps/drivers/material_counts.h"
#include "apps/results/result_folder.h"
#include "postprocess/pvd.h"
#include "postprocess/series.h"

#include <chrono>
#include <memory>
#include <optional>

namespace apps
{
  /**
   * One run of a periodic cell along its path.
   *
   * In the result folder: packing.h5, scene.prm, series.csv, cell_particles.pvd and cell_links.pvd with their snapshots,
   * checkpoint.h5 while running, and at the end summary.json, curve.png and cell_crack.png.
   */
  class CellRun
  {
  public:
    CellRun(const RunRequest &request, const CellModel &model);

    /** @return exit status: 0, or 130 after an interrupt. Throws as Scene::run(). */
    int execute();

  private:
    using Clock = std::chrono::steady_clock;

    void make_test();
    void begin();
    void resume();
    void open(const std::filesystem::path &location);
    bool complete(); ///< @return false when interrupted
    void append_row();
    void snapshot();
    void save();
    void finish();
    /** @return what went wrong, "" if nothing */
    std::string draw_crack(const std::filesystem::path &file) const;
    double      wall_seconds() const;
    template <typename Checkpoint>
    void visit_state(Checkpoint &checkpoint);

    RunRequest                   request;
    CellModel                    model;
    dem::Packing                 packing;
    std::optional<dem::Specimen> specimen;
    MaterialCounts               materials; ///< before anything moves
    std::optional<dem::CellTest> test;
    std::int64_t steps = 0, steps_per_sample = 1, samples_per_snapshot = 0; ///< steps: of the whole path
    std::unique_ptr<ResultFolder>              folder;
    std::unique_ptr<postprocess::SeriesWriter> series;
    std::optional<postprocess::PvdCollection>  particles, links;
    double                                     worst_balance_error = 0, seconds_before = 0;
    Clock::time_point                          start, last_saved;
  };
} // namespace apps

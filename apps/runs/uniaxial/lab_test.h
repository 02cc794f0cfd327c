#pragma once

#include "apps/figures/fracture_zone.h"
#include "apps/figures/sampling.h"
#include "apps/results/run_work.h"
#include "apps/runs/uniaxial/model.h"
#include "apps/runs/uniaxial/result.h"
#include "apps/runs/uniaxial/sideways.h"
#include "apps/specimens/link_classes.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/specimen_snapshots.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  struct UniaxialReport;

  /**
   * Steps to the stop strain of a test, the most it can take.
   * @throws base::InputError beyond what any computer can do: some value is then not in SI units.
   */
  std::int64_t most_steps(const UniaxialLoadingSection &loading, UniaxialLoad load, double time_step);

  /** One uniaxial test of a run: a fresh specimen, its curve, its rows of the series and its snapshots. */
  class UniaxialLabTest
  {
  public:
    using Model  = UniaxialModel;
    using Result = UniaxialResult;
    using Report = UniaxialReport;

    /**
     * Link the specimen and grip it; writes nothing.
     * @param number of the test in the scene's list, from 0.
     * @throws base::InputError.
     */
    UniaxialLabTest(const UniaxialModel &model, const dem::Packing &packing, std::size_t number);
    UniaxialLabTest(const UniaxialLabTest &)            = delete;
    UniaxialLabTest &operator=(const UniaxialLabTest &) = delete;

    /** Find the initial equilibrium, if the scene requests one; not of a test that goes on from a checkpoint. @throws base::InputError */
    void settle();
    /** From now on snapshots go to this folder; without this call there are none. @throws postprocess::OutputError. */
    void open(const std::filesystem::path &folder);

    /** One sample further: some steps, and a snapshot when one is due. */
    void advance();
    /** Of the last sample. */
    SeriesRow row() const;
    bool      finished() const { return test.finished(); }
    /** When finished: completes the result, and takes the last snapshot. */
    void complete();
    /** Then: leaves in a folder, which the first rank alone has, TEST_state.h5, from which `breccia transfer` can go on, TEST_crack.png, and its emission; all call this. */
    void write(const std::filesystem::path &folder) const;
    /** Of a complete test; it has none itself from then on. */
    std::shared_ptr<const dem::ObservedSpecimen> specimen_at_end();

    const dem::ObservedSpecimen &body() const { return specimen; }
    std::string                  size() const;    ///< "175 particles, 1203 links"
    double                       done() const;    ///< part of the most that the test can take, in [0, 1]
    std::string                  details() const; ///< where it is and how fast, for the progress line

    /** Everything to go on to the same bits. */
    void visit_state(RunState &state);

    UniaxialResult result;    ///< up to the last sample
    MaterialCounts materials; ///< before anything moves

    /** Columns of the series. */
    static std::vector<postprocess::SeriesColumn> series_columns(const UniaxialModel &model);

  private:
    UniaxialLabTest(const UniaxialModel &model, const JointedPacking &jointed, std::size_t number);

    bool        snapshot_due() const;                            ///< with the last sample
    int         seen_along() const { return axis == 2 ? 1 : 2; } ///< of pictures, across the load
    std::string draw_crack(const std::filesystem::path &folder,
                           const dem::ParticleOutput   &particles,
                           const dem::LinkOutput       &links) const;

    std::string              name; ///< "tension"
    LinkClasses              classes;
    std::vector<std::string> crack_classes; ///< of pairs of materials, where cracks of a mix are told apart
    int                      axis;
    dem::Specimen            specimen;
    dem::UniaxialTest        test;
    GravitySection           gravity;
    std::int64_t             steps_at_most;
    StepSampling             sampling;
    bool                     shown; ///< snapshots are requested
    SnapshotPieces           pieces;
    SpecimenSnapshots        snapshots;
    SidewaysStrain           sideways;
    bool                     zone_wanted;
    FractureZone             zone; ///< updated where it is wanted
  };
} // namespace apps

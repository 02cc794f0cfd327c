#pragma once

#include "apps/figures/lab_report.h"
#include "apps/process/mpi_session.h"
#include "apps/results/run_work.h"
#include "apps/results/warning.h"
#include "apps/runs/quasi_static/model.h"
#include "apps/specimens/link_classes.h"
#include "apps/specimens/material_counts.h"
#include "dem/observation/link_images.h"
#include "dem/ranks/ranks.h"
#include "postprocess/vtk/pvd.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  struct QuasiStaticReport;

  /** @param names of the packing's materials */
  MaterialCounts materials_in(const dem::ElasticNetwork &network, const std::vector<std::string> &names);

  /** What one quasi-static test found and what it took. */
  struct QuasiStaticResult
  {
    UniaxialLoad          load          = UniaxialLoad::tension;
    double                stop_fraction = 0; ///< of the peak, at which the test ends
    LabNotes              notes;             ///< the modulus is that of the first point, if nothing is damaged there
    double                worst_balance_error = 0;
    std::int64_t          strain_points = 0, opening_points = 0, relaxed_points = 0; ///< by what controlled them
    std::int64_t          solutions = 0, relaxation_steps = 0;
    dem::QuasiStaticPoint last;
    base::Column          strain, stress; ///< the curve, tension positive
    base::Column          link_classes;   ///< figures of LinkClasses at its end

    /** The next point, with its strain over the gauge length and its stress. */
    void add(const dem::QuasiStaticPoint &point, double strain, double stress);
    /** Everything that a resumed run must still know of this test; of the last point its energies. */
    void visit_state(base::StateVisitor &visitor);
  };

  /** One quasi-static test of a run: its path, its rows of the series and its snapshots. */
  class QuasiStaticLabTest
  {
  public:
    using Model  = QuasiStaticModel;
    using Result = QuasiStaticResult;
    using Report = QuasiStaticReport;

    /** Writes nothing. @param number of the test in the scene's list, from 0. @throws base::InputError. */
    QuasiStaticLabTest(const QuasiStaticModel &model, const dem::Packing &packing, std::size_t number);
    QuasiStaticLabTest(const QuasiStaticLabTest &)            = delete;
    QuasiStaticLabTest &operator=(const QuasiStaticLabTest &) = delete;

    void settle() {} ///< the unloaded network is its own equilibrium
    /** From now on snapshots go to this folder. @throws postprocess::OutputError. */
    void open(const std::filesystem::path &folder);
    /** One point further, and a snapshot when one is due. */
    void      advance();
    SeriesRow row() const; ///< of the last point
    bool      finished() const { return path.finished(); }
    /** When finished: completes the result, and takes the last snapshot. */
    void complete();
    /** Then: leaves TEST_crack.png in a folder, which the first rank alone has; all call this. */
    void write(const std::filesystem::path &folder) const
    {
      on_first_rank([&] {
        if (!folder.empty())
          warn_of_missing("crack picture", draw_crack(folder));
      });
    }
    /** A network of links without inertia has none. */
    std::shared_ptr<const dem::ObservedSpecimen> specimen_at_end() const { return nullptr; }

    /** Of the packing, where it is a periodic cell. */
    std::optional<Eigen::Vector3d> cell_edges() const { return layers ? std::nullopt : std::optional(cell); }

    std::string size() const; ///< "175 particles, 1203 links"
    double      done() const;
    std::string details() const;
    std::size_t particles_in() const { return loaded.network.particles(); }
    std::size_t links_in() const { return loaded.network.links.size(); }

    void visit_state(RunState &state);

    QuasiStaticResult        result;
    MaterialCounts           materials;
    LinkClasses              classes;
    std::vector<std::string> crack_classes; ///< of pairs of materials, where cracks of a mix are told apart

    /** Of a cell all strains are known; between grips only that along the axis. */
    static std::vector<postprocess::SeriesColumn> series_columns(const QuasiStaticModel &model);

  private:
    QuasiStaticLabTest(const QuasiStaticModel &model, const JointedPacking &jointed, std::size_t number);

    void        snapshot();
    std::string draw_crack(const std::filesystem::path &folder) const;
    double      gauged_strain() const; ///< of the last point, over the gauge length
    /** Of a periodic cell; empty for a specimen between grips. */
    std::vector<dem::LinkImage> images_of(const dem::LinkOutput &joined, const dem::ParticleOutput &state) const;

    std::shared_ptr<dem::Ranks>               team; ///< that shares linear systems; null: this process alone
    std::string                               name;
    int                                       axis;
    std::optional<dem::GripLayers>            layers; ///< of a specimen between grips
    dem::ParticleShape                        shape;
    double                                    end_strain;
    std::int64_t                              snapshot_interval;
    std::vector<double>                       radius;
    Eigen::Vector3d                           cell; ///< edges of the packing's periodic cell, if it has one [m]
    dem::LoadedNetwork                        loaded;
    dem::QuasiStaticPath                      path;
    std::optional<postprocess::PvdCollection> particles, links;
  };
} // namespace apps

#pragma once

#include "apps/results/run_state.h"
#include "apps/results/run_work.h"
#include "apps/runs/coupled/particle_medium.h"
#include "apps/runs/structure/solid.h"
#include "apps/runs/structure/weight_path.h"
#include "apps/specimens/material_counts.h"
#include "dem/observation/path_output.h"
#include "dem/ranks/ranks.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** What a structure is made of; while it is driven, elements may become particles (promotion.h). */
  struct StructureParts
  {
    dem::Packing      packing;
    ParticleGroups    groups;
    HandshakesSection handshakes;
    /** Elements that have become particles, by handshake. */
    std::vector<std::size_t> promoted;
    bool                     bears_weight = false; ///< it goes on from one whose weight, if there is any, is on
  };

  /** Particles and the solid around them, if there is one, and the path along which they are driven. */
  class Structure
  {
  public:
    /** @param media of the particles, where they are known. The model must outlive it. @throws base::InputError */
    Structure(const StructureModel &model, const StructureParts &parts, const ParticleMedia &media);
    Structure(const Structure &)            = delete;
    Structure &operator=(const Structure &) = delete;

    const dem::LoadedNetwork &network() const { return solid ? solid->network() : *alone; }
    const StructureSolid     *surrounding() const { return solid.get(); } ///< none: particles alone
    /** Along which it goes now: first the weight is put on, if there is any. */
    dem::QuasiStaticPath        &way() { return weight_path ? weight_path->way() : path; }
    const dem::QuasiStaticPath  &way() const { return weight_path ? weight_path->way() : path; }
    const dem::QuasiStaticPoint &last() const { return way().points().back(); }
    double                       load_factor() const; ///< since the weight is on
    bool                         bears_weight() const { return !weight_path; }
    bool                         finished() const { return bears_weight() && path.finished(); }
    /** Particles whose weight is left out: on hinges of two links, or without any. */
    const std::vector<dem::Mechanism> &weightless() const { return solid ? solid->swinging() : swinging; }
    Eigen::Vector3d                 weight() const; ///< of particles and solid, each with its share where both are [N]
    const MaterialCounts           &material_counts() const { return materials; }
    const ParticleGroups           &members() const { return groups; }
    const std::vector<std::size_t> &promoted() const { return promoted_elements; }
    std::string                     size() const; ///< "175 particles, 1203 links, 600 elements"

    dem::ParticleOutput particle_output() const;
    dem::LinkOutput     link_output() const { return dem::links_of(network(), way()); }

    /** Of series.csv; the first are the point and the load factor. */
    std::vector<postprocess::SeriesColumn> columns() const;
    /** Columns that the summary reports. */
    std::vector<postprocess::SeriesColumn> reported() const;
    /** Columns of the curve. @throws base::InputError where the scene names one that does not exist */
    std::pair<std::string, std::string> curve() const;
    SeriesRow                           row() const; ///< of the last point
    /** One point further. @throws as WeightPath and dem::QuasiStaticPath do */
    void advance();
    /** Of the path, and whether the weight is on. */
    void visit_path(RunState &state);
    /** @throws StoppedShort where more of an overlap is damaged than its limit */
    void watch() const;
    /** Bonds in the overlap of each handshake: all, and damaged ones. */
    std::vector<std::pair<std::size_t, std::size_t>> shared_bonds() const;

  private:
    std::vector<double>             reactions() const;
    double                          work_of_weight() const; ///< up to the last point [J]
    dem::QuasiStaticParameters      parameters() const;
    dem::LoadedNetwork              particles_alone(const dem::Packing &packing);
    void                            refuse_many_weightless() const;
    void                            refuse_soft_elements() const;
    std::unique_ptr<StructureSolid> make_solid(const dem::Packing &packing, const ParticleMedia &media) const;

    const StructureModel             &model;
    HandshakesSection                 handshakes;
    ParticleGroups                    groups;
    std::vector<std::size_t>          promoted_elements; ///< by handshake
    std::vector<double>               radius;
    std::unique_ptr<StructureSolid>   solid;
    std::vector<dem::Mechanism>       swinging; ///< of the particles alone
    std::optional<dem::LoadedNetwork> alone;    ///< where there is no solid
    MaterialCounts                    materials;
    std::shared_ptr<dem::Ranks>       team; ///< that shares the work; null: this process alone
    dem::QuasiStaticPath              path;
    std::unique_ptr<WeightPath>       weight_path; ///< none: the weight is on, or there is none
  };
} // namespace apps

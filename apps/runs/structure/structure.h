#pragma once

#include "apps/results/run_work.h"
#include "apps/runs/coupled/particle_medium.h"
#include "apps/runs/structure/solid.h"
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
  };

  /** Particles and the solid around them, if there is one, and the path along which they are driven. */
  class Structure
  {
  public:
    /** @param media of the particles, where they are known. The model must outlive it. @throws base::InputError */
    Structure(const StructureModel &model, const StructureParts &parts, const ParticleMedia &media);
    Structure(const Structure &)            = delete;
    Structure &operator=(const Structure &) = delete;

    const dem::LoadedNetwork       &network() const { return solid ? solid->network() : *alone; }
    const StructureSolid           *surrounding() const { return solid.get(); } ///< none: particles alone
    dem::QuasiStaticPath           &way() { return path; }
    const dem::QuasiStaticPath     &way() const { return path; }
    const dem::QuasiStaticPoint    &last() const { return path.points().back(); }
    double                          load_factor() const { return last().strain[network().driven]; }
    const MaterialCounts           &material_counts() const { return materials; }
    const ParticleGroups           &members() const { return groups; }
    const std::vector<std::size_t> &promoted() const { return promoted_elements; }
    std::string                     size() const; ///< "175 particles, 1203 links, 600 elements"

    dem::ParticleOutput particle_output() const;
    dem::LinkOutput     link_output() const { return dem::links_of(network(), path); }

    /** Of series.csv; the first are the point and the load factor. */
    std::vector<postprocess::SeriesColumn> columns() const;
    /** Columns that the summary reports. */
    std::vector<postprocess::SeriesColumn> reported() const;
    /** Columns of the curve. @throws base::InputError where the scene names one that does not exist */
    std::pair<std::string, std::string> curve() const;
    SeriesRow                           row() const; ///< of the last point
    /** @throws StoppedShort where more of an overlap is damaged than its limit */
    void watch() const;
    /** Bonds in the overlap of each handshake: all, and damaged ones. */
    std::vector<std::pair<std::size_t, std::size_t>> shared_bonds() const;

  private:
    std::vector<double>             reactions() const;
    std::unique_ptr<StructureSolid> make_solid(const dem::Packing &packing, const ParticleMedia &media) const;

    const StructureModel             &model;
    HandshakesSection                 handshakes;
    ParticleGroups                    groups;
    std::vector<std::size_t>          promoted_elements; ///< by handshake
    std::vector<double>               radius;
    std::unique_ptr<StructureSolid>   solid;
    std::optional<dem::LoadedNetwork> alone; ///< where there is no solid
    MaterialCounts                    materials;
    std::shared_ptr<dem::Ranks>       team; ///< that shares the work; null: this process alone
    dem::QuasiStaticPath              path;
  };
} // namespace apps

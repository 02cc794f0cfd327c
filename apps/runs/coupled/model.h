#pragma once

#include "apps/figures/contact_figures.h"
#include "apps/runs/coupled/couplings.h"
#include "apps/runs/coupled/handshakes.h"
#include "apps/runs/coupled/laboratory.h"
#include "apps/runs/coupled/particle_medium.h"
#include "apps/runs/particles/model.h"
#include "base/entry_path.h"

#include <utility>

namespace apps
{
  /** Everything that a scene of kind "coupled" says. */
  struct CoupledModel
  {
    ContinuumModel    continuum = ContinuumModel::of_each_rank();
    ParticlesModel    particles; ///< its course (time, gravity, stops, output) is that of all
    CouplingsSection  couplings;
    HandshakesSection handshakes;
    LaboratorySection laboratory;
    ReferencesSection references;
    std::int64_t      largest_ratio    = 1;     ///< of steps of either side in one of the other
    double            sub_cycling_loss = 0.005; ///< that it may make, over the largest energy
    bool              checked_windows  = false; ///< what loses too much is taken back

    /** @throws base::InputError. */
    void check(const base::EntryPath &root) const;
    /** Of couplings. @param known of the mesh @throws base::InputError */
    void            refuse_unknown_boundaries(const std::vector<std::string> &known) const;
    base::EntryPath path_of(const CouplingSection &coupling) const;

    /** What can be said once the solid is made. @throws base::InputError for a stop or a curve of a column that there is not */
    void check_columns(const std::vector<postprocess::SeriesColumn> &columns,
                       const std::vector<postprocess::SeriesColumn> &reported) const;
    /** Columns of the curve. @throws base::InputError */
    std::pair<std::string, std::string> curve(const std::vector<postprocess::SeriesColumn> &columns,
                                              const std::vector<postprocess::SeriesColumn> &reported) const;

    /** Of the specimen what lies where particles are to be, where a scene says so; and all others. @param cell as specimen_particles() has it @throws as ParticlesModel::packing() */
    dem::Packing packing(std::optional<dem::Packing> *cell = nullptr) const;
    /** Of the particles, where the solid shares a place with them and they are known. @param cell as packing() gives it */
    ParticleMedia media(const std::optional<dem::Packing> &cell) const;

    int dimension() const { return particles.physics.dimension; }

  private:
    /** @throws base::InputError for a side that "top" or "bottom" does not determine, where there is weight */
    void check_sides(const base::EntryPath &root) const;
  };
} // namespace apps

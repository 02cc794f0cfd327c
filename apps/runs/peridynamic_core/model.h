#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/peridynamics/model.h"
#include "base/entry_path.h"
#include "coupling/volume/parameters.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace apps
{
  /** Section "Handshake": the layer at the core's sides in which elements and bonds both are. */
  struct CoreHandshakeSection
  {
    std::vector<std::string> sides = {"left", "right"}; ///< of the core that lie in the elements
    double                   width = 0;                 ///< [m]
    coupling::Compatibility  ties  = coupling::Compatibility::coarse;
  };

  /** Everything that a scene of kind "peridynamic_core" says. */
  struct PeridynamicCoreModel
  {
    ContinuumModel       continuum;
    PeridynamicsModel    core;
    CoreHandshakeSection handshake;
    double               end_time = 0; ///< [s]
    OutputSection        output;
    std::string          horizontal, vertical; ///< columns of the curve; "": chosen by the program

    /** @throws base::InputError */
    void check(const base::EntryPath &root) const;

    int                                dimension() const { return continuum.solid.dimension; }
    Eigen::AlignedBox3d                room() const; ///< of the core; endless along z in the plane [m]
    coupling::VolumeCouplingParameters parameters() const;
    /** Whether an element that lies wholly in such places goes. */
    bool is_taken(const Eigen::Vector3d &place) const;

  private:
    void check_handshake(const base::EntryPath &root) const;
    void check_shared(const base::EntryPath &root) const;
  };
} // namespace apps

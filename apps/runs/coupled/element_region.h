#pragma once

#include "apps/runs/continuum/mesh.h"
#include "coupling/volume/mesh_elements.h"

#include <memory>
#include <string>

namespace apps
{
  /** The elements of a scene's mesh. start_mpi() must have been called. @throws base::InputError as make_mesh() */
  std::unique_ptr<coupling::MeshElements> elements_of(const MeshSection &mesh, int dimension);

  /** Those of a group. @throws base::InputError that proposes another, for a group that the mesh does not have */
  coupling::MeshElements::Set elements_of_group(const coupling::MeshElements &mesh, const std::string &group);
} // namespace apps

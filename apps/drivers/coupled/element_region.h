#pragma once

#include "apps/drivers/continuum/mesh.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace apps
{
  /**
   * Distance of a place from the elements of a group, negative inside [m]: from the faces that they share with others, free surfaces are
   * no ends of theirs. start_mpi() must have been called.
   * @throws base::InputError for a group that the mesh does not have, or that is all of it
   */
  std::function<double(const Eigen::Vector3d &)>
  distance_from_elements(const MeshSection &mesh, int dimension, const std::string &group);
} // namespace apps

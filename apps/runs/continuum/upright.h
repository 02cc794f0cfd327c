#pragma once

#include <Eigen/Core>

#include <string>

namespace apps
{
  struct ContinuumModel;

  /**
   * What is wrong with the name of a side of a built-in shape where there is weight: "top" is the side of most y, which need not be the
   * upper one. "" for nothing.
   *
   * @param weight its direction and size; zero: nothing is up
   */
  std::string fault_of_side(const std::string &boundary, const Eigen::Vector3d &weight);

  /** The same of all boundary conditions of a shape. @throws base::InputError with the place */
  void require_upright_names(const ContinuumModel &model, const Eigen::Vector3d &weight);

  /** Force per volume at t = 1, by when it has grown; zero where it varies from place to place. */
  Eigen::Vector3d body_force_at_once(const ContinuumModel &model);
} // namespace apps

#pragma once

#include "apps/runs/continuum/model.h"
#include "fem/solid/solid.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <memory>

namespace apps
{
  /** Place in a model of dimension dim; the third coordinate is dropped in two dimensions. */
  template <int dim>
  dealii::Point<dim> point_of(const std::array<double, 3> &place)
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = place[d];
    return point;
  }

  /** What others occupy of a solid's place. */
  struct TakenPlaces
  {
    std::function<double(const std::array<double, 3> &)>
                                                 share; ///< as fem::SolidOptions has it; empty: all is the solid's
    std::function<bool(const Eigen::Vector3d &)> whole; ///< elements that lie wholly in such places go; empty: none
    bool                                         holds = false; ///< it may hold the solid where supports do not
  };

  /**
   * The solid of a scene: mesh, materials, supports and loads, ready for a solver.
   *
   * Histories are virgin; a sequential analysis sets them next (fem::MaterialPoints::set_initial).
   * start_mpi() must have been called.
   * @throws base::InputError naming the place in the scene, or the mesh and what is wrong with it.
   */
  template <int dim>
  std::unique_ptr<fem::Solid<dim>> make_solid(const ContinuumModel &model, const TakenPlaces &taken = {});

  /**
   * Warnings of elements that are too wide for the fracture energy of their material, in every direction: a run ends where one of them
   * cracks. (make_solid() refuses a group of which every element is.) All ranks together.
   */
  template <int dim>
  std::vector<std::string> coarse_elements(const fem::Solid<dim> &solid, const ContinuumModel &model);
} // namespace apps

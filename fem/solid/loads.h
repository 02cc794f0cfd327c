#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <functional>
#include <string>
#include <vector>

namespace fem
{
  /// A number that depends on place [m] and time [s] (in static analyses a pseudo-time).
  template <int dim>
  using ScalarOf = std::function<double(const dealii::Point<dim> &, double)>;

  template <int dim>
  using VectorOf = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &, double)>;

  /// One displacement component [m] of a boundary.
  template <int dim>
  struct PrescribedDisplacement
  {
    std::string   boundary;
    unsigned int  component;
    ScalarOf<dim> value;
  };

  /// One displacement component [m] of the node nearest to a point.
  template <int dim>
  struct PrescribedNode
  {
    dealii::Point<dim> where;
    unsigned int       component;
    ScalarOf<dim>      value;
    double             tolerance = 1e-6; ///< how far the node may be, as a share of the mesh's extent
  };

  /// One displacement component [m] of every node in a box: a point, an edge, a face or a region.
  template <int dim>
  struct PrescribedBox
  {
    dealii::Point<dim> low, high;
    unsigned int       component;
    ScalarOf<dim>      value;
  };

  /// Force per undeformed area [Pa].
  template <int dim>
  struct Traction
  {
    std::string   boundary;
    VectorOf<dim> value;
  };

  /// Pressure [Pa] against the undeformed outward normal: positive compresses.
  template <int dim>
  struct Pressure
  {
    std::string   boundary;
    ScalarOf<dim> value;
  };

  /// Force [N] at any point of the solid (in plane models per thickness of the model).
  template <int dim>
  struct PointForce
  {
    dealii::Point<dim>                            where;
    std::function<dealii::Tensor<1, dim>(double)> value;
  };

  /// Everything that acts on a solid from outside.
  template <int dim>
  struct Loads
  {
    std::vector<PrescribedDisplacement<dim>> displacements;
    std::vector<PrescribedNode<dim>>         nodes;
    std::vector<PrescribedBox<dim>>          boxes;
    std::vector<Traction<dim>>               tractions;
    std::vector<Pressure<dim>>               pressures;
    std::vector<PointForce<dim>>             point_forces;
    VectorOf<dim>                            body_force;                   ///< [N/m^3]; empty: none
    bool                                     body_force_is_steady = false; ///< the same at all times: integrated once
    bool remove_rigid_motion = false; ///< hold 3 (2d) or 6 (3d) displacements of three nodes at zero
    bool may_move_freely     = false; ///< supports need not hold the solid: its mass does, in explicit motion
  };
}

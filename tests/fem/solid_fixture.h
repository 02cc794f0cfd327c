#pragma once

#include "fem/materials/isotropic_elastic.h"
#include "fem/solvers/static_solver.h"

#include <catch2/catch.hpp>
#include <deal.II/base/function.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <string>

inline fem::IsotropicElastic elastic(const double young, const double poisson)
{
  fem::IsotropicElasticParameters p;
  p.young_modulus = young;
  p.poisson_ratio = poisson;
  return fem::IsotropicElastic(p);
}

/// What is held: a value of zero wherever and whenever.
inline const auto zero = [](const auto & /* place */, const double /* time */) { return 0.0; };

/// A box with boundaries named 0 (x low), 1 (x high), 2, 3, 4, 5.
template <int dim>
fem::BuildMesh<dim> box(const dealii::Point<dim>        &low,
                        const dealii::Point<dim>        &high,
                        const std::vector<unsigned int> &elements,
                        const double                     distortion = 0)
{
  return [=](dealii::Triangulation<dim> &mesh) {
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, elements, low, high, true);
    for (const auto &cell : mesh.active_cell_iterators()) // the generator colours octants
      cell->set_material_id(0);
    if (distortion > 0)
      dealii::GridTools::distort_random(distortion, mesh, true, 20);
  };
}

/// The same from the origin on.
template <int dim>
fem::BuildMesh<dim>
box(const dealii::Point<dim> &corner, const std::vector<unsigned int> &elements, const double distortion = 0)
{
  return box<dim>(dealii::Point<dim>(), corner, elements, distortion);
}

/// A solid of one material under loads, and its static solver.
template <int dim>
struct Model
{
  template <typename Law>
  Model(const fem::BuildMesh<dim>      &build,
        const fem::ElementFamily        family,
        const fem::SolidOptions        &options,
        const Law                      &law,
        const fem::Loads<dim>          &loads,
        const fem::NewtonOptions       &newton = {},
        const MPI_Comm                  comm   = MPI_COMM_SELF,
        const fem::LinearSolverOptions &linear = {})
    : solid(fem::make_mesh<dim>(build, family, comm), options)
  {
    const auto names = solid.mesh().materials;
    for (const auto &entry : names)
      solid.assign(entry.first, fem::make_points(law, options.plane));
    solid.set_loads(loads);
    solver = std::make_unique<fem::StaticSolver<dim>>(solid, newton, linear);
  }

  /// Displacement component at a point.
  double at(const dealii::Point<dim> &where, const unsigned int component) const
  {
    double sum = 0;
    for (const auto &[dof, weight] : solid.interpolation(where, component))
      sum += weight * solver->displacement()[dof];
    return dealii::Utilities::MPI::sum(sum, solid.communicator());
  }

  fem::Solid<dim>                         solid;
  std::unique_ptr<fem::StaticSolver<dim>> solver;
};

/// Displacement of every boundary of a box.
template <int dim>
fem::Loads<dim> hold_all(const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &, double)> &field)
{
  fem::Loads<dim> loads;
  for (unsigned int face = 0; face < 2 * dim; ++face)
    for (unsigned int c = 0; c < dim; ++c)
      loads.displacements.push_back(
        {std::to_string(face), c, [=](const dealii::Point<dim> &x, double t) { return field(x, t)[c]; }});
  return loads;
}

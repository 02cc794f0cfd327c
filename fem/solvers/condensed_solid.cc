#include "fem/solvers/condensed_solid.h"

#include "base/errors.h"

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fem
{
  namespace
  {
    constexpr int of_nothing = std::numeric_limits<int>::max(); ///< neither kept nor inside
  }

  template <int dim>
  CondensedSolid<dim>::CondensedSolid(Solid<dim> &of_solid, const std::vector<Dof> &wanted, const Vector *const dead)
    : solid(of_solid)
  {
    if (!solid.linear())
      throw base::InputError(
        "statics of particles in a solid: the solid must be linear elastic, at small displacements.");
    if (dealii::Utilities::MPI::n_mpi_processes(solid.communicator()) > 1)
      throw base::InputError("statics of particles in a solid: runs on one rank.");
    prescribed =
      in_proportion([this](const double t, Vector &v) { solid.prescribed(t, v); }, "prescribed displacements");
    loads = in_proportion([this](const double t, Vector &v) { solid.external_force(t, v); }, "loads");
    sort_displacements(wanted);
    assemble();
    condense();
    if (dead)
      condense_dead(*dead);
  }

  template <int dim>
  Vector CondensedSolid<dim>::in_proportion(const std::function<void(double, Vector &)> &of_time,
                                            const char                                  *what) const
  {
    Vector at[3];
    for (int t = 0; t < 3; ++t)
      {
        at[t] = solid.make_vector();
        of_time(t, at[t]);
      }
    constexpr double rounding = 1e-9;
    const double     size     = at[1].linfty_norm();
    at[2].add(-2, at[1]);
    if (at[0].linfty_norm() > rounding * size || at[2].linfty_norm() > rounding * size)
      throw base::InputError(std::string("statics of particles in a solid: ") + what +
                             " must grow in proportion to t, the load factor: a number times t.");
    at[1].update_ghost_values();
    return at[1];
  }

  template <int dim>
  void CondensedSolid<dim>::sort_displacements(const std::vector<Dof> &wanted)
  {
    kept = wanted;
    place.assign(solid.dofs().n_dofs(), of_nothing);
    for (std::size_t k = 0; k < kept.size(); ++k)
      place[kept[k]] = static_cast<int>(k);
    for (Dof i = 0; i < place.size(); ++i)
      if (place[i] == of_nothing && !is_prescribed(i))
        {
          place[i] = -1 - static_cast<int>(inside.size());
          inside.push_back(i);
        }
  }

  template <int dim>
  void CondensedSolid<dim>::assemble()
  {
    Matrix tangent;
    solid.make_matrix(tangent);
    Vector internal = solid.make_vector(), of_prescribed = solid.make_vector();
    Sweep  wanted;
    wanted.internal_force = &internal;
    wanted.tangent        = &tangent;
    wanted.products       = {{&prescribed, &of_prescribed}};
    solid.sweep(solid.make_vector(), wanted);

    const auto n = static_cast<Eigen::Index>(kept.size()), m = static_cast<Eigen::Index>(inside.size());
    std::vector<Eigen::Triplet<double>> of_inside, across;
    of_kept                         = Eigen::MatrixXd::Zero(n, n);
    const Epetra_CrsMatrix &matrix  = tangent.trilinos_matrix();
    int                     entries = 0, *columns = nullptr;
    double                 *values = nullptr;
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        const int i = place[static_cast<std::size_t>(matrix.GRID(row))];
        matrix.ExtractMyRowView(row, entries, values, columns);
        for (int e = 0; e < entries && i != of_nothing; ++e)
          {
            const Dof column = static_cast<Dof>(matrix.ColMap().GID(columns[e]));
            const int j      = place[column];
            if (j == of_nothing || is_prescribed(column) || is_prescribed(static_cast<Dof>(matrix.GRID(row))))
              continue;
            if (i >= 0 && j >= 0)
              of_kept(i, j) = values[e];
            else if (i < 0 && j < 0)
              of_inside.emplace_back(-1 - i, -1 - j, values[e]);
            else if (i < 0)
              across.emplace_back(-1 - i, j, values[e]);
          }
      }
    inner.resize(m, m);
    inner.setFromTriplets(of_inside.begin(), of_inside.end());
    between.resize(m, n);
    between.setFromTriplets(across.begin(), across.end());

    on_kept = work_on_kept = Eigen::VectorXd::Zero(n);
    on_inside = load_inside = Eigen::VectorXd::Zero(m);
    for (Dof i = 0; i < place.size(); ++i)
      {
        const double force = of_prescribed[i] - loads[i];
        of_loads += prescribed[i] * (of_prescribed[i] - 2 * loads[i]);
        work_on_itself += prescribed[i] * loads[i];
        if (is_prescribed(i))
          {
            if (place[i] >= 0 && place[i] != of_nothing && prescribed[i] != 0)
              throw base::InputError(
                "statics of particles in a solid: a node among particles is moved by a boundary condition "
                "as well. Let the particles' region end before it.");
            continue;
          }
        (place[i] >= 0 ? on_kept[place[i]] : on_inside[-1 - place[i]])        = force;
        (place[i] >= 0 ? work_on_kept[place[i]] : load_inside[-1 - place[i]]) = loads[i];
      }
  }

  template <int dim>
  void CondensedSolid<dim>::condense()
  {
    if (inside.empty())
      return;
    constexpr double none = 1e-12; // of the largest pivot
    factor.compute(inner);
    if (factor.info() != Eigen::Success || factor.vectorD().minCoeff() <= none * factor.vectorD().maxCoeff())
      throw base::InputError(
        "statics of particles in a solid: a part of the solid is held neither by supports nor by particles. "
        "Prescribe more displacements.");
    constexpr Eigen::Index at_once = 64;
    for (Eigen::Index first = 0; first < between.cols(); first += at_once)
      {
        const Eigen::Index    count   = std::min(at_once, between.cols() - first);
        const Eigen::MatrixXd columns = between.middleCols(first, count);
        of_kept.middleCols(first, count) -= between.transpose() * factor.solve(columns);
      }
    of_kept                    = 0.5 * (of_kept + of_kept.transpose()).eval(); // what rounding has left
    const Eigen::VectorXd held = factor.solve(on_inside);
    on_kept -= between.transpose() * held;
    of_loads -= on_inside.dot(held);
    work_on_kept -= between.transpose() * factor.solve(load_inside);
    work_on_itself -= load_inside.dot(held);
  }

  template <int dim>
  void CondensedSolid<dim>::condense_dead(const Vector &force)
  {
    of_dead.on_kept = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kept.size()));
    dead_inside     = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(inside.size()));
    for (Dof i = 0; i < place.size(); ++i)
      {
        of_dead.by_factor += prescribed[i] * force[i];
        if (!is_prescribed(i))
          (place[i] >= 0 ? of_dead.on_kept[place[i]] : dead_inside[-1 - place[i]]) = force[i];
      }
    if (inside.empty())
      return;
    const Eigen::VectorXd moved = factor.solve(dead_inside);
    of_dead.on_kept -= between.transpose() * moved;
    of_dead.by_factor -= on_inside.dot(moved);
    of_dead.by_itself = dead_inside.dot(moved);
    of_dead.on_loads  = load_inside.dot(moved);
  }

  template <int dim>
  Vector CondensedSolid<dim>::displacement(const Eigen::VectorXd &x, const double p, const double part) const
  {
    Vector u = solid.make_vector();
    u.equ(p, prescribed);
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (!is_prescribed(kept[k]))
        u[kept[k]] = x[static_cast<Eigen::Index>(k)];
    if (!inside.empty())
      {
        Eigen::VectorXd on = -(between * x) - p * on_inside;
        if (part != 0)
          on += part * dead_inside;
        const Eigen::VectorXd inner_motion = factor.solve(on);
        for (std::size_t k = 0; k < inside.size(); ++k)
          u[inside[k]] = inner_motion[static_cast<Eigen::Index>(k)];
      }
    u.update_ghost_values();
    return u;
  }

  template class CondensedSolid<2>;
  template class CondensedSolid<3>;
}

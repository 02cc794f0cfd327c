// The stable step of a motion by central differences: of the elements as they are made, and as they are deformed.

#include "fem/explicit/element_mass.h"
#include "fem/solid/element_kernel.h"

#include <Eigen/Eigenvalues>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <optional>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// The largest eigenvalue of elements, lumped mass and present stiffness [1/s^2].
    template <int dim>
    class ElementEigenvalues
    {
    public:
      using Cell = typename DoFHandler<dim>::active_cell_iterator;

      ElementEigenvalues(const Solid<dim> &solid_, const ExplicitOptions &options_)
        : solid(solid_)
        , options(options_)
        , density(density_by_id(solid_, options_))
        , values(solid.mapping(),
                 solid.dofs().get_fe(),
                 solid.quadrature(),
                 update_values | update_gradients | update_JxW_values | update_quadrature_points)
        , kernel(solid.dofs().get_fe(),
                 solid.quadrature().size(),
                 solid.options().large_displacement,
                 solid.options().mean_dilatation)
        , mass(solid.dofs().get_fe().n_dofs_per_cell())
      {
      }

      /// What of an element counts at its points, which is treated from now on; empty: all.
      std::vector<double> look_at(const Cell &cell)
      {
        values.reinit(cell);
        return shares_of(solid.options(), values);
      }

      /// Of the element that is treated. @param displacement of its degrees of freedom
      double operator()(const Cell                &cell,
                        const MaterialPoints      &material,
                        const std::vector<double> &shares,
                        const Eigen::VectorXd     &displacement)
      {
        const auto n = static_cast<Eigen::Index>(mass.size());
        element_mass(values, density.at(cell->material_id()), shares, options.shared, mass);
        kernel.reinit(values, displacement);
        for (unsigned int q = 0; q < shares.size(); ++q)
          kernel.share(q, shares[q]);
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
        for (unsigned int q = 0; q < solid.quadrature().size(); ++q)
          {
            const base::Voigt     strain  = kernel.strain(q);
            const base::Stiffness tangent = material.elastic_stiffness();
            kernel.add_stiffness(tangent * strain, tangent, k);
          }
        for (Eigen::Index a = 0; a < n; ++a)
          for (Eigen::Index b = 0; b < n; ++b)
            k(a, b) /= std::sqrt(mass[static_cast<std::size_t>(a)] * mass[static_cast<std::size_t>(b)]);
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[n - 1];
      }

    private:
      const Solid<dim>                    &solid;
      const ExplicitOptions               &options;
      std::map<types::material_id, double> density;
      FEValues<dim>                        values;
      ElementKernel<dim>                   kernel;
      std::vector<double>                  mass;
    };

    /// Elements of one shape, material and share have the same numbers.
    template <int dim>
    std::vector<long long> shape_of(const typename DoFHandler<dim>::active_cell_iterator &cell,
                                    const std::vector<double>                            &shares)
    {
      std::vector<long long> shape{static_cast<long long>(cell->material_id())};
      const double           unit = 1e-9 * cell->diameter();
      shape.push_back(std::llround(std::log(cell->diameter()) * 1e9));
      for (unsigned int w = 1; w < cell->n_vertices(); ++w)
        for (unsigned int d = 0; d < dim; ++d)
          shape.push_back(std::llround((cell->vertex(w)[d] - cell->vertex(0)[d]) / unit));
      for (const double share : shares)
        shape.push_back(std::llround(share * 1e9));
      return shape;
    }
  }

  template <int dim>
  void ExplicitSolver<dim>::find_step()
  {
    ElementEigenvalues<dim> eigenvalue(solid, options);
    const auto undeformed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(solid.dofs().get_fe().n_dofs_per_cell()));
    // A regular mesh costs one eigenvalue problem.
    std::map<std::vector<long long>, double> known;
    double                                   largest = 0;
    std::size_t                              next    = 0;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto               &points = solid.element_points()[next++];
          const std::vector<double> shares = solid.options().share ? eigenvalue.look_at(cell) : std::vector<double>();
          const auto                shape  = shape_of<dim>(cell, shares);
          auto                      found  = known.find(shape);
          if (found == known.end())
            {
              if (!solid.options().share)
                eigenvalue.look_at(cell);
              found = known.emplace(shape, eigenvalue(cell, *points.material, shares, undeformed)).first;
            }
          largest = std::max(largest, found->second);
          if (solid.options().large_displacement)
            elements.push_back({vertex_distances(cell), found->second});
        }
    limit_step(largest);
  }

  template <int dim>
  std::vector<double>
  ExplicitSolver<dim>::vertex_distances(const typename DoFHandler<dim>::active_cell_iterator &cell) const
  {
    std::vector<Point<dim>> now;
    for (const unsigned int w : cell->vertex_indices())
      {
        now.push_back(cell->vertex(w));
        for (unsigned int d = 0; d < dim; ++d)
          now.back()[d] += u[cell->vertex_dof_index(w, d)];
      }
    std::vector<double> distances;
    for (std::size_t a = 1; a < now.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        distances.push_back(now[a].distance_square(now[b]));
    return distances;
  }

  template <int dim>
  void ExplicitSolver<dim>::follow_deformation()
  {
    // In so few steps, none longer than a wave takes through an element, lengths change by little unless the material is torn apart.
    constexpr int    steps_between_looks = 10;
    constexpr double changed             = 0.02; // of a squared length: a hundredth of the length
    if (++since_look < steps_between_looks)
      return;
    since_look = 0;
    std::optional<ElementEigenvalues<dim>> eigenvalue; // costs something already when it is made
    std::vector<types::global_dof_index>   indices(solid.dofs().get_fe().n_dofs_per_cell());
    Eigen::VectorXd                        displacement(static_cast<Eigen::Index>(indices.size()));
    double                                 largest = 0;
    std::size_t                            next    = 0;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          ElementStep        &element   = elements[next];
          const auto         &points    = solid.element_points()[next++];
          std::vector<double> distances = vertex_distances(cell);
          const bool          same      = std::equal(distances.begin(), distances.end(), element.distances.begin(),
                                                     [](const double a, const double b) { return std::fabs(a - b) < changed * b; });
          if (!same)
            {
              if (!eigenvalue)
                eigenvalue.emplace(solid, options);
              const std::vector<double> shares = eigenvalue->look_at(cell);
              cell->get_dof_indices(indices);
              for (std::size_t i = 0; i < indices.size(); ++i)
                displacement[static_cast<Eigen::Index>(i)] = u[indices[i]];
              element = {std::move(distances), (*eigenvalue)(cell, *points.material, shares, displacement)};
            }
          largest = std::max(largest, element.eigenvalue);
        }
    limit_step(largest);
  }

  template <int dim>
  void ExplicitSolver<dim>::limit_step(const double largest_eigenvalue)
  {
    step_limit = 2 / std::sqrt(Utilities::MPI::max(largest_eigenvalue, solid.communicator()));
  }

  template void ExplicitSolver<2>::find_step();
  template void ExplicitSolver<3>::find_step();
  template void ExplicitSolver<2>::follow_deformation();
  template void ExplicitSolver<3>::follow_deformation();
  template void ExplicitSolver<2>::limit_step(double);
  template void ExplicitSolver<3>::limit_step(double);
}

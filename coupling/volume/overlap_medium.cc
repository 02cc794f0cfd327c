#include "coupling/volume/overlap_medium.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    template <int dim>
    double volume_of_elements(const fem::Solid<dim> &solid, const Overlap &overlap)
    {
      dealii::FEValues<dim> values(solid.mapping(), solid.dofs().get_fe(), solid.quadrature(),
                                   dealii::update_quadrature_points | dealii::update_JxW_values);
      double                volume = 0;
      for (const auto &cell : solid.dofs().active_cell_iterators())
        {
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const auto x = values.quadrature_point(q);
              if (overlap.contains(Vector3d(x[0], x[1], dim == 3 ? x[dim - 1] : 0.0)))
                volume += values.JxW(q);
            }
        }
      return dim == 2 ? volume * solid.options().thickness : volume;
    }
  } // namespace

  template <int dim>
  OverlapMedium medium_in_overlap(const dem::ElasticNetwork &network,
                                  const std::vector<double> &masses,
                                  const fem::Solid<dim>     &solid,
                                  const Overlap             &overlap)
  {
    OverlapMedium medium;
    const double  volume = volume_of_elements(solid, overlap);
    if (!(volume > 0))
      return medium;
    for (std::size_t i = 0; i < masses.size(); ++i)
      if (overlap.contains(network.centre[i]))
        medium.density += masses[i] / volume;
    for (const dem::ElasticLink &link : network.links)
      {
        const Vector3d &first = network.centre[static_cast<std::size_t>(link.first)];
        if (overlap.contains(first) || overlap.contains(network.centre[static_cast<std::size_t>(link.second)]))
          medium.longest_bond = std::max(medium.longest_bond, link.branch.norm());
        if (!overlap.contains(first + link.arm_first * link.direction))
          continue;
        Eigen::Matrix<double, 3, 6> slip; // of each unit strain
        for (int v = 0; v < 6; ++v)
          slip.col(v) = base::strain_tensor(base::Voigt::Unit(v)) * link.branch;
        medium.stiffness += slip.transpose() * link.stiffness * slip / volume;
      }
    if (dim == 2) // as that of a periodic cell of discs: out of the plane stiff by itself alone
      for (const int c : {2, 3, 4})
        medium.stiffness(c, c) = medium.stiffness.maxCoeff();
    return medium;
  }

  template OverlapMedium
  medium_in_overlap(const dem::ElasticNetwork &, const std::vector<double> &, const fem::Solid<2> &, const Overlap &);
  template OverlapMedium
  medium_in_overlap(const dem::ElasticNetwork &, const std::vector<double> &, const fem::Solid<3> &, const Overlap &);
} // namespace coupling

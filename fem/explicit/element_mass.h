#pragma once

#include "fem/explicit/explicit_solver.h"

#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <map>
#include <vector>

/// Lumped mass of one element, whose share of everything may vary.
namespace fem
{
  /// What counts of an element at its points; empty: all of it. @pre `values` knows where they are
  template <int dim>
  std::vector<double> shares_of(const SolidOptions &options, const dealii::FEValues<dim> &values)
  {
    std::vector<double> shares;
    if (!options.share)
      return shares;
    for (const auto &place : values.get_quadrature_points())
      shares.push_back(share_at(options, place));
    return std::any_of(shares.begin(), shares.end(), [](const double s) { return s != 1; }) ? shares :
                                                                                              std::vector<double>{};
  }

  /// Where only a part of the element counts: sums over the rows of the consistent mass, which keep its centre. Positive of linear elements.
  template <int dim>
  void mass_of_shares(const dealii::FEValues<dim> &values,
                      const double                 density,
                      const std::vector<double>   &shares,
                      std::vector<double>         &mass)
  {
    for (unsigned int i = 0; i < mass.size(); ++i)
      {
        mass[i] = 0;
        for (unsigned int q = 0; q < shares.size(); ++q)
          mass[i] += shares[q] * density * values.shape_value(i, q) * values.JxW(q);
      }
  }

  /// Diagonal of the consistent mass scaled to the element's mass, component by component: where the share varies evenly, that of what lies
  /// nearest to the node of a linear element.
  template <int dim>
  void element_mass(const dealii::FEValues<dim> &values,
                    const double                 density,
                    const std::vector<double>   &shares,
                    const SharedMass             shared,
                    std::vector<double>         &mass)
  {
    // Rows of quadratic elements have sums of nothing and less, where their share varies.
    const auto &fe = values.get_fe();
    if (!shares.empty() && shared == SharedMass::rows && fe.degree == 1)
      return mass_of_shares(values, density, shares, mass);
    const auto density_at = [&](const unsigned int q) { return shares.empty() ? density : shares[q] * density; };
    double     whole = 0, diagonal = 0;
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      whole += density_at(q) * values.JxW(q);
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        mass[i] = 0;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          mass[i] += density_at(q) * values.shape_value(i, q) * values.shape_value(i, q) * values.JxW(q);
        if (fe.system_to_component_index(i).first == 0)
          diagonal += mass[i];
      }
    for (double &m : mass)
      m *= whole / diagonal;
  }

  template <int dim>
  std::map<dealii::types::material_id, double> density_by_id(const Solid<dim> &solid, const ExplicitOptions &options)
  {
    std::map<dealii::types::material_id, double> by_id;
    for (const auto &[name, id] : solid.mesh().materials)
      by_id[id] = options.density.at(name);
    return by_id;
  }
}

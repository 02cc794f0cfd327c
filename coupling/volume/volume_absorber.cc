#include "coupling/volume/volume_coupling.h"
#include "dem/model/particles.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  void set_absorber(VolumeCouplingParameters  &parameters,
                    const AbsorberProportions &proportions,
                    const double               element_size,
                    const double               wave_speed)
  {
    parameters.absorbs = true;
    parameters.layer   = proportions.layer * element_size;
    parameters.rate    = proportions.rate * wave_speed / element_size;
    parameters.spacing = proportions.grid * element_size;
    parameters.phase   = proportions.phase;
  }

  template <int dim>
  void VolumeCoupling<dim>::make_absorber()
  {
    AbsorberCarriers all;
    all.dimension  = dim;
    all.components = {0, dim};
    all.places     = places;
    all.whole_mass = whole_mass;
    Eigen::VectorXd rates(mass.rows());
    for (Index k = 0; k < mass.rows(); ++k)
      {
        const double along = std::clamp((own.overlap.distance(places[static_cast<std::size_t>(k)]) + own.layer) /
                                          (own.layer + own.overlap.width),
                                        0.0, 1.0);
        rates[k]           = own.rate * along * along;
      }
    all.damping      = rates.cwiseProduct(mass.col(0));
    all.inverse_mass = inverse_mass;
    enter_points(all);
    weigh_nodes();
    all.inverse_node_mass = inverse_node_mass;
    absorber.emplace(AbsorberParameters{own.spacing, own.sharpness, own.phase}, std::move(all));
    if (specimen.parameters().physics.rotations)
      make_spin_absorber(rates);
  }

  template <int dim>
  void VolumeCoupling<dim>::make_spin_absorber(const Eigen::VectorXd &rates)
  {
    const Index rows = mass.rows();
    inertia = inverse_inertia = CarrierRows::Zero(rows, 3);
    AbsorberCarriers all;
    all.dimension = dim;
    if (dim == 2)
      all.components = {2, 1}; // about the normal of the plane
    all.places     = places;
    all.whole_mass = all.damping = Eigen::VectorXd(rows);
    for (Index k = 0; k < rows; ++k)
      {
        const dem::ParticleState p = specimen.particle(watched[static_cast<std::size_t>(k)]);
        for (int c = dim == 3 ? 0 : 2; c < 3; ++c)
          {
            inertia(k, c)         = p.inertia;
            inverse_inertia(k, c) = p.held[static_cast<std::size_t>(3 + c)] ? 0.0 : 1 / p.inertia;
          }
        all.whole_mass[k] = p.inertia * whole_mass[k] / p.mass;
        all.damping[k]    = rates[k] * p.inertia;
      }
    all.inverse_mass = inverse_inertia;
    all.point_mass.resize(0);
    all.weights.resize(0, 0);
    all.inverse_node_mass.resize(0, 3);
    spin_absorber.emplace(AbsorberParameters{own.spacing, own.sharpness, own.phase}, std::move(all));
  }

  template <int dim>
  double VolumeCoupling<dim>::longest_absorption() const
  {
    return spin_absorber ? std::min(absorber->longest_time(), spin_absorber->longest_time()) : absorber->longest_time();
  }

  template <int dim>
  unsigned int VolumeCoupling<dim>::points_per_axis() const
  {
    // Two where they are still few beside the particles that would be there; with one the longest of the waves that elements
    // hardly carry lose a hundredth more.
    constexpr double particles_between = 4;
    const auto       cell              = solid.dofs().begin_active();
    const double     thickness         = dim == 2 ? solid.options().thickness : 1.0,
                 room                  = whole_mass.mean() / (motion.density(cell->material_id()) * thickness);
    const bool fine = cell->diameter() / std::sqrt(dim) >= 0.99 * particles_between * std::pow(room, 1.0 / dim);
    return fine ? 2 : 1;
  }

  template <int dim>
  void VolumeCoupling<dim>::enter_points(AbsorberCarriers &all)
  {
    // An average reaches two knots to either side; those of averages hardly reach further.
    const double                                 reach     = own.overlap.width + 3 * own.spacing;
    const double                                 thickness = dim == 2 ? solid.options().thickness : 1.0;
    const auto                                  &fe        = solid.dofs().get_fe();
    const dealii::QGauss<dim>                    points(points_per_axis());
    dealii::FEValues<dim>                        values(solid.mapping(), fe, points,
                                                        dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    std::vector<double>                          masses;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_indices(indices);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto     x = values.quadrature_point(q);
            const Vector3d place(x[0], x[1], dim == 3 ? x[dim - 1] : 0.0);
            const double   d = own.overlap.distance(place);
            if (d <= own.overlap.width || d >= reach)
              continue;
            fem::PlaceInElement<dim> in_element{cell, {}, {}, {}};
            in_element.nodes.resize(fe.n_dofs_per_cell() / dim);
            in_element.weights.resize(in_element.nodes.size());
            for (unsigned int i = 0; i < indices.size(); ++i)
              {
                const auto [component, node]      = fe.system_to_component_index(i);
                in_element.nodes[node][component] = indices[i];
                in_element.weights[node]          = values.shape_value(i, q);
              }
            node_map.enter(in_element);
            all.points.push_back(place);
            masses.push_back(thickness * values.JxW(q) * motion.density(cell->material_id()));
          }
      }
    all.point_mass = Eigen::Map<Eigen::VectorXd>(masses.data(), static_cast<Index>(masses.size()));
    all.weights    = weights_of(node_map.take(), masses.size(), node_map.nodes().size());
  }

  template <int dim>
  CarrierRows VolumeCoupling<dim>::absorb(const CorrectedRows &before,
                                          CorrectedRows       &now,
                                          const CarrierRows   &nodes_before,
                                          const double         time)
  {
    const CarrierChanges change = absorber->changes(0.5 * (before + now), 0.5 * (nodes_before + velocity), time);
    now += change.particles;
    velocity += change.nodes;
    impulse_absorber += node_mass.cwiseProduct(change.nodes) / ratio;
    return change.particles;
  }

  template <int dim>
  void VolumeCoupling<dim>::absorb_spins(dem::StepCorrection &correction, const std::size_t first, const double time)
  {
    constexpr std::size_t      spin = 3;
    const Eigen::OuterStride<> stride(axes);
    const CorrectedRows        before(const_cast<double *>(&correction.before[axes * first + spin]), inertia.rows(), 3,
                                      stride);
    CorrectedRows              now(&correction.velocity[axes * first + spin], inertia.rows(), 3, stride);
    const CarrierRows          change = spin_absorber->changes(0.5 * (before + now), CarrierRows(0, 3), time).particles;
    now += change;
    const CarrierRows mean = (correction.half_before * before + correction.half_after * now) /
                             (correction.half_before + correction.half_after);
    exchanged.absorbed -= inertia.cwiseProduct(change).cwiseProduct(mean).sum();
  }

  template void        VolumeCoupling<2>::make_absorber();
  template double      VolumeCoupling<2>::longest_absorption() const;
  template CarrierRows VolumeCoupling<2>::absorb(const CorrectedRows &, CorrectedRows &, const CarrierRows &, double);
  template void        VolumeCoupling<2>::absorb_spins(dem::StepCorrection &, std::size_t, double);
  template void        VolumeCoupling<3>::make_absorber();
  template double      VolumeCoupling<3>::longest_absorption() const;
  template CarrierRows VolumeCoupling<3>::absorb(const CorrectedRows &, CorrectedRows &, const CarrierRows &, double);
  template void        VolumeCoupling<3>::absorb_spins(dem::StepCorrection &, std::size_t, double);
} // namespace coupling

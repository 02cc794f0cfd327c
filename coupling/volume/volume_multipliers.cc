// Multipliers of a handshake: impulses that keep particles and nodes together, with both momenta.

#include "coupling/volume/rigid_couple.h"
#include "coupling/volume/volume_coupling.h"

#include <Eigen/Geometry>

#include <cmath>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  template <int dim>
  void VolumeCoupling<dim>::tie(const double steps)
  {
    // A step that is the window but for rounding is the window.
    const double wanted = std::fabs(steps - 1) < 1e-9 ? 1.0 : steps;
    if (multipliers && std::fabs(wanted - ratio) <= 1e-9 * ratio)
      return;
    ratio = wanted;
    multipliers.emplace(weights_of(at_particles, overlapping, overlap_nodes), inverse_mass.topRows(overlapping),
                        ratio * inverse_node_mass.topRows(overlap_nodes),
                        own.compatibility == Compatibility::coarse ? parts : Eigen::VectorXd(), own.lumped);
  }

  template <int dim>
  std::size_t VolumeCoupling<dim>::corrected_in(const double kick)
  {
    // Kicks further apart than half the period of a wave turn it round; particles hardly carry any of four steps.
    constexpr int most_steps = 2;
    absorbs_now              = absorber && (steps_waited + 1 >= most_steps || waited + 2 * kick > longest_absorption());
    return absorbs_now ? watched.size() : overlapping;
  }

  template <int dim>
  void VolumeCoupling<dim>::constrain(CorrectedRows &now, CarrierRows &together)
  {
    const Index          shared = multipliers->nodes();
    const CarrierChanges change = multipliers->changes(now.topRows(together.rows()), velocity.topRows(shared));
    together += change.particles;
    now.topRows(together.rows()) += change.particles;
    velocity.topRows(shared) += change.nodes;
    impulse_together.topRows(shared) += node_mass.topRows(shared).cwiseProduct(change.nodes) / ratio;
  }

  template <int dim>
  void VolumeCoupling<dim>::keep_together(dem::StepCorrection &correction,
                                          const std::size_t    first,
                                          const CarrierRows   &nodes_before)
  {
    const auto rows   = static_cast<Index>(absorbs_now ? watched.size() : overlapping),
               shared = static_cast<Index>(overlapping);
    const double kick = correction.half_before + correction.half_after;
    waited += kick;
    ++steps_waited;
    const Eigen::OuterStride<> stride(axes);
    const CorrectedRows        before(const_cast<double *>(&correction.before[axes * first]), rows, 3, stride);
    CorrectedRows              now(&correction.velocity[axes * first], rows, 3, stride);
    CarrierRows                together = CarrierRows::Zero(shared, 3), absorbed;
    constrain(now, together);
    if (absorbs_now)
      {
        absorbed = absorb(before, now, nodes_before, waited);
        constrain(now, together);
        if (spin_absorber)
          absorb_spins(correction, first, waited);
        waited       = 0;
        steps_waited = 0;
      }
    for (Index k = 0; k < rows; ++k)
      {
        const Vector3d mean    = (correction.half_before * before.row(k) + correction.half_after * now.row(k)) / kick;
        Vector3d       impulse = Vector3d::Zero();
        if (absorbs_now)
          {
            impulse = mass.row(k).cwiseProduct(absorbed.row(k));
            exchanged.absorbed -= impulse.dot(mean);
          }
        if (k < shared)
          {
            const Vector3d tied = mass.row(k).cwiseProduct(together.row(k));
            exchanged.work_on_particles += tied.dot(mean);
            impulse += tied;
          }
        exchanged.to_particles += impulse;
        if (impulse.isZero(0))
          continue;
        turn_given += place_at_kick(static_cast<std::size_t>(k)).cross(impulse);
      }
  }

  template <int dim>
  Vector3d VolumeCoupling<dim>::place_at_kick(const std::size_t k) const
  {
    if (!far)
      return places[k];
    const dem::ParticleState p = specimen.particle(watched[k]); // has moved on by itself already
    return p.position - p.moved;
  }

  template <int dim>
  void VolumeCoupling<dim>::keep_turning()
  {
    const CarrierRows places_of_nodes = nodes_now(), given = impulse_together + impulse_absorber;
    Vector3d          lacking = -turn_given;
    for (Index k = 0; k < given.rows(); ++k)
      lacking -= Vector3d(places_of_nodes.row(k)).cross(Vector3d(given.row(k)));
    impulse_together += impulses_of_couple(lacking, places_of_nodes, node_mass, inverse_node_mass, dim);
  }

  template void        VolumeCoupling<2>::tie(double);
  template std::size_t VolumeCoupling<2>::corrected_in(double);
  template void        VolumeCoupling<2>::keep_together(dem::StepCorrection &, std::size_t, const CarrierRows &);
  template void        VolumeCoupling<2>::keep_turning();
  template void        VolumeCoupling<3>::tie(double);
  template std::size_t VolumeCoupling<3>::corrected_in(double);
  template void        VolumeCoupling<3>::keep_together(dem::StepCorrection &, std::size_t, const CarrierRows &);
  template void        VolumeCoupling<3>::keep_turning();
} // namespace coupling

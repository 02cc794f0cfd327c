// Even strain across the overlap of particles and a solid, in motion.
#include "dem/homogenisation/relaxed_stiffness.h"
#include "tests/coupling/volume_fixture.h"

#include <catch2/catch.hpp>

using namespace volume;

namespace
{
  /** Of all strains and turns at once [1/s]. */
  template <int dim>
  Eigen::Matrix3d gradient()
  {
    Eigen::Matrix3d g;
    g << 1.0, 0.4, 0.3, -0.2, -0.7, 0.5, 0.6, -0.1, 0.8;
    if (dim == 2)
      g.row(2) = g.col(2).transpose() = Eigen::RowVector3d::Zero();
    return 5 * g;
  }

  template <int dim>
  Eigen::Matrix3d stretch()
  {
    return Vector3d(1.0, -0.7, dim == 3 ? 0.8 : 0.0).asDiagonal();
  }

  Vector3d spin_of(const Eigen::Matrix3d &rate)
  {
    return 0.5 * Vector3d(rate(2, 1) - rate(1, 2), rate(0, 2) - rate(2, 0), rate(1, 0) - rate(0, 1));
  }

  /** Whether a place is as close as that to the surface of the bar [m]. */
  template <int dim>
  bool on_surface(const Vector3d &place, const double inset)
  {
    const double length = Bar<dim>::own_length + Bar<dim>::elements_along * Bar<dim>::element;
    bool         near   = place.x() < inset || place.x() > length - inset;
    for (int c = 1; c < dim; ++c)
      near = near || place[c] < inset || place[c] > Bar<dim>::across * spacing - inset;
    return near;
  }

  /** What lies on the surface moves, and turns, as all that moves evenly. */
  template <int dim>
  void hold_surface(Bar<dim> &bar, const Eigen::Matrix3d &rate)
  {
    dem::Grip             grip;
    std::vector<Vector3d> velocities;
    for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
      if (const Vector3d place = bar.particles.particle(i).position; on_surface<dim>(place, 0.75 * spacing))
        {
          grip.particles.push_back(i);
          velocities.push_back(rate * place);
        }
    grip.prescribed = {true, true, dim == 3, dim == 3, dim == 3, true};
    bar.particles.grips().set_velocities(bar.particles.grips().add(grip), velocities,
                                         std::vector<Vector3d>(velocities.size(), spin_of(rate)));
    std::vector<std::size_t> nodes;
    velocities.clear();
    for (std::size_t k = 0; k < bar.participant->carriers(); ++k)
      if (const Vector3d place = bar.participant->place(k); on_surface<dim>(place, 0.25 * spacing))
        {
          nodes.push_back(k);
          velocities.push_back(rate * place);
        }
    bar.participant->set_motion(bar.participant->prescribe(nodes, {true, true, dim == 3}), velocities);
  }

  /** The lattice half a spacing further back, one column longer. */
  template <int dim>
  dem::Packing on_faces()
  {
    dem::Packing lattice = Bar<dim>::packing();
    dem::Packing moved   = lattice;
    for (std::size_t i = 0; i < lattice.size(); ++i)
      {
        moved.centre[i].x() -= spacing / 2;
        if (const double end = Bar<dim>::own_length + Bar<dim>::overlap_width - spacing; lattice.centre[i].x() > end)
          {
            moved.centre.push_back(lattice.centre[i] + Vector3d(spacing / 2, 0, 0));
            moved.radius.push_back(lattice.radius[i]);
          }
      }
    return moved;
  }

  /** Of the lattice that bars are made of. */
  template <int dim>
  base::Stiffness stiffness_of_lattice(const double interaction_ratio)
  {
    const dem::Packing cell = dem::make_lattice(dim == 3 ? dem::Lattice::simple_cubic : dem::Lattice::square,
                                                spacing / 2, {6, 6, dim == 3 ? 6 : 1});
    dem::NetworkParameters links;
    links.dimension         = dim;
    links.interaction_ratio = interaction_ratio;
    links.thickness         = spacing;
    base::Stiffness D =
      dem::relaxed_stiffness(dem::make_network(cell, links, dem::elastic_links(modulus, 0.3))).stiffness;
    for (int i = 0; i < 6; ++i)
      if (D(i, i) == 0) // no strain of these tests
        D(i, i) = modulus;
    return D;
  }
  /**
   * Of particles and nodes from an even motion, over its largest velocity, after some steps. That part is measured which grows with the motion in
   * first order: bonds that turn strain in second order, and slower motions drown in the rounding of places.
   */
  template <int dim>
  double distance_from(const coupling::VolumeCouplingParameters &method,
                       const Eigen::Matrix3d                    &gradient,
                       BarOptions<dim>                           options)
  {
    const dem::Packing    packing = options.packing ? *options.packing : Bar<dim>::packing();
    std::vector<Vector3d> velocities, wanted;
    for (const auto &[scale, part] : {std::pair{1.0, 2.0 / 3}, {-1.0, -2.0 / 3}, {2.0, -1.0 / 12}, {-2.0, 1.0 / 12}})
      {
        const Eigen::Matrix3d rate = scale * gradient;
        options.hold               = [&rate](Bar<dim> &bar) { hold_surface(bar, rate); };
        Bar<dim> bar(method, options);
        bar.set_velocity([&rate](const Vector3d &place) -> Vector3d { return rate * place; }, spin_of(rate));
        bar.advance(50);
        std::size_t next        = 0;
        const auto  check_ratio = [&](const Vector3d &place, const Vector3d &velocity) {
          if (next == velocities.size())
            {
              velocities.push_back(Vector3d::Zero());
              wanted.push_back(gradient * place);
            }
          velocities[next++] += part * velocity;
        };
        for (std::size_t i = 0; i < packing.size(); ++i)
          check_ratio(packing.centre[i], bar.particles.particle(i).velocity);
        for (std::size_t k = 0; k < bar.participant->carriers(); ++k)
          check_ratio(bar.participant->place(k), bar.participant->velocity(k));
      }
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      {
        worst   = std::max(worst, (velocities[k] - wanted[k]).norm());
        largest = std::max(largest, wanted[k].norm());
      }
    return worst / largest;
  }
} // namespace

TEMPLATE_TEST_CASE_SIG("volume coupling: particles and nodes that strain evenly go on to, by every method that shares",
                       "[coupling][volume]",
                       ((int dim), dim),
                       2,
                       3)
{
  BarOptions<dim> shared, constrained;
  shared.stiffness = stiffness_of_lattice<dim>(shared.interaction_ratio);
  // Constrained particles pass it on where they are on the faces of elements, and have no bonds along these, which would bear half of a couple there.
  constrained.packing           = on_faces<dim>();
  constrained.interaction_ratio = 1.05;
  constrained.stiffness         = stiffness_of_lattice<dim>(constrained.interaction_ratio);
  for (const auto &[name, method] : methods())
    {
      INFO(name);
      const bool   shares = method.method == VolumeMethod::multipliers;
      const double error  = shares ? distance_from<dim>(method, gradient<dim>(), shared) :
                                     distance_from<dim>(method, stretch<dim>(), constrained);
      if (method.method == VolumeMethod::legacy) // stiff twice where both are
        CHECK(error > 1e-3);
      else
        CHECK(error <= 1e-10);
      if (method.method ==
          VolumeMethod::constrained) // off the faces too, what bonds bear in elements is taken off these
        CHECK(distance_from<dim>(method, gradient<dim>(), shared) <= 1e-10);
    }
}

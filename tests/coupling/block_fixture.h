#pragma once

#include "coupling/concurrent/concurrent_motion.h"
#include "dem/laws/parallel_bond.h"
#include "fem/materials/isotropic_elastic.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <memory>

/** A block of elements and balls, for tests of the surface coupling. */
namespace block
{
  using Eigen::Vector3d;

  constexpr double side = 0.1; ///< of the block [m]

  /** A block of the given number of elements along each side, its first corner in the origin. */
  template <int dim>
  struct Block
  {
    explicit Block(const unsigned int elements, const std::function<void(fem::Loads<dim> &)> &hold = {})
      : solid(fem::make_mesh<dim>(box<dim>(corner(), std::vector<unsigned int>(dim, elements)),
                                  fem::ElementFamily::hypercube,
                                  MPI_COMM_SELF),
              options())
    {
      solid.assign("0", fem::make_points(elastic(10e9, 0.2), fem::Plane::strain));
      fem::Loads<dim> loads;
      loads.may_move_freely = !hold;
      if (hold)
        hold(loads);
      solid.set_loads(loads);
      fem::ExplicitOptions explicitly;
      explicitly.density = {{"0", 2400}};
      motion             = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
      participant        = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
    }
    static dealii::Point<dim> corner()
    {
      dealii::Point<dim> p;
      for (int d = 0; d < dim; ++d)
        p[d] = side;
      return p;
    }
    static fem::SolidOptions options()
    {
      fem::SolidOptions o;
      o.large_displacement = true;
      return o;
    }
    Vector3d momentum() const
    {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 0; i < participant->carriers(); ++i)
        sum += participant->mass(i) * participant->velocity(i);
      return sum;
    }

    fem::Solid<dim>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<dim>>        motion;
    std::unique_ptr<coupling::SolidParticipant<dim>> participant;
  };

  inline dem::LinearContactParameters rough()
  {
    dem::LinearContactParameters law;
    law.effective_modulus    = 1e8;
    law.stiffness_ratio      = 2.5;
    law.friction_coefficient = 0.4;
    return law;
  }

  /** Its lower face is held. */
  inline void stands(fem::Loads<3> &loads)
  {
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back({"4", c, [](const dealii::Point<3> &, double) { return 0.0; }});
  }

  /** One ball. */
  inline dem::Specimen ball(const double    radius,
                            const Vector3d &centre,
                            const Vector3d &velocity,
                            const Vector3d &spin,
                            const double    step_factor = 0.2)
  {
    dem::Packing packing;
    packing.centre = {centre};
    packing.radius = {radius};
    auto p         = cluster::bonded(1.0);
    p.density      = 7800;
    p.step_factor  = step_factor;
    p.damping      = 0;
    dem::Specimen specimen(packing, p, rough());
    specimen.set_velocity(0, velocity, spin);
    return specimen;
  }

  inline Vector3d momentum(const dem::Specimen &specimen)
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      sum += specimen.particle(i).mass * specimen.particle(i).velocity;
    return sum;
  }

  /** A spinning ball on its way to an edge of a free block, which it leaves again. */
  struct BallOnBlock
  {
    Block<3>                      block;
    dem::Specimen                 specimen;
    coupling::ConcurrentMotion<3> both;

    /** @param elements along a side of the block */
    BallOnBlock(const unsigned int                         elements,
                const double                               step_factor,
                const coupling::SurfaceCouplingParameters &contact)
      : block(elements)
      , specimen(ball(0.02, {0.03, 0.062, 0.1205}, {2, -1, -5}, {40, 100, -60}, step_factor))
      , both(specimen, block.solid, *block.motion, *block.participant)
    {
      both.add_surface(contact);
    }

    const coupling::SurfaceCoupling<3> &surface() const { return *both.surfaces().front(); }
    const dem::Surface                 &facets() const { return specimen.surfaces().at(surface().surface()); }
    Vector3d                            total_momentum() const { return momentum(specimen) + block.momentum(); }
    Vector3d                            total_angular_momentum() const
    {
      const dem::ParticleState p = specimen.particle(0);
      return coupling::momentum_of(*block.participant).angular + p.position.cross(p.mass * p.velocity) +
             p.inertia * p.spin;
    }
    double energy() const
    {
      const dem::EnergyAccount e = specimen.energy();
      const auto               s = block.motion->energy();
      return e.kinetic + e.elastic + e.friction + e.released + s.kinetic + s.internal;
    }
  };
} // namespace block

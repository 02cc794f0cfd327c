#pragma once

#include "clusters.h"
#include "periodic_cell_fixture.h"
#include "shared_bodies.h"

#include <cstdint>
#include <memory>
#include <utility>

/** Specimens of which several ranks show or tell something, beside those of shared_bodies.h. */
namespace shown_bodies
{
  using namespace shared_bodies;
  using namespace weak_bonds;

  struct Case
  {
    const char  *name;
    Make         make;
    std::int64_t steps;
  };

  inline std::unique_ptr<Body> torn_from_plate()
  {
    auto p             = cluster::bonded(1.2);
    p.physics.contacts = true;
    dem::Specimen          specimen(cluster::cubic_lattice(10, 10, 10, 1e-3), p, parallel());
    dem::SurfaceParameters plate;
    plate.name        = "plate";
    plate.mesh        = dem::plate(Vector3d(-0.01, -0.01, -1e-3), Vector3d(0.05, 0, 0), Vector3d(0, 0.05, 0));
    plate.contact     = grains::rough();
    plate.glue.within = 1e-6;
    specimen.surfaces().add(plate);
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      specimen.set_velocity(i, Vector3d(0, 0, 20 * (i % 2 == 0 ? 1.0 : 0.1)), Vector3d::Zero());
    return std::make_unique<Free>(std::move(specimen));
  }

  inline std::unique_ptr<Body> small_cell()
  {
    auto p             = cluster::bonded(1.5);
    p.physics.periodic = true;
    dem::Specimen specimen(periodic_fixture::eight_spheres(), p, cluster::concrete());
    specimen.set_velocity_gradient(Eigen::Vector3d(30, -5, -5).asDiagonal());
    return std::make_unique<Free>(std::move(specimen));
  }
} // namespace shown_bodies

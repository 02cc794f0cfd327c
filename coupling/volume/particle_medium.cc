#include "coupling/volume/particle_medium.h"

#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/homogenisation/resisted_strains.h"
#include "dem/model/particles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace coupling
{
  namespace
  {
    /** An element of the plane needs no entry out of it, but a matrix must be positive. */
    void fill_out_of_plane(base::Stiffness &stiffness)
    {
      const double largest = stiffness.maxCoeff();
      for (const int c : {2, 3, 4})
        {
          stiffness.row(c).setZero();
          stiffness.col(c).setZero();
          stiffness(c, c) = largest;
        }
    }

    /** Of the plane what acts in it, the rest zero; under plane stress, what is left when nothing presses on it from outside. */
    base::Stiffness acting(const base::Stiffness &stiffness, const StressState &state)
    {
      if (state.dimension == 3)
        return stiffness;
      base::Stiffness D = stiffness;
      if (state.plane == fem::Plane::stress)
        D -= stiffness.col(2) * stiffness.row(2) / stiffness(2, 2);
      for (const int c : {2, 3, 4})
        {
          D.row(c).setZero();
          D.col(c).setZero();
        }
      return D;
    }
  } // namespace

  std::optional<ParticleMedium> medium_of_cell(const dem::Packing           &cell,
                                               const dem::NetworkParameters &links,
                                               const dem::LinkMaterials     &materials,
                                               const double                  density)
  {
    const dem::ElasticNetwork   network = dem::make_network(cell, links, materials);
    const dem::RelaxedStiffness found   = dem::relaxed_stiffness(network);
    if (!found.solver.converged || found.resisted < dem::strains_of(links.dimension))
      return std::nullopt;
    const dem::ParticleShape  shape{links.dimension, density, links.thickness};
    const std::vector<double> densities = materials.densities(density);
    ParticleMedium            medium;
    medium.stiffness = 0.5 * (found.stiffness + found.stiffness.transpose());
    if (links.dimension == 2)
      fill_out_of_plane(medium.stiffness);
    for (std::size_t i = 0; i < cell.size(); ++i)
      {
        const std::size_t of = cell.material.empty() ? 0 : static_cast<std::size_t>(cell.material[i]);
        medium.density += densities.at(of) * shape.volume(cell.radius[i]) / network.volume;
      }
    return medium;
  }

  Mismatch reflected_by_mismatch(const ParticleMedium  &medium,
                                 const base::Stiffness &solid,
                                 const double           density,
                                 const StressState     &state)
  {
    const base::Stiffness of_solid = acting(solid, state), of_particles = acting(medium.stiffness, state);
    const double          heavier  = density > 0 ? density / medium.density : 1.0;
    const auto            reflects = [&](const int entry) {
      if (!(of_particles(entry, entry) > 0))
        return 0.0; // out of the plane
      const double ratio = std::sqrt(of_solid(entry, entry) * heavier / of_particles(entry, entry));
      return std::pow((ratio - 1) / (ratio + 1), 2);
    };
    Mismatch worst;
    for (int c = 0; c < 3; ++c)
      {
        worst.compression = std::max(worst.compression, reflects(c));
        worst.shear       = std::max(worst.shear, reflects(3 + c));
      }
    return worst;
  }

  double difference_of_stiffness(const ParticleMedium &medium, const base::Stiffness &solid, const StressState &state)
  {
    const base::Stiffness of_particles = acting(medium.stiffness, state);
    return (acting(solid, state) - of_particles).norm() / of_particles.norm();
  }
} // namespace coupling

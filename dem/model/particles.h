#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/core/records.h"
#include "dem/model/cell.h"
#include "dem/model/packing.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /**
 * Particles as columns of records (record_size doubles each), in the order of a space-filling curve.
 *
 * Two extra particles past the end, one unit apart and at rest, carry the links that only pad a column to whole packs.
 */
  struct Particles
  {
    std::size_t count = 0;

    base::Column pose;   ///< x y z [m] | tau theta (3) | radius [m] | 0, at the start of the step to come
    base::Column motion; ///< displacement (3) [m] | rotation vector theta (3) | 0 0, of the last step
    base::Column
      velocity; ///< v (3) [m/s] | w (3) [rad/s] | 0 0, at half steps; in a periodic cell v is the fluctuation v - G x
    base::Column force; ///< F (3) [N] | T (3) [N m] | 0 0, of links, contacts and weight, at the last step's start
    base::Column
      pushed; ///< force (3) [N] | couple (3) [N m] | 0 0 from outside, where a force is to be added; empty: none
    base::Column inverse_mass; ///< 1/m (3) | 1/I (3) | 0 0; zero where motion is prescribed or not modelled
    base::Column reference;    ///< x y z at the start [m], three per particle
    base::Column mass;         ///< [kg]
    base::Column inertia;      ///< [kg m^2]

    Cell cell; ///< periodic, or none

    std::vector<std::int32_t> number;       ///< of each particle in the packing
    std::vector<std::int32_t> made_links;   ///< cohesive links at the start
    std::vector<std::int32_t> broken_links; ///< cohesive links deleted since
    std::vector<std::int32_t> material;     ///< number of each particle's material; empty: there is one
    std::vector<JointCut>     cuts;         ///< between particles by their numbers in the packing
    std::int32_t first_joint = 1; ///< number of the pair that links of the first joint are of, after those of materials
    std::vector<double>
      radii; ///< of each particle, or one of all [m], where poses of others have no memory here; else none
    std::vector<std::int32_t>
      body; ///< what each particle moves with: a rigid clump's number, alone or left; empty: all alone

    static constexpr std::int32_t alone = -1;
    static constexpr std::int32_t left  = -2; ///< to a partner, whose body its bonds and contacts are part of

    /** Number of the rigid clump that a particle is a pebble of, from 0; below 0: of none. */
    std::int32_t clump_of(const std::size_t i) const { return body.empty() ? alone : body[i]; }
    /** Whether two move with the same body, within which nothing touches. */
    bool in_one_body(const std::int32_t first, const std::int32_t second) const
    {
      return !body.empty() && body[static_cast<std::size_t>(first)] != alone &&
             body[static_cast<std::size_t>(first)] == body[static_cast<std::size_t>(second)];
    }

    /** The cut between two particles; nullptr: no joint lies between them. */
    const JointCut *cut_between(std::int32_t one, std::int32_t other) const;
    /** Number of the pair that a link between two is of: of their materials, or of the joint between them. */
    std::int32_t pair_of(std::int32_t one, std::int32_t other) const;

    const double *pose_of(const std::size_t i) const { return &pose[record_size * i]; }
    double        radius_of(const std::size_t i) const
    {
      return radii.empty() ? pose[record_size * i + 6] : radii[radii.size() == 1 ? 0 : i];
    }
    Eigen::Vector3d position_of(const std::size_t i) const { return Eigen::Vector3d(&pose[record_size * i]); }

    /** Keep radii apart from poses, as they are there now. @pre all poses are known */
    void keep_radii();

    std::size_t bytes() const;
    void        visit_state(base::StateVisitor &visitor);
  };

  /** Mass and inertia of one particle: sphere, or disc of the given thickness in two dimensions. */
  struct ParticleShape
  {
    int    dimension = 3;
    double density   = 0; ///< [kg/m^3]
    double thickness = 0; ///< [m], two dimensions only

    std::vector<double> densities = {}; ///< of each material [kg/m^3]; empty: all have the density above

    double volume(double radius) const;
    /** Density of a particle's material over the density above. */
    double denser(const Particles &particles, const std::size_t i) const
    {
      return densities.empty() || particles.material.empty() ?
               1.0 :
               densities[static_cast<std::size_t>(particles.material[i])] / density;
    }
    double mass(double radius) const { return density * volume(radius); } ///< at the density above
    /** (2/5) m r^2 of a sphere, (1/2) m r^2 of a disc. */
    double inertia(double radius) const;
    /** Cross-section of a link: pi r^2 of the smaller sphere, 2 r t of the smaller disc. */
    double link_area(double first_radius, double second_radius) const;
  };

  /** Particles at rest, renumbered along a Hilbert curve. @param rotations whether they can spin (else 1/I = 0) */
  Particles make_particles(const Packing &packing, const ParticleShape &shape, bool rotations);

  /** Order that sorts points along a Hilbert curve through their bounding box: result[k] is the k-th point's index. */
  std::vector<std::int32_t> hilbert_order(const std::vector<Eigen::Vector3d> &points);
} // namespace dem

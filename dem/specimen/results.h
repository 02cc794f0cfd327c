#pragma once

#include "base/mandel.h"
#include "dem/facets/glue_output.h"
#include "dem/measures/loads.h"
#include "dem/model/link_law.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

/** Results of a specimen, for code that only reads them. */
namespace dem
{
  /** One particle as it is now. */
  struct ParticleState
  {
    Eigen::Vector3d     position;       ///< [m]
    Eigen::Vector3d     moved;          ///< in the last step, with the cell: forces belong to where it came from [m]
    Eigen::Vector3d     velocity, spin; ///< half a step back [m/s, rad/s]; in a periodic cell about its motion
    double              radius;         ///< [m]
    double              mass, inertia;  ///< [kg, kg m^2]
    std::array<bool, 6> held;           ///< along x, y, z and about them: prescribed or not modelled
  };

  /** Where particles are and how they move, as an observer sees them. Order: the packing's. */
  struct ParticleKinematics
  {
    std::vector<Eigen::Vector3d> position, displacement, velocity, angular_velocity;
    std::vector<double>          radius;
    std::vector<double>          mass; ///< [kg]; of a specimen in motion only
    std::vector<std::int32_t>    held; ///< 1: some of its motion is prescribed by a grip
  };

  /** Particles with what their links do to them; tensors are row-major. */
  struct ParticleOutput : ParticleKinematics
  {
    std::vector<double>          damage; ///< mean damage of the links it was made with, broken ones count as 1 [-]
    std::vector<std::int32_t>    broken_links; ///< how many of its cohesive links are gone
    std::vector<double>          volume;       ///< the particle's share of the specimen's volume, voids included [m^3]
    std::vector<std::int32_t>    material;     ///< number of each particle's material; empty: there is one
    std::vector<Eigen::Matrix3d> stress;       ///< Love-Weber, symmetric part, over the particle's share of volume [Pa]
  };

  /** Links, contacts and broken links as an observer sees them. */
  struct LinkOutput
  {
    enum Kind : std::int32_t
    {
      cohesive = 0,
      contact  = 1,
      broken   = 2
    };
    std::vector<std::array<std::size_t, 2>> ends;          ///< particle numbers of the packing
    std::vector<std::int32_t>               kind;          ///< Kind
    std::vector<double>                     normal_force;  ///< [N], tension positive
    std::vector<double>                     shear_force;   ///< [N], magnitude
    std::vector<double>                     normal_stress; ///< [Pa]
    std::vector<double>                     shear_stress;  ///< [Pa], magnitude
    std::vector<double>                     normal_strain; ///< [-]
    std::vector<double>                     damage;        ///< omega [-]
    std::vector<double>
      strength_damage;              ///< lost part of the strength, (6.6) of Stransky (2018); broken and contacts: 1
    std::vector<double> dissipated; ///< by the link's damage so far [J]; zero where shear damages (then only summed up)
    std::vector<std::int32_t> pair; ///< number of the pair of materials of each; empty: there is one
    std::vector<LinkLoad>     load; ///< force and geometry at t_n; of a broken link its last geometry without force

    /** What the law of the bonds shows of what it remembers, in its own names; zero for contacts of another law and broken links. */
    std::vector<LinkQuantity>        quantities;
    std::vector<std::vector<double>> history; ///< one column per quantity

    GlueOutput glue; ///< not in the columns above
  };

  /** The periodic cell of a specimen. */
  struct CellState
  {
    Eigen::Matrix3d base;                  ///< H, columns are the base vectors, where the particles are now [m]
    Eigen::Matrix3d deformation;           ///< F since the start, where the particles are now
    Eigen::Matrix3d deformation_at_forces; ///< F at t_n of the last step, when forces and stress were found
    Eigen::Matrix3d stress; ///< Love-Weber at t_n over the whole cell; unsymmetric part: net couples [Pa]
    double          volume; ///< at t_n [m^3]
  };

  /** One particle on one surface, as an observer sees it, at t_n. */
  struct WallContact
  {
    std::size_t     particle, surface;
    Eigen::Vector3d place;   ///< [m]
    Eigen::Vector3d force;   ///< on the particle [N]
    double          overlap; ///< [m]
  };

  /** How much there is of what, at this moment. */
  struct Counts
  {
    std::size_t  particles = 0, links = 0 /* cohesive, alive */, contacts = 0, broken = 0;
    std::int64_t neighbour_searches = 0; ///< since the start: searches for contacts that motion could have made
    std::size_t  wall_contacts      = 0; ///< of particles with surfaces, at t_n
    double       deepest_overlap =
      0;                     ///< that there has been of unbonded particles, over the smaller radius: see DeepestOverlap
    double largest_turn = 0; ///< of a particle in a step, of those that were checked, every hundredth [rad]
  };
} // namespace dem

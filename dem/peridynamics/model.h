#pragma once

#include <limits>

/** Bond-based peridynamics on a uniform grid of nodes, with tractions as integrals over the boundary (doc/theory/peridynamics.md). */
namespace dem::peridynamics
{
  enum class Space
  {
    rod,
    plane_stress,
    plane_strain,
    space
  };

  /** How the force of a bond grows: with its stretch, or with its elongation (doc/theory/peridynamics.md, 1). */
  enum class BondModel
  {
    prototype, ///< f = c s
    general    ///< f = c (|y' - y| - |xi|)
  };

  enum class Kinematics
  {
    linear,   ///< bonds keep their directions
    nonlinear ///< stretch and direction of the deformed bond
  };

  /** How much of a node's volume counts at the edge of the horizon. */
  enum class Volumes
  {
    full,   ///< all of it within the horizon
    partial ///< clip((delta - r) / spacing + 1/2, 0, 1)
  };

  /** What of the continuum the grid is made to have by one factor on the bond constant. */
  enum class Calibration
  {
    none,
    axis, ///< Young's modulus along the axes of the grid
    bulk  ///< C11 + C12, the stiffness against equal strains
  };

  struct Horizon
  {
    double  ratio              = 3.015; ///< of the horizon to the spacing [-]
    Volumes volumes            = Volumes::full;
    bool    surface_correction = false; ///< bond factor 2 V0 / (V(x) + V(x')): Le, Bobaru (2018)
  };

  struct Material
  {
    double      young_modulus    = 0;                                       ///< [Pa]
    double      density          = 0;                                       ///< [kg/m^3]; needed by motion only
    double      critical_stretch = std::numeric_limits<double>::infinity(); ///< [-]; infinite: bonds never break
    BondModel   model            = BondModel::prototype;
    Calibration calibration      = Calibration::none;
  };

  constexpr int dimension_of(const Space space) { return space == Space::rod ? 1 : space == Space::space ? 3 : 2; }

  /** The only Poisson's ratio that pairwise forces give [-]: Silling (2000); 0 of a rod, which has none. */
  double poisson_ratio(Space space);

  /**
   * Bond constant: [N/m^6] of the prototype, [N/m^7] of the general model. Silling, Askari (2005); Yu et al. (2023).
   * @param section thickness of a plate [m], section of a rod [m^2]; ignored in space
   */
  double bond_constant(Space space, BondModel model, double young_modulus, double horizon, double section);

  /** Part of a node's volume that counts at a distance [-]. A node at the horizon to rounding lies within it. */
  double volume_part(Volumes volumes, double distance, double horizon, double spacing);

  /**
   * Stretch at which a bond breaks, from the energy of a crack [J/m^2], which is what the bonds across a plane hold at that stretch: Silling,
   * Askari (2005) in space, Ha, Bobaru (2010) in plane stress (doc/theory/peridynamics.md, 1).
   * @throws std::invalid_argument for a rod
   */
  double critical_stretch(Space space, BondModel model, double young_modulus, double horizon, double fracture_energy);
} // namespace dem::peridynamics

#pragma once

#include "coupling/sequential/averaging.h"
#include "coupling/sequential/mapping_law.h"

#include <vector>

namespace coupling
{
  /** How much of a mapping may be doubtful; shares of the points that have a history. Past a limit the transfer is refused. */
  struct TransferLimits
  {
    double empty         = 0;   ///< points without any particle
    double sparse        = 0.2; ///< averages of fewer particles than asked for
    double fully_damaged = 0.5; ///< omega at or past 1
    double imbalance     = 2.0; ///< unbalanced force over the forces at hand, before the equilibrium iteration
  };

  struct TransferOptions
  {
    AveragingOptions averaging;
    MappingLaw       law;
    TransferLimits   limits;
  };

  /** What one integration point was given. */
  struct MappedPoint
  {
    Eigen::Vector3d place;  ///< [m]
    double          volume; ///< its share of the solid [m^3]
    double          size;   ///< of its element [m]
    Average         average;
    MappedDamage    mapped;
    double          kappa_d, kappa_p; ///< as initialised
    double
      returned; ///< |stress of the point at zero strain - stress given| [Pa]: outside the yield surface it is returned to it
  };

  /** Nothing silent: how many points were in which way out of the ordinary (over all ranks). */
  struct TransferCount
  {
    std::size_t points        = 0; ///< that have a history to set
    std::size_t elastic       = 0; ///< that have none: nothing is given to them
    std::size_t empty         = 0; ///< no particle within reach: left virgin and free of stress
    std::size_t sparse        = 0; ///< fewer particles than asked for
    std::size_t boundary      = 0; ///< the average is one-sided, see Average::offset
    std::size_t averaged      = 0; ///< moving least squares that fell back to the average
    std::size_t damaged       = 0; ///< omega > 0
    std::size_t fully_damaged = 0; ///< omega at or past 1: taken as 1 - 1e-6
    std::size_t at_switch     = 0; ///< raw damage within a factor of two of the switch, where kappa_P jumps
    std::size_t returned      = 0; ///< stress given lies outside the yield surface
  };

  /** What is conserved of the mapped fields: integrals over the points against sums over the particles. */
  struct TransferIntegrals
  {
    double          volume_particles = 0, volume_points = 0;                                             ///< [m^3]
    Eigen::Matrix3d stress_particles = Eigen::Matrix3d::Zero(), stress_points = Eigen::Matrix3d::Zero(); ///< [Pa m^3]
    Eigen::Matrix3d damage_particles = Eigen::Matrix3d::Zero(), damage_points = Eigen::Matrix3d::Zero(); ///< [m^3]

    /** |means differ| over the larger root mean square of the two; 0: the same mean. */
    double stress_error() const;
    double damage_error() const;
  };

  struct TransferReport
  {
    std::vector<MappedPoint> points; ///< of this rank, in the order of Solid::visit_points()
    TransferCount            count;
    TransferIntegrals        integrals;
    double                   largest_return = 0; ///< [Pa]
  };

  /** How far from equilibrium a solid is. */
  struct Imbalance
  {
    double largest = 0; ///< force on a free displacement [N]
    double free    = 0; ///< root of the sum of squares of these [N]
    double at_hand = 0; ///< root of the sum of squares of |stress| volume^(2/3) of the points [N]

    /** Of the forces at hand; 0 where there are none. */
    double relative() const { return at_hand > 0 ? free / at_hand : 0; }
  };

  /** What the equilibrium iteration after a transfer did. */
  struct Equilibration
  {
    Imbalance    before, after;            ///< both relate to the forces at hand before
    unsigned int iterations           = 0; ///< of Newton
    unsigned int relaxed              = 0; ///< damped steps that it took; 0: Newton alone
    double       largest_displacement = 0; ///< it took [m]
    double       released             = 0; ///< work that the stresses gave off meanwhile [J]
    double       damped               = 0; ///< of it, what dampers dissipated [J]
  };
} // namespace coupling

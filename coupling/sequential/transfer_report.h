#pragma once

#include "coupling/sequential/averaging.h"
#include "coupling/sequential/cut_comparison.h"
#include "coupling/sequential/mapping_law.h"

#include <vector>

namespace coupling
{
  /** How much of a mapping may be doubtful. Past a limit the transfer is refused. */
  struct TransferLimits
  {
    // Shares of the points that have a history.
    double empty         = 0;   ///< points without any particle
    double sparse        = 0.2; ///< averages of fewer particles than required
    double fully_damaged = 0.5; ///< omega at or past 1
    double outside = 0.2; ///< points whose stress lies so far outside the yield surface that a tenth of it is lost

    // Differences of points and particles, over the larger of the stress there is and the tensile strength.
    double mean_stress = 0.25; ///< of the mean stress
    double cut_force   = 0.5;  ///< of the force over any cut; moments are only reported

    double imbalance = 2.0; ///< unbalanced force over the forces at hand, before the equilibrium iteration
  };

  struct TransferOptions
  {
    AveragingOptions averaging;
    MappingLaw       law;
    TransferLimits   limits;
    double           strength =
      0; ///< tensile, of the weakest material with a history [Pa]: errors of smaller stresses relate to it
  };

  /** What one integration point was given. */
  struct MappedPoint
  {
    Eigen::Vector3d place;  ///< [m]
    double          volume; ///< its share of the solid [m^3]
    double          size;   ///< of its element [m]
    Average         average;
    MappedDamage    mapped;
    /** As initialised: what drives the damage, and how far the point has hardened. */
    double damage_driving, hardening;
    double
      returned; ///< |stress of the point at zero strain - stress given| [Pa]: outside the yield surface it is returned to it
  };

  /** Nothing silent: how many points were in which way out of the ordinary (over all ranks). */
  struct TransferCount
  {
    std::size_t points        = 0; ///< that have a history to set
    std::size_t elastic       = 0; ///< that have none: nothing is given to them
    std::size_t empty         = 0; ///< no particle within reach: left virgin and free of stress
    std::size_t sparse        = 0; ///< fewer particles than required
    std::size_t boundary      = 0; ///< the average is one-sided, see Average::offset
    std::size_t averaged      = 0; ///< moving least squares that fell back to the average
    std::size_t damaged       = 0; ///< omega > 0
    std::size_t fully_damaged = 0; ///< omega at or past 1: taken as 1 - 1e-6
    std::size_t at_switch     = 0; ///< raw damage within a factor of two of the switch, where kappa_P jumps
    std::size_t returned      = 0; ///< stress given lies outside the yield surface
    std::size_t outside       = 0; ///< of these, so far that more than a tenth of it (or of the strength) is lost
  };

  /** What the mapping keeps of the particles' fields: integrals over the points against sums over the particles. */
  struct TransferIntegrals
  {
    double          volume_particles = 0, volume_points = 0;                                             ///< [m^3]
    Eigen::Matrix3d stress_particles = Eigen::Matrix3d::Zero(), stress_points = Eigen::Matrix3d::Zero(); ///< [Pa m^3]
    Eigen::Matrix3d damage_particles = Eigen::Matrix3d::Zero(), damage_points = Eigen::Matrix3d::Zero(); ///< [m^3]

    Eigen::Matrix3d mean_stress_of_particles() const, mean_stress_of_points() const; ///< [Pa]
    /** |mean stresses differ| over the largest of the two and the strength; 0: the same mean. */
    double stress_error(double strength) const;
    /** |mean damage tensors differ| over the larger of the two. */
    double damage_error() const;
  };

  struct TransferReport
  {
    std::vector<MappedPoint> points; ///< of this rank, in the order of Solid::visit_points()
    TransferCount            count;
    TransferIntegrals        integrals;
    CutComparison            cuts;               ///< on one rank only; empty on several
    double                   strength       = 0; ///< that errors of small stresses relate to [Pa]
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

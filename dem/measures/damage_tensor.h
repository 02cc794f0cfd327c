#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dem
{
  /** One cohesive link made at the start, deleted ones included: those count with damage 1 and their last direction. */
  struct LinkDamage
  {
    Eigen::Vector3d direction = {0, 0, 0}; ///< n, unit
    double          damage    = 0; ///< lost part of the strength, (6.6) of Stransky (2018): 1 - (1 - omega) kappa/eps_0
  };

  /**
   * Damage tensor Omega of links whose directions are taken as even over the sphere, the least-squares answer to n.Omega.n = damage
   * (mesoscale damage of Kuhl et al., 2001; Stransky, 2018, (6.7)-(6.13)):
   * in space   Omega = -3/(2N) sum(damage) 1 + 15/(2N) sum(damage n (x) n),  trace/3 = mean damage;
   * in a plane Omega = -1/N sum(damage) 1 + 4/N sum(damage n (x) n),         trace/2 = mean damage.
   *
   * Eigenvalues may fall below 0 and above 1, only their mean lies in between. Zero without links.
   *
   * @param dimension 3; 2: directions lie in the plane z = 0, and so does the answer
   */
  Eigen::Matrix3d damage_tensor_even(const std::vector<LinkDamage> &links, int dimension = 3);

  /**
   * Damage tensor by least squares over the directions there are: (sum n (x) n (x) n (x) n) : Omega = sum(damage n (x) n).
   *
   * Returns a tensor imposed as damage = n.Omega.n whatever the directions are.
   *
   * @return nothing where the directions do not determine it: fewer than 12 links (7 in a plane), or a reciprocal condition number of
   *         the fourth-order fabric below 0.02 (0.4 for even directions, 0.5 in a plane)
   */
  std::optional<Eigen::Matrix3d> damage_tensor_fitted(const std::vector<LinkDamage> &links, int dimension = 3);

  enum class DamageFit
  {
    even,  ///< damage_tensor_even() for all
    fitted ///< damage_tensor_fitted() where the directions allow it
  };

  struct ParticleDamage
  {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    std::size_t     links  = 0;     ///< made with the particle
    bool            fitted = false; ///< false: by the form for even directions
  };

  /**
   * Damage tensor of every particle over the links it was made with.
   * @param ends particle numbers of each link, below `particles`
   * @throws std::invalid_argument if the columns differ in length
   */
  std::vector<ParticleDamage> particle_damage(const std::vector<std::array<std::size_t, 2>> &ends,
                                              const std::vector<LinkDamage>                 &links,
                                              std::size_t                                    particles,
                                              DamageFit                                      fit,
                                              int                                            dimension = 3);

  /**
   * The tensor with the factor 12/(2N) instead of 15/(2N) that published continuations of Stransky (2018) were computed with:
   * Omega' = 0.8 Omega - 0.1 trace(Omega) 1 (doc/theory/damage-tensor.md, 3). Its mean is half the mean damage.
   */
  Eigen::Matrix3d with_published_factor(const Eigen::Matrix3d &damage_tensor);

  /** The way back: Omega = 1.25 Omega' + 0.25 trace(Omega') 1. */
  Eigen::Matrix3d from_published_factor(const Eigen::Matrix3d &published);
} // namespace dem

#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace coupling
{
  /**
   * From a damage tensor of links to the scalar damage and hardening of a material
   * (doc/theory/sequential-transfer.md, 3):
   *
   *   raw = (factor max(0, c1 Omega1 + c2 Omega2 + c3 Omega3))^exponent,  Omega1 >= Omega2 >= Omega3,
   *   raw < switch:  omega = 0,             kappa_P = hardening_start + hardening_slope raw,
   *   otherwise:     omega = min(1, raw),   kappa_P = 1 + kappa_D(omega).
   *
   * Found for concrete in uniaxial compression, and for nothing else; identify() finds other constants.
   */
  struct MappingLaw
  {
    std::array<double, 3> weights         = {{0.58, -0.10, 0.02}}; ///< c1, c2, c3 of the sorted eigenvalues
    double                factor          = 2.09;
    double                exponent        = 4.7;
    double                switch_damage   = 5e-4; ///< m
    double                hardening_start = 0.3;  ///< kappa_P of an undamaged point, below 1
    double hardening_slope  = 900;   ///< growth of kappa_P with raw damage; start + slope m must stay below 1
    bool   published_factor = false; ///< the tensor is taken with 12/(2N) instead of 15/(2N)

    /** @throws base::InputError naming the constant that breaks a rule */
    void validate() const;
  };

  /** Laws by name: "default", "legacy12" (the published computation: same results), "refit" (refitted to the published states). */
  struct NamedMappingLaw
  {
    std::string name, meaning;
    MappingLaw  law;
  };
  const std::vector<NamedMappingLaw> &mapping_laws();

  /** What a law makes of a tensor. */
  struct MappedDamage
  {
    double raw       = 0; ///< before the switch, may exceed 1
    double damage    = 0; ///< omega in [0, 1]
    double hardening = 0; ///< kappa_P of an undamaged point; else it follows from omega and element size
  };

  /** Eigenvalues in descending order, as the law takes them (with the published factor if it says so). */
  Eigen::Vector3d principal_damage(const Eigen::Matrix3d &damage_tensor, const MappingLaw &law);

  MappedDamage map_damage(const Eigen::Matrix3d &damage_tensor, const MappingLaw &law);
} // namespace coupling

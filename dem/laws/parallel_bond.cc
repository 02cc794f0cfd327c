#include "dem/laws/parallel_bond.h"

#include "dem/kernels/link_update.h"
#include "dem/laws/requirements.h"

#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /** Of the modulus: stresses below are rounding, and break nothing that has no strength. */
    constexpr double no_stress = 1e-12;

    constexpr Requirements require("parallel-bond");

    void check(const ParallelBondParameters &p)
    {
      require(p.effective_modulus > 0, "Effective modulus", p.effective_modulus, "must be above 0 Pa.");
      require(p.stiffness_ratio > 0, "Stiffness ratio", p.stiffness_ratio, "must be above 0.");
      require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
      require(p.bond_effective_modulus >= 0, "Bond effective modulus", p.bond_effective_modulus,
              "must not be negative; 0 stands for that of the contact.");
      require(p.bond_stiffness_ratio >= 0, "Bond stiffness ratio", p.bond_stiffness_ratio,
              "must not be negative; 0 stands for that of the contact.");
      require.strength("Tensile strength", p.tensile_strength);
      require.strength("Cohesion", p.cohesion);
      require(p.friction_angle >= 0 && p.friction_angle < 90, "Friction angle", p.friction_angle,
              "must lie in [0, 90) degrees.");
      require(p.radius_multiplier > 0, "Radius multiplier", p.radius_multiplier, "must be above 0.");
      require(p.moment_contribution >= 0 && p.moment_contribution <= 1, "Moment contribution", p.moment_contribution,
              "must lie in [0, 1].");
    }
  } // namespace

  ParallelBondConstants::ParallelBondConstants(const ParallelBondParameters &p, const int dimension)
  {
    check(p);
    normal                  = p.effective_modulus;
    shear                   = p.effective_modulus / p.stiffness_ratio;
    friction                = p.friction_coefficient;
    bond_normal             = p.bond_effective_modulus > 0 ? p.bond_effective_modulus : p.effective_modulus;
    bond_shear              = bond_normal / (p.bond_stiffness_ratio > 0 ? p.bond_stiffness_ratio : p.stiffness_ratio);
    tensile_strength        = std::max(p.tensile_strength, no_stress * bond_normal);
    cohesion                = std::max(p.cohesion, no_stress * bond_normal);
    tan_angle               = std::tan(p.friction_angle * pi / 180);
    radius_multiplier       = p.radius_multiplier;
    area_factor             = dimension == 3 ? p.radius_multiplier * p.radius_multiplier : p.radius_multiplier;
    const double of_section = dimension == 3 ? 1.0 / 4 : 1.0 / 3; // I / (A R^2)
    bending_modulus         = area_factor * of_section * bond_normal;
    twisting_modulus        = area_factor * 2 * of_section * bond_shear;
    rim_normal              = p.moment_contribution * bond_normal;
    rim_shear               = p.moment_contribution * bond_shear;
  }

  LinearContactConstants ParallelBondConstants::contact() const
  {
    return LinearContactConstants({normal, normal / shear, friction});
  }

  void ParallelBond::begin(const Constants &k, const NewLink &link, double *numbers)
  {
    const double reference = reference_length(link);
    numbers[broken]        = 0;
    numbers[installed]     = (link.distance - reference) / reference;
    // A bond to a face has one particle only.
    const double smaller = link.second_radius > 0 ? std::min(link.first_radius, link.second_radius) : link.first_radius;
    numbers[radius]      = k.radius_multiplier * smaller;
    numbers[twist]       = 0;
  }

  base::Matrix6 ParallelBond::tangent(const Constants        &k,
                                      const LinkStep         &step,
                                      const State<double, 3> &before,
                                      const State<double, 3> &after,
                                      const LinkTangent       kind)
  {
    Eigen::Vector3d trial = step.shear_increment;
    for (int c = 0; c < 3; ++c)
      trial[c] += before.shear[contact_shear][c];
    const double    strain = step.geometry.strain - std::min(after.number[installed], 0.0);
    base::Matrix6   all    = base::Matrix6::Zero();
    Eigen::Matrix3d force  = linear_contact_tangent(k.contact(), step.direction, strain, trial, kind);
    if (after.number[broken] < 0.5)
      {
        const LinkStiffnesses bond    = bond_stiffness(k, step.geometry, after);
        const Eigen::Matrix3d nn      = step.direction * step.direction.transpose();
        const Eigen::Matrix3d across  = Eigen::Matrix3d::Identity() - nn;
        force                         = force + bond.normal * nn + bond.shear * across;
        all.bottomRightCorner<3, 3>() = bond.twist * nn + bond.bending * across;
      }
    all.topLeftCorner<3, 3>() = force;
    return all;
  }

  ParallelBondParameters ParallelBondLaw::mean_of(const Material<ParallelBondParameters> &one,
                                                  const Material<ParallelBondParameters> &other)
  {
    const ParallelBondParameters &a = one.parameters, &b = other.parameters;
    const auto                    bond_modulus = [](const ParallelBondParameters &p) {
      return p.bond_effective_modulus > 0 ? p.bond_effective_modulus : p.effective_modulus;
    };
    const auto bond_ratio = [](const ParallelBondParameters &p) {
      return p.bond_stiffness_ratio > 0 ? p.bond_stiffness_ratio : p.stiffness_ratio;
    };
    ParallelBondParameters between;
    between.effective_modulus      = mean(a.effective_modulus, b.effective_modulus);
    between.stiffness_ratio        = mean(a.stiffness_ratio, b.stiffness_ratio);
    between.friction_coefficient   = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.bond_effective_modulus = mean(bond_modulus(a), bond_modulus(b));
    between.bond_stiffness_ratio   = mean(bond_ratio(a), bond_ratio(b));
    between.tensile_strength       = mean(a.tensile_strength, b.tensile_strength);
    between.cohesion               = mean(a.cohesion, b.cohesion);
    between.friction_angle         = mean(a.friction_angle, b.friction_angle);
    between.radius_multiplier      = mean(a.radius_multiplier, b.radius_multiplier);
    between.moment_contribution    = mean(a.moment_contribution, b.moment_contribution);
    return between;
  }

  std::shared_ptr<const LinkLaw> ParallelBondLaw::bonds(const std::vector<ParallelBondParameters> &pairs,
                                                        const Physics                             &physics,
                                                        const int                                  vector_dimension)
  {
    std::vector<ParallelBondConstants> constants;
    for (const ParallelBondParameters &p : pairs)
      {
        constants.emplace_back(p, physics.dimension);
        if (!physics.damage)
          constants.back().tensile_strength = constants.back().cohesion = std::numeric_limits<double>::infinity();
      }
    return std::make_shared<LinkLawOf<ParallelBond>>(std::move(constants), vector_dimension, physics.rotations);
  }

  std::shared_ptr<const LinkLaw> ParallelBondLaw::contacts(const std::vector<ParallelBondParameters> &pairs,
                                                           const Physics                             &physics,
                                                           const int                                  vector_dimension)
  {
    std::vector<LinearContactParameters> linear;
    for (const ParallelBondParameters &p : pairs)
      linear.push_back(p.contact());
    return LinearContactLaw::contacts(linear, physics, vector_dimension);
  }
} // namespace dem

#include "dem/laws/contact_bond.h"

#include "dem/kernels/link_update.h"
#include "dem/laws/requirements.h"

namespace dem
{
  namespace
  {
    /** Of the modulus: stresses below are rounding, and break nothing that has no strength. */
    constexpr double no_stress = 1e-12;

    constexpr Requirements require("contact-bond");
  } // namespace

  ContactBondConstants::ContactBondConstants(const ContactBondParameters &p)
  {
    require(p.effective_modulus > 0, "Effective modulus", p.effective_modulus, "must be above 0 Pa.");
    require(p.stiffness_ratio > 0, "Stiffness ratio", p.stiffness_ratio, "must be above 0.");
    require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
    require.strength("Tensile strength", p.tensile_strength);
    require.strength("Cohesion", p.cohesion);
    normal           = p.effective_modulus;
    shear            = p.effective_modulus / p.stiffness_ratio;
    friction         = p.friction_coefficient;
    tensile_strength = std::max(p.tensile_strength, no_stress * normal);
    cohesion         = std::max(p.cohesion, no_stress * normal);
  }

  LinearContactConstants ContactBondConstants::contact() const
  {
    return LinearContactConstants({normal, normal / shear, friction});
  }

  base::Matrix6 ContactBond::tangent(const Constants        &k,
                                     const LinkStep         &step,
                                     const State<double, 3> &before,
                                     const State<double, 3> &after,
                                     const LinkTangent       kind)
  {
    base::Matrix6 all = base::Matrix6::Zero();
    if (after.number[broken] < 0.5)
      {
        const Eigen::Matrix3d nn  = step.direction * step.direction.transpose();
        all.topLeftCorner<3, 3>() = k.normal * nn + k.shear * (Eigen::Matrix3d::Identity() - nn);
        return all;
      }
    Eigen::Vector3d trial = step.shear_increment;
    for (int c = 0; c < 3; ++c)
      trial[c] += before.shear[0][c];
    all.topLeftCorner<3, 3>() =
      linear_contact_tangent(k.contact(), step.direction, step.geometry.strain - after.number[installed], trial, kind);
    return all;
  }

  ContactBondParameters ContactBondLaw::mean_of(const Material<ContactBondParameters> &one,
                                                const Material<ContactBondParameters> &other)
  {
    const ContactBondParameters &a = one.parameters, &b = other.parameters;
    ContactBondParameters        between;
    between.effective_modulus    = mean(a.effective_modulus, b.effective_modulus);
    between.stiffness_ratio      = mean(a.stiffness_ratio, b.stiffness_ratio);
    between.friction_coefficient = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.tensile_strength     = mean(a.tensile_strength, b.tensile_strength);
    between.cohesion             = mean(a.cohesion, b.cohesion);
    return between;
  }

  std::shared_ptr<const LinkLaw> ContactBondLaw::bonds(const std::vector<ContactBondParameters> &pairs,
                                                       const Physics                            &physics,
                                                       const int                                 vector_dimension)
  {
    std::vector<ContactBondConstants> constants;
    for (const ContactBondParameters &p : pairs)
      {
        constants.emplace_back(p);
        if (!physics.damage)
          constants.back().tensile_strength = constants.back().cohesion = std::numeric_limits<double>::infinity();
      }
    return std::make_shared<LinkLawOf<ContactBond>>(std::move(constants), vector_dimension, physics.rotations);
  }

  std::shared_ptr<const LinkLaw> ContactBondLaw::contacts(const std::vector<ContactBondParameters> &pairs,
                                                          const Physics                            &physics,
                                                          const int                                 vector_dimension)
  {
    std::vector<LinearContactParameters> linear;
    for (const ContactBondParameters &p : pairs)
      linear.push_back(p.contact());
    return LinearContactLaw::contacts(linear, physics, vector_dimension);
  }
} // namespace dem

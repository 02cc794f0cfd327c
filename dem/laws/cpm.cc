#include "dem/laws/cpm.h"

#include "base/errors.h"
#include "dem/kernels/first_order_shear.h"
#include "dem/laws/cpm_extended_contact.h"
#include "dem/laws/cpm_links.h"
#include "dem/laws/requirements.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    constexpr Requirements require("CPM");

    void check(const CpmParameters &p)
    {
      require(p.normal_modulus > 0, "Normal modulus", p.normal_modulus, "must be above 0 Pa.");
      require(p.shear_ratio > 0, "Shear ratio", p.shear_ratio,
              "must be above 0. A link without shear stiffness is not modelled.");
      require(p.limit_elastic_strain > 0, "Limit elastic strain", p.limit_elastic_strain, "must be above 0.");
      require(p.relative_ductility > 0, "Relative ductility", p.relative_ductility, "must be above 0.");
      require(p.cohesion >= 0, "Cohesion", p.cohesion, "must not be negative.");
      require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
      require(p.shear_contribution >= 0, "Shear contribution", p.shear_contribution, "must not be negative.");
      require(p.residual_strength_limit > 0 && p.residual_strength_limit < 1, "Residual strength limit",
              p.residual_strength_limit, "must lie between 0 and 1.");
      require(p.damage_law == DamageLaw::exponential || p.relative_ductility > 1, "Relative ductility",
              p.relative_ductility,
              "must be above 1 for the linear damage law, whose stress reaches zero at the softening strain.");
    }

    /** The kappa at which the residual strength (1 - omega) kappa/eps_0 has fallen to the given part. */
    double kappa_of_residual_strength(const CpmParameters &p, const double residual)
    {
      const double onset = p.limit_elastic_strain, softening = p.softening_strain();
      return p.damage_law == DamageLaw::exponential ? onset - softening * std::log(residual) :
                                                      softening - residual * (softening - onset);
    }
  } // namespace

  CpmConstants::CpmConstants(const CpmParameters &p)
    : CpmNumbers{p.normal_modulus,
                 p.shear_modulus(),
                 p.limit_elastic_strain,
                 p.softening_strain(),
                 1.0 / p.softening_strain(),
                 p.cohesion,
                 p.friction_coefficient,
                 p.shear_contribution,
                 1.0 / (1.0 - 1.0 / p.relative_ductility),
                 0.0, // after the check
                 p.damage_law}
  {
    check(p);
    kappa_broken = kappa_of_residual_strength(p, p.residual_strength_limit);
  }

  double CpmConstants::kappa_at(const double omega) const
  {
    if (omega <= 0)
      return onset;
    if (law == DamageLaw::linear)
      return onset / (1.0 - omega * (1.0 - onset / softening));
    // Newton for ln of the residual: h(k) = ln(eps_0/k) - (k - eps_0)/eps_f - ln(1 - omega), convex and falling: converges from the
    // left without overshoot.
    const double target = std::log1p(-omega);
    double       kappa  = onset;
    for (int i = 0; i < 100; ++i)
      {
        const double h    = std::log(onset / kappa) - (kappa - onset) * inverse_softening - target;
        const double step = h / (1.0 / kappa + inverse_softening);
        kappa += step;
        if (std::abs(step) <= 1e-16 * kappa)
          break;
      }
    return kappa;
  }

  double CpmConstants::strength_damage(const double kappa, const double omega) const
  {
    return kappa > onset ? 1.0 - (1.0 - omega) * kappa / onset : 0.0;
  }

  double CpmConstants::dissipated_at(const double kappa, const double omega) const
  {
    if (kappa <= onset)
      return 0.0;
    double softened; // area under the softening branch from eps_0 to kappa
    if (law == DamageLaw::exponential)
      softened = -E * onset * softening * std::expm1((onset - kappa) * inverse_softening);
    else
      {
        const double reached = std::min(kappa, softening), remaining = (softening - reached) / (softening - onset);
        softened = 0.5 * E * onset * (reached - onset) * (1.0 + remaining);
      }
    return 0.5 * E * onset * onset + softened - 0.5 * (1.0 - omega) * E * kappa * kappa;
  }

  namespace
  {
    const char *name_of(const DamageLaw law) { return law == DamageLaw::exponential ? "exponential" : "linear"; }
    const char *name_of(const ShearKinematics k) { return k == ShearKinematics::exact ? "exact" : "first-order"; }

    bool first_order(const std::vector<CpmParameters> &pairs)
    {
      return pairs.front().shear_kinematics == ShearKinematics::first_order; // of all pairs, see mean_of()
    }

    /** What has been published with the first-order update, and is compiled. */
    void check_first_order(const std::vector<CpmParameters> &pairs, const Physics &physics)
    {
      const auto refuse = [](const std::string &why) {
        throw base::InputError("CPM/Shear kinematics = first-order: " + why +
                               " It is there only to compare with programs that shear links so. Use exact.");
      };
      if (physics.dimension != 3)
        refuse("not in the plane.");
      if (physics.periodic)
        refuse("not in a periodic cell.");
      if (!physics.rotations || !physics.damage || !physics.friction)
        refuse("not without Physics/Rotations, Damage and Friction.");
      for (const CpmParameters &p : pairs)
        if (p.shear_contribution > 0)
          refuse("not with a Shear contribution.");
        else if (p.options.any())
          refuse(
            "not with a Compression yield strain, a logarithmic Strength surface, a Damage time, a Plastic time or "
            "a Prestress.");
    }

    /** The options are part of a law that damages and slides. */
    bool extended(const std::vector<CpmParameters> &pairs, const Physics &physics, bool (CpmOptions::*has)() const)
    {
      if (!std::any_of(pairs.begin(), pairs.end(), [&](const CpmParameters &p) { return (p.options.*has)(); }))
        return false;
      if (!physics.damage || !physics.friction)
        throw base::InputError(
          "CPM: Compression yield strain, Strength surface = logarithmic, Damage time, Plastic time and Prestress are "
          "not without Physics/Damage and Friction. Switch both on, or leave the options out.");
      return true;
    }

    template <typename Variant>
    std::shared_ptr<const LinkLaw>
    law_of(const std::vector<CpmParameters> &pairs, const Physics &physics, const int vector_dimension)
    {
      return std::make_shared<LinkLawOf<Variant>>(std::vector<typename Variant::Constants>(pairs.begin(), pairs.end()),
                                                  vector_dimension, physics.rotations);
    }
  } // namespace

  namespace
  {
    CpmOptions mean_of_options(const CpmMaterial &one, const CpmMaterial &other)
    {
      const CpmOptions &a = one.parameters.options, &b = other.parameters.options;
      const auto        refuse = [&](const char *entry) {
        throw base::InputError(std::string(entry) + ": material " + one.name + " and material " + other.name +
                                      " differ in it, and links between them would have neither. Give both the same, or the "
                                             "two an interface.");
      };
      if (a.strength_surface != b.strength_surface)
        refuse("Strength surface");
      if (a.damage_overstress != b.damage_overstress)
        refuse("Damage overstress");
      if ((a.compression_yield_strain < 0) != (b.compression_yield_strain < 0)) // 0 is no number between the others
        refuse("Compression yield strain");
      CpmOptions between               = a;
      between.compression_yield_strain = mean(a.compression_yield_strain, b.compression_yield_strain);
      between.compression_hardening    = mean(a.compression_hardening, b.compression_hardening);
      between.logarithmic_speed        = mean(a.logarithmic_speed, b.logarithmic_speed);
      between.damage_time              = mean(a.damage_time, b.damage_time);
      between.damage_exponent          = mean(a.damage_exponent, b.damage_exponent);
      between.plastic_time             = mean(a.plastic_time, b.plastic_time);
      between.plastic_exponent         = mean(a.plastic_exponent, b.plastic_exponent);
      between.prestress                = mean(a.prestress, b.prestress);
      return between;
    }
  } // namespace

  CpmParameters mean_of(const CpmMaterial &one, const CpmMaterial &other)
  {
    const CpmParameters &a = one.parameters, &b = other.parameters;
    if (a.damage_law != b.damage_law)
      throw base::InputError("Damage law: material " + one.name + " has the " + name_of(a.damage_law) + " one, " +
                             other.name + " the " + name_of(b.damage_law) +
                             " one; links between them would have neither. Give both the same.");
    if (a.shear_kinematics != b.shear_kinematics)
      throw base::InputError("Shear kinematics: " + std::string(name_of(a.shear_kinematics)) + " of material " +
                             one.name + ", " + name_of(b.shear_kinematics) + " of " + other.name +
                             "; links between them would have neither. Give both the same.");
    CpmParameters between;
    between.normal_modulus          = mean(a.normal_modulus, b.normal_modulus);
    between.shear_ratio             = mean(a.shear_ratio, b.shear_ratio);
    between.limit_elastic_strain    = mean(a.limit_elastic_strain, b.limit_elastic_strain);
    between.relative_ductility      = mean(a.relative_ductility, b.relative_ductility);
    between.cohesion                = mean(a.cohesion, b.cohesion);
    between.friction_coefficient    = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.damage_law              = a.damage_law;
    between.shear_contribution      = mean(a.shear_contribution, b.shear_contribution);
    between.residual_strength_limit = mean(a.residual_strength_limit, b.residual_strength_limit);
    between.shear_kinematics        = a.shear_kinematics;
    between.options                 = mean_of_options(one, other);
    return between;
  }

  std::shared_ptr<const LinkLaw>
  CpmLaw::bonds(const std::vector<CpmParameters> &pairs, const Physics &physics, const int vector_dimension)
  {
    if (first_order(pairs))
      {
        check_first_order(pairs, physics);
        return law_of<FirstOrderShear<CpmBond<DamageDriver::normal, true>>>(pairs, physics, vector_dimension);
      }
    if (extended(pairs, physics, &CpmOptions::any))
      return law_of<CpmExtendedBond>(pairs, physics, vector_dimension);
    const bool shear_damages =
      std::any_of(pairs.begin(), pairs.end(), [](const CpmParameters &p) { return p.shear_contribution > 0; });
    const auto choose = [&](auto sliding) {
      if (!physics.damage)
        return law_of<CpmBond<DamageDriver::none, sliding>>(pairs, physics, vector_dimension);
      return shear_damages ?
               law_of<CpmBond<DamageDriver::normal_and_shear, sliding>>(pairs, physics, vector_dimension) :
               law_of<CpmBond<DamageDriver::normal, sliding>>(pairs, physics, vector_dimension);
    };
    return physics.friction ? choose(std::true_type{}) : choose(std::false_type{});
  }

  std::shared_ptr<const LinkLaw>
  CpmLaw::contacts(const std::vector<CpmParameters> &pairs, const Physics &physics, const int vector_dimension)
  {
    if (first_order(pairs))
      {
        check_first_order(pairs, physics);
        return law_of<FirstOrderShear<CpmContact<true>>>(pairs, physics, vector_dimension);
      }
    if (extended(pairs, physics, &CpmOptions::any_of_contacts))
      return law_of<CpmExtendedContact>(pairs, physics, vector_dimension);
    return physics.friction ? law_of<CpmContact<true>>(pairs, physics, vector_dimension) :
                              law_of<CpmContact<false>>(pairs, physics, vector_dimension);
  }
} // namespace dem

#include "dem/laws/cpm_extended_contact.h"
#include "dem/laws/requirements.h"

namespace dem
{
  namespace
  {
    constexpr Requirements require_option("CPM");

    void check(const CpmParameters &p)
    {
      const CpmOptions &o = p.options;
      require_option(o.compression_yield_strain <= 0, "Compression yield strain", o.compression_yield_strain,
                     "must be below 0, or 0 for no flow in compression.");
      require_option(o.compression_hardening >= 0 && o.compression_hardening < 1, "Compression hardening",
                     o.compression_hardening, "must lie between 0 (included) and 1.");
      require_option(o.logarithmic_speed > 0, "Logarithmic speed", o.logarithmic_speed, "must be above 0.");
      require_option(o.strength_surface == StrengthSurface::linear || p.cohesion > 0, "Cohesion", p.cohesion,
                     "must be above 0 Pa for the logarithmic Strength surface, which goes with it.");
      require_option(o.damage_time >= 0, "Damage time", o.damage_time, "must not be negative.");
      require_option(o.damage_exponent > 0, "Damage rate exponent", o.damage_exponent, "must be above 0.");
      require_option(o.plastic_time >= 0, "Plastic time", o.plastic_time, "must not be negative.");
      require_option(o.plastic_exponent > 0, "Plastic rate exponent", o.plastic_exponent, "must be above 0.");
      require_option(o.plastic_time == 0 || p.cohesion > 0, "Cohesion", p.cohesion,
                     "must be above 0 Pa with a Plastic time, whose overstress goes with it.");
      require_option(o.prestress <= 0, "Prestress", o.prestress, "must not be above 0 Pa: it is a pressure.");
      const double yield = p.normal_modulus * o.compression_yield_strain;
      require_option(yield == 0 || o.prestress >= yield || o.compression_hardening > 0, "Prestress", o.prestress,
                     "is more than links bear that flow without hardening in compression.");
    }

    /** The strain that makes the prestress: elastic, or past the yield strain on the hardening line. */
    double prestrain_of(const CpmParameters &p)
    {
      const double sigma = p.options.prestress, E = p.normal_modulus, yield = p.options.compression_yield_strain;
      if (yield == 0 || sigma >= E * yield)
        return sigma / E;
      return yield + (sigma - E * yield) / (E * p.options.compression_hardening);
    }
  } // namespace

  CpmExtendedConstants::CpmExtendedConstants(const CpmParameters &p)
    : CpmConstants(p)
    , CpmOptionNumbers{p.options.compression_yield_strain,
                       p.options.compression_hardening,
                       p.options.strength_surface == StrengthSurface::logarithmic ? p.options.logarithmic_speed : 0.0,
                       p.options.damage_time,
                       p.options.damage_exponent,
                       p.options.plastic_time,
                       p.options.plastic_exponent,
                       p.options.prestress,
                       0.0, // after the check
                       p.options.damage_overstress == DamageOverstress::undamaged ? 1.0 : 0.0}
  {
    check(p);
    prestrain = prestrain_of(p);
  }

  void CpmLaw::check(const CpmParameters &parameters) { CpmExtendedConstants{parameters}; }

  base::Matrix6 CpmExtendedBond::tangent(const Constants        &k,
                                         const LinkStep         &step,
                                         const State<double, 3> &before,
                                         const State<double, 3> &after,
                                         const LinkTangent       kind)
  {
    CpmUpdate u;
    u.normal_strain = elastic_strain(k, step.geometry.strain, after);
    u.closed_slope  = after.number[plastic] < before.number[plastic] ? k.hardening : 1.0;
    u.kappa         = after.number[kappa];
    u.damage        = after.number[damaged];
    for (int c = 0; c < 3; ++c)
      {
        u.trial_shear[c] = step.shear_increment[c] + before.shear[0][c];
        u.total_shear[c] = after.shear[1][c];
      }
    LinkTangent which =
      kind; // a link that flows while shear damages it does so at a smaller normal strain, not a larger one
    which.damages = kind.damages || after.number[kappa] > std::max(before.number[kappa], k.onset);
    return cpm_matrix(k, step.direction, u, which);
  }

  base::Matrix6 CpmExtendedContact::tangent(const Constants        &k,
                                            const LinkStep         &step,
                                            const State<double, 3> &before,
                                            const State<double, 3> &after,
                                            const LinkTangent       kind)
  {
    CpmUpdate u;
    u.normal_strain = step.geometry.strain - after.number[0];
    u.closed_slope  = after.number[0] < before.number[0] ? k.hardening : 1.0;
    u.damage        = 1;
    for (int c = 0; c < 3; ++c)
      u.trial_shear[c] = step.shear_increment[c] + before.shear[0][c];
    return cpm_matrix(k, step.direction, u, kind);
  }
} // namespace dem

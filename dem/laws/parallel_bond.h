#pragma once

#include "dem/laws/linear_contact.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct ParallelBondLaw;

  /** Constants of the linear parallel bond; Potyondy and Cundall, Int. J. Rock Mech. Min. Sci. 41 (2004) 1329. */
  struct ParallelBondParameters
  {
    using Law = ParallelBondLaw;

    double effective_modulus      = 0;   ///< E* of the linear contact [Pa]
    double stiffness_ratio        = 2.5; ///< kappa* of the linear contact [-]
    double friction_coefficient   = 0;   ///< mu of the linear contact [-]
    double bond_effective_modulus = 0;   ///< E* of the bond [Pa]; 0: that of the contact
    double bond_stiffness_ratio   = 0;   ///< kappa* of the bond [-]; 0: that of the contact
    double tensile_strength       = 0;   ///< sigma_c [Pa]
    double cohesion               = 0;   ///< c [Pa]
    double friction_angle         = 0;   ///< phi of the bond's shear strength [degrees]
    double radius_multiplier      = 1;   ///< lambda: radius of the bond over that of the smaller particle [-]
    double moment_contribution    = 1;   ///< beta: share of the moments in the stresses that break it [-]

    /** The linear contact in parallel, which stays when the bond is broken. */
    LinearContactParameters contact() const { return {effective_modulus, stiffness_ratio, friction_coefficient}; }
  };

  /** The same as an update takes them. */
  template <typename Number>
  struct ParallelBondNumbers : LinearContactNumbers<Number>
  {
    Number bond_normal, bond_shear; ///< E*, E*/kappa* of the bond [Pa]
    Number tensile_strength, cohesion, tan_angle;
    Number area_factor;     ///< of the bond's section over A: lambda^2, in the plane lambda
    Number bending_modulus; ///< E* I / (A R^2), A of the link: I is 1/4, in the plane 1/3 of the section times R^2 [Pa]
    Number twisting_modulus; ///< E*/kappa* J / (A R^2), J = 2 I [Pa]
    Number rim_normal;       ///< beta E* [Pa]
    Number rim_shear;        ///< beta E*/kappa* [Pa]
  };

  struct ParallelBondConstants : ParallelBondNumbers<double>
  {
    double radius_multiplier;

    /** @throws base::InputError naming the entry that is out of range */
    ParallelBondConstants(const ParallelBondParameters &parameters, int dimension);

    LinearContactConstants contact() const;
  };

  /**
   * Linear parallel bond (doc/theory/parallel-bond.md): a cemented disc (strip, in the plane) beside a linear contact. It resists opening, shear, bending
   * and twist elastically, and breaks at once when the stress at its rim reaches the tensile or the shear strength; then the linear
   * contact alone remains in its place until the particles part.
   *
   * The contact pushes where particles are nearer than they were made (or than the sum of radii, if that is nearer): a packing whose
   * particles overlap is without force.
   */
  struct ParallelBond : LinkLawDefaults
  {
    using Constants = ParallelBondConstants;

    static constexpr const char *name  = "parallel-bond";
    static constexpr bool        bonds = true, moment = true, breaks_in_place = true;
    static constexpr int         records = 2;

    /** Places of the history. */
    enum Numbers
    {
      broken,    ///< 1: the bond is gone
      installed, ///< strain of the distance at which it was made
      radius,    ///< of the bond [m]
      twist      ///< relative rotation about the link since then [rad]
    };
    enum Shears
    {
      bond_shear,
      contact_shear
    };

    static constexpr int  resting_shear  = contact_shear;
    static constexpr bool tells_elements = true;

    template <typename T, int m>
    using State = LinkState<T, m, 4, 2, 1>;

    static std::array<LinkQuantity, 7> history()
    {
      return {
        {{"broken", "-", "1: the bond is broken"},
         {"installed_strain", "-", "strain of the distance at which the bond was made"},
         {"bond_radius", "m", "radius of the bond"},
         {"twist", "rad", "relative rotation about the link since the bond was made", true},
         {"bond_shear", "-", "tangential displacement since the bond was made, over the reference length"},
         {"contact_shear", "-", "elastic tangential displacement of the linear contact, over the reference length"},
         {"bending", "rad", "relative rotation across the link since the bond was made", true}}};
    }

    static void put(const Constants &k, double *record)
    {
      const double all[] = {k.normal,           k.shear,      k.friction,  k.bond_normal, k.bond_shear,
                            k.tensile_strength, k.cohesion,   k.tan_angle, k.area_factor, k.bending_modulus,
                            k.twisting_modulus, k.rim_normal, k.rim_shear};
      std::copy(std::begin(all), std::end(all), record);
    }
    BRECCIA_KERNEL static ParallelBondNumbers<Pack> gathered(const Pack (&c)[2][pack_size], const Constants &)
    {
      ParallelBondNumbers<Pack> k;
      k.normal           = c[0][0];
      k.shear            = c[0][1];
      k.friction         = c[0][2];
      k.bond_normal      = c[0][3];
      k.bond_shear       = c[0][4];
      k.tensile_strength = c[0][5];
      k.cohesion         = c[0][6];
      k.tan_angle        = c[0][7];
      k.area_factor      = c[1][0];
      k.bending_modulus  = c[1][1];
      k.twisting_modulus = c[1][2];
      k.rim_normal       = c[1][3];
      k.rim_shear        = c[1][4];
      return k;
    }

    static double reference_length(const NewLink &link) { return link.first_radius + link.second_radius; }
    static void   begin(const Constants &k, const NewLink &link, double *numbers);

    /** Overlap over the reference length, negative while the contact pushes. */
    template <typename T, int m>
    BRECCIA_KERNEL static T overlap(const State<T, m> &state, const T &strain)
    {
      return strain - minimum(state.number[installed], T(0.0));
    }

    /** The contact pushes, or has not yet let go of the shear that it held. */
    template <typename T, int m>
    BRECCIA_KERNEL static Comparison<T> acts(const State<T, m> &state, const T &strain)
    {
      return overlap(state, strain) < T(0.0) || dot(state.shear[contact_shear], state.shear[contact_shear]) > T(0.0);
    }

    template <typename K, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      LinkForce<T, m> answer{T(0.0), {}, {}, T(0.0), Comparison<T>(false), Comparison<T>(false)};
      for (int c = 0; c < m; ++c)
        answer.shear[c] = T(0.0);
      if (any(acts(state, motion.strain)))
        answer = linear_contact_force(k, overlap(state, motion.strain), motion.area, motion.reference,
                                      motion.shear_increment, state.shear[contact_shear], work);

      state.number[twist]   = state.number[twist] + motion.twist_increment;
      const T    normal     = T(k.bond_normal) * (motion.strain - state.number[installed]); // mean stress of the bond
      const T    per_radian = state.number[radius] * motion.inverse_reference;              // strain at the rim
      const auto whole      = state.number[broken] < T(0.5);
      const auto breaks     = whole && reaches_strength(k, normal, per_radian, state);
      const auto holds      = whole && !breaks;
      if (any(breaks))
        work.released += select(breaks, energy_at_break(k, motion, per_radian, state), T(0.0));

      const T area    = select(holds, motion.area, T(0.0));
      const T section = area * (state.number[radius] * per_radian);
      answer.normal   = multiply_add(area * T(k.area_factor), normal, answer.normal);
      answer.shear    = multiply_add(area * T(k.area_factor * k.bond_shear), state.shear[bond_shear], answer.shear);
      answer.bending_moment  = (section * T(k.bending_modulus)) * state.bending[0];
      answer.twisting_moment = (section * T(k.twisting_modulus)) * state.number[twist];
      answer.event           = breaks || (!holds && motion.strain > T(0.0));
      state.number[broken]   = select(holds, T(0.0), T(1.0));
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &before, const S &after)
    {
      const bool breaks = any(after.number[broken] > before.number[broken]);
      return 1u << twist | (breaks ? 1u << broken : 0u);
    }

    /** With the contact where the link is closed; the bond alone where it is open. */
    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const bool            closed = link.strain < std::min(state.number[installed], 0.0);
      const LinkStiffnesses bond   = bond_stiffness(k, link, state);
      return {bond.normal + (closed ? k.normal : 0.0), bond.shear + (closed ? k.shear : 0.0), bond.bending, bond.twist};
    }
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      if (state.number[broken] < 0.5)
        return stiffness(k, link, state);
      const bool closed = link.strain < std::min(state.number[installed], 0.0);
      return {closed ? k.normal : 0.0, closed ? k.shear : 0.0, 0, 0};
    }
    template <typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &link, const S &state)
    {
      if (state.number[broken] < 0.5)
        return LinkPhase::whole;
      return link.strain > 0 ? LinkPhase::gone : LinkPhase::broken;
    }
    /** The state in which it broke shows the mode of breaking; tension comes first. */
    template <typename S>
    static std::vector<BrokenElement> broken_elements(const Constants &k, const LinkGeometry &link, const S &state)
    {
      if (state.number[broken] < 0.5)
        return {};
      const double normal  = k.bond_normal * (link.strain - state.number[installed]);
      const double bending = k.rim_normal * state.number[radius] / link.reference;
      const double left    = k.tensile_strength - normal;
      const bool   torn    = left <= 0 || bending * bending * dot(state.bending[0], state.bending[0]) >= left * left;
      return {{0, torn ? BreakMode::tension : BreakMode::shear}};
    }
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double overlap = std::min(link.strain - std::min(state.number[installed], 0.0), 0.0);
      const double contact =
        0.5 * link.area * link.reference *
        (k.normal * overlap * overlap + k.shear * dot(state.shear[contact_shear], state.shear[contact_shear]));
      if (state.number[broken] > 0.5)
        return contact;
      const LinkStiffnesses bond   = bond_stiffness(k, link, state);
      const double          strain = link.strain - state.number[installed];
      return contact + 0.5 * (link.area * link.reference *
                                (bond.normal * strain * strain +
                                 bond.shear * dot(state.shear[bond_shear], state.shear[bond_shear])) +
                              bond.bending * dot(state.bending[0], state.bending[0]) +
                              bond.twist * state.number[twist] * state.number[twist]);
    }
    template <typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &state)
    {
      return {state.number[broken], state.number[broken]};
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &state, const double, const double)
    {
      if (state.number[broken] > 0.5)
        return {std::numeric_limits<double>::infinity(), 0};
      const double normal  = k.bond_normal * (link.strain - state.number[installed]);
      const double rim     = state.number[radius] / link.reference; // strain per radian
      const double tension = normal + rim * k.rim_normal * std::sqrt(dot(state.bending[0], state.bending[0]));
      const double shear   = k.bond_shear * std::sqrt(dot(state.shear[bond_shear], state.shear[bond_shear])) +
                           rim * k.rim_shear * std::abs(state.number[twist]);
      const double limit = std::max(k.cohesion - normal * k.tan_angle, 0.0);
      return {std::max({tension / k.tensile_strength, shear / limit, 0.0}), 0};
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);

  private:
    template <typename S>
    static LinkStiffnesses bond_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double section = link.area * state.number[radius] * state.number[radius] / link.reference;
      return {k.area_factor * k.bond_normal, k.area_factor * k.bond_shear, section * k.bending_modulus,
              section * k.twisting_modulus};
    }

    /** Whether the stress at the rim, of opening and bending or of slip and twist, reaches a strength; compared squared, without roots. */
    template <typename K, typename T, typename S>
    BRECCIA_KERNEL static Comparison<T>
    reaches_strength(const K &k, const T &normal, const T &per_radian, const S &state)
    {
      const T bent        = T(k.rim_normal) * per_radian; // stress per radian
      const T bending2    = bent * bent * dot(state.bending[0], state.bending[0]);
      const T left        = T(k.tensile_strength) - normal; // for bending
      const T slip2       = T(k.bond_shear * k.bond_shear) * dot(state.shear[bond_shear], state.shear[bond_shear]);
      const T turned      = maximum(state.number[twist], T(0.0) - state.number[twist]);
      const T shear_limit = maximum(negative_multiply_add(normal, T(k.tan_angle), T(k.cohesion)), T(0.0));
      const T left_slip   = negative_multiply_add(T(k.rim_shear) * per_radian, turned, shear_limit);
      return left <= T(0.0) || bending2 >= left * left || left_slip <= T(0.0) || slip2 >= left_slip * left_slip;
    }

    /**
     * What a bond that breaks in this step sets free. What it carried at the start of the step has worked over half of it, what it would
     * carry at its end has not: so the account balances to second order in the step.
     */
    template <typename K, typename T, int m>
    BRECCIA_KERNEL static T
    energy_at_break(const K &k, const LinkMotion<T, m> &motion, const T &per_radian, const State<T, m> &state)
    {
      const auto product = [](const auto &now, const auto &increment) { return dot(now, now - increment); };
      const T opened = motion.strain - state.number[installed], before = motion.strain_before - state.number[installed];
      const T section = motion.area * (state.number[radius] * per_radian);
      return T(0.5) *
             (T(k.area_factor) * motion.area * motion.reference *
                (T(k.bond_normal) * opened * before +
                 T(k.bond_shear) * product(state.shear[bond_shear], motion.shear_increment)) +
              section * (T(k.bending_modulus) * product(state.bending[0], motion.bending_increment) +
                         T(k.twisting_modulus) * state.number[twist] * (state.number[twist] - motion.twist_increment)));
    }
  };

  /** Parallel bonds as a scene chooses them; contacts born later are linear. */
  struct ParallelBondLaw
  {
    using Parameters = ParallelBondParameters;

    static constexpr const char *name = "parallel-bond";
    static constexpr const char *meaning =
      "Linear parallel bond: force and moment up to a tensile or shear strength, beside a linear contact";
    static constexpr bool touches_only = false;

    /** Means of all constants, and of the angles of friction. */
    static ParallelBondParameters mean_of(const Material<ParallelBondParameters> &one,
                                          const Material<ParallelBondParameters> &other);
    static void check(const ParallelBondParameters &parameters) { ParallelBondConstants(parameters, 3); }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<ParallelBondParameters> &pairs, const Physics &physics, int vector_dimension);
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<ParallelBondParameters> &pairs, const Physics &physics, int vector_dimension);

    template <typename Number, typename Choice>
    static void describe(ParallelBondParameters &p, Number &&number, Choice &&)
    {
      constexpr double smallest  = std::numeric_limits<double>::min();
      constexpr double largest   = std::numeric_limits<double>::max();
      constexpr double unlimited = std::numeric_limits<double>::infinity(); // what nothing breaks
      number("Effective modulus", p.effective_modulus, "Pa",
             "E* of the linear contact: normal stiffness is A E* over the sum of radii", smallest, largest, true);
      number("Stiffness ratio", p.stiffness_ratio, "-", "k_n/k_s of the linear contact", smallest, largest, false);
      number("Friction coefficient", p.friction_coefficient, "-", "mu of the linear contact", 0.0, largest, false);
      number("Bond effective modulus", p.bond_effective_modulus, "Pa", "E* of the bond; 0: that of the contact", 0.0,
             largest, false);
      number("Bond stiffness ratio", p.bond_stiffness_ratio, "-", "k_n/k_s of the bond; 0: that of the contact", 0.0,
             largest, false);
      number("Tensile strength", p.tensile_strength, "Pa", "sigma_c, tension at the rim that breaks the bond", 0.0,
             unlimited, true);
      number("Cohesion", p.cohesion, "Pa", "c, shear stress at the rim that breaks the bond without normal stress", 0.0,
             unlimited, true);
      number("Friction angle", p.friction_angle, "degrees", "phi, growth of the bond's shear strength with compression",
             0.0, 89.9, false);
      number("Radius multiplier", p.radius_multiplier, "-",
             "lambda, radius of the bond over that of the smaller particle", smallest, largest, false);
      number("Moment contribution", p.moment_contribution, "-",
             "beta, share of bending and twist in the stresses that break the bond", 0.0, 1.0, false);
    }
  };
} // namespace dem

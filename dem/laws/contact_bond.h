#pragma once

#include "dem/laws/linear_contact.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct ContactBondLaw;

  /** Constants of the contact bond; Potyondy and Cundall, Int. J. Rock Mech. Min. Sci. 41 (2004) 1329. */
  struct ContactBondParameters
  {
    using Law = ContactBondLaw;

    double effective_modulus    = 0;   ///< E* [Pa]
    double stiffness_ratio      = 2.5; ///< kappa* [-]
    double friction_coefficient = 0;   ///< mu of the contact that is left when it has broken [-]
    double tensile_strength     = 0;   ///< T_F / A [Pa]
    double cohesion             = 0;   ///< S_F / A [Pa]

    /** What it is when broken. */
    LinearContactParameters contact() const { return {effective_modulus, stiffness_ratio, friction_coefficient}; }
  };

  /** The same as an update takes them. */
  template <typename Number>
  struct ContactBondNumbers : LinearContactNumbers<Number>
  {
    Number tensile_strength, cohesion; ///< [Pa]
  };

  struct ContactBondConstants : ContactBondNumbers<double>
  {
    /** @throws base::InputError naming the entry that is out of range */
    explicit ContactBondConstants(const ContactBondParameters &parameters);

    LinearContactConstants contact() const;
  };

  /**
   * Contact bond: a spot of glue. While it holds, the linear contact carries tension and does not slide; it resists no rotation. It
   * breaks when its force reaches the strength in tension or, below that, in shear; the linear contact that is left answers in the
   * same step (doc/theory/contact-bond.md).
   */
  struct ContactBond : LinkLawDefaults
  {
    using Constants = ContactBondConstants;

    static constexpr const char *name  = "contact-bond";
    static constexpr bool        bonds = true, moment = false, breaks_in_place = true;
    static constexpr int         records        = 1;
    static constexpr bool        tells_elements = true;

    /** Places of the history. */
    enum Numbers
    {
      broken,   ///< 0: it holds; 1: broken in tension, 2: in shear
      installed ///< strain of the distance at which it was made
    };

    template <typename T, int m>
    using State = LinkState<T, m, 2, 1, 0>;

    static std::array<LinkQuantity, 3> history()
    {
      return {{{"mode", "-", "0: the bond holds; 1: it broke in tension, 2: in shear", true},
               {"installed_strain", "-", "strain of the distance at which the bond was made"},
               {"elastic_shear", "-", "elastic tangential displacement over the reference length"}}};
    }
    static void put(const Constants &k, double *record)
    {
      const double all[] = {k.normal, k.shear, k.friction, k.tensile_strength, k.cohesion};
      std::copy(std::begin(all), std::end(all), record);
    }
    BRECCIA_KERNEL static ContactBondNumbers<Pack> gathered(const Pack (&c)[1][pack_size], const Constants &)
    {
      ContactBondNumbers<Pack> k;
      k.normal           = c[0][0];
      k.shear            = c[0][1];
      k.friction         = c[0][2];
      k.tensile_strength = c[0][3];
      k.cohesion         = c[0][4];
      return k;
    }

    static double reference_length(const NewLink &link) { return link.first_radius + link.second_radius; }
    static void   begin(const Constants &, const NewLink &link, double *numbers)
    {
      const double reference = reference_length(link);
      numbers[broken]        = 0;
      numbers[installed]     = (link.distance - reference) / reference;
    }

    template <typename K, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      const T         opened = motion.strain - state.number[installed];
      const T         normal = T(k.normal) * opened; // stress
      const Vec<T, m> trial  = state.shear[0];
      const T         trial2 = T(k.shear * k.shear) * dot(trial, trial);
      const auto      whole  = state.number[broken] < T(0.5);
      const auto      torn = whole && normal >= T(k.tensile_strength), sheared = trial2 >= T(k.cohesion * k.cohesion);
      const auto      breaks = torn || (whole && sheared), holds = whole && !breaks;

      LinkForce<T, m> answer{motion.area * normal, (motion.area * T(k.shear)) * trial, {}, T(0.0), Comparison<T>(false),
                             Comparison<T>(false)};
      if (any(!holds))
        {
          LinkWork<T>     slid;
          const Vec<T, m> before = trial - motion.shear_increment;
          const auto contact = linear_contact_force(k, opened, motion.area, motion.reference, motion.shear_increment,
                                                    state.shear[0], slid);
          const T    volume  = motion.area * motion.reference;
          work.friction += select(whole, T(0.0), slid.friction);
          // Forces of before and after have each worked over half the step; the rest of what was stored is set free.
          const T was         = opened - (motion.strain - motion.strain_before);
          const T pulled      = T(k.normal) * (was * was - minimum(opened, T(0.0)) * minimum(opened, T(0.0)) +
                                          (was + minimum(opened, T(0.0))) * (opened - was));
          const T sheared_off = T(k.shear) * dot(before + state.shear[0], trial - state.shear[0]);
          work.released += select(breaks, T(0.5) * volume * (pulled + sheared_off), T(0.0));
          answer.normal = select(holds, answer.normal, contact.normal);
          for (int c = 0; c < m; ++c)
            {
              answer.shear[c]   = select(holds, answer.shear[c], contact.shear[c]);
              state.shear[0][c] = select(holds, trial[c], state.shear[0][c]);
            }
          answer.slides        = contact.slides && !holds;
          state.number[broken] = select(breaks, select(torn, T(1.0), T(2.0)), state.number[broken]);
        }
      answer.event = breaks || (!holds && motion.strain > maximum(state.number[installed], T(0.0)));
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &before, const S &after)
    {
      return any(after.number[broken] > before.number[broken]) ? 1u << broken : 0u;
    }

    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &, const S &)
    {
      return {k.normal, k.shear, 0, 0};
    }
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const bool carries = state.number[broken] < 0.5 || link.strain < state.number[installed];
      return carries ? LinkStiffnesses{k.normal, k.shear, 0, 0} : LinkStiffnesses{};
    }
    /** A broken one waits in its place until the particles are apart, and further apart than it was made. */
    template <typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &link, const S &state)
    {
      if (state.number[broken] < 0.5)
        return LinkPhase::whole;
      return link.strain > std::max(state.number[installed], 0.0) ? LinkPhase::gone : LinkPhase::broken;
    }
    template <typename S>
    static std::vector<BrokenElement> broken_elements(const Constants &, const LinkGeometry &, const S &state)
    {
      if (state.number[broken] < 0.5)
        return {};
      return {{0, state.number[broken] < 1.5 ? BreakMode::tension : BreakMode::shear}};
    }
    /** 1/2 F_n^2/k_n + 1/2 F_s^2/k_s */
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double opened = link.strain - state.number[installed];
      const double normal = state.number[broken] < 0.5 ? opened : std::min(opened, 0.0);
      return 0.5 * link.area * link.reference *
             (k.normal * normal * normal + k.shear * dot(state.shear[0], state.shear[0]));
    }
    template <typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &state)
    {
      const double lost = state.number[broken] < 0.5 ? 0.0 : 1.0;
      return {lost, lost};
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &state, const double, const double)
    {
      if (state.number[broken] > 0.5)
        return {std::numeric_limits<double>::infinity(), 0};
      const double normal = k.normal * (link.strain - state.number[installed]);
      const double shear  = k.shear * std::sqrt(dot(state.shear[0], state.shear[0]));
      return {std::max({normal / k.tensile_strength, shear / k.cohesion, 0.0}), 0};
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);
  };

  /** Contact bonds as a scene chooses them; contacts born later are linear. */
  struct ContactBondLaw
  {
    using Parameters = ContactBondParameters;

    static constexpr const char *name = "contact-bond";
    static constexpr const char *meaning =
      "Contact bond: a linear contact that carries tension and does not slide until it breaks; no moment";
    static constexpr bool touches_only = false;

    /** Means of all constants, and of the angles of friction. */
    static ContactBondParameters mean_of(const Material<ContactBondParameters> &one,
                                         const Material<ContactBondParameters> &other);
    static void                  check(const ContactBondParameters &parameters) { ContactBondConstants{parameters}; }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<ContactBondParameters> &pairs, const Physics &physics, int vector_dimension);
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<ContactBondParameters> &pairs, const Physics &physics, int vector_dimension);

    template <typename Number, typename Choice>
    static void describe(ContactBondParameters &p, Number &&number, Choice &&)
    {
      constexpr double smallest  = std::numeric_limits<double>::min();
      constexpr double largest   = std::numeric_limits<double>::max();
      constexpr double unlimited = std::numeric_limits<double>::infinity(); // what nothing breaks
      number("Effective modulus", p.effective_modulus, "Pa", "E*: normal stiffness is A E* over the sum of radii",
             smallest, largest, true);
      number("Stiffness ratio", p.stiffness_ratio, "-", "k_n/k_s, normal over shear stiffness", smallest, largest,
             false);
      number("Friction coefficient", p.friction_coefficient, "-", "mu of the contact that a broken bond leaves", 0.0,
             largest, false);
      number("Tensile strength", p.tensile_strength, "Pa", "tensile force over A that breaks the bond", 0.0, unlimited,
             true);
      number("Cohesion", p.cohesion, "Pa", "shear force over A that breaks the bond, whatever the normal force", 0.0,
             unlimited, true);
    }
  };
} // namespace dem

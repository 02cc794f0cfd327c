#pragma once

#include "dem/laws/contact_defaults.h"
#include "dem/laws/restitution.h"
#include "dem/model/materials.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct HertzMindlinLaw;

  /** Constants of contacts between elastic spheres, of the material of both. */
  struct HertzMindlinParameters
  {
    using Law = HertzMindlinLaw;

    double young_modulus        = 0;   ///< E [Pa]
    double poisson_ratio        = 0.2; ///< nu [-]
    double friction_coefficient = 0;   ///< mu [-]
    double restitution          = 1;   ///< e, speed after a head-on impact over that before [-]
  };

  /** The same as an update takes them. */
  template <typename Number>
  struct HertzMindlinNumbers
  {
    Number normal, shear; ///< E* = E/(2 (1 - nu^2)), G* = E/(4 (2 - nu) (1 + nu)) [Pa]
    Number friction;      ///< mu [-]
    Number viscosity;     ///< gamma [-]: viscous force gamma sqrt(S_n m*) times the speed of approach
  };

  struct HertzMindlinConstants : HertzMindlinNumbers<double>
  {
    /** @throws base::InputError naming the entry that is out of range */
    explicit HertzMindlinConstants(const HertzMindlinParameters &parameters);
  };

  /**
   * Contacts of elastic spheres (doc/theory/hertz-mindlin.md): normal force of Hertz (1882), shear stiffness without slip of Mindlin
   * (J. Appl. Mech. 16, 1949), Coulomb friction, and a viscous part under which the restitution does not depend on the speed (Tsuji,
   * Tanaka and Ishida, Powder Technology 71, 1992; Antypov and Elliott, EPL 94, 2011):
   *
   *     a = sqrt(R* d),   F = 4/3 E* a d + gamma sqrt(2 E* a m*) d',   dF_s = 8 G* a ds,   |F_s| <= mu 4/3 E* a d
   *
   * with d the overlap. Where the contact shrinks, the shear force shrinks with its radius a (Thornton, Cummins and Cleary, Powder
   * Technology 233, 2013): otherwise a cycle of loading would gain energy. Discs are taken for spheres of their radius.
   */
  struct HertzMindlin : UndamagedContact
  {
    using Constants = HertzMindlinConstants;

    static constexpr const char *name    = "hertz-mindlin";
    static constexpr bool        viscous = true, stiffens = true;
    static constexpr int         records = 1;

    /** What the history's numbers are. */
    enum Remembered
    {
      effective_radius, ///< R* [m]
      effective_mass,   ///< m* [kg]
      viscous_force     ///< of the last step [N]
    };
    template <typename T, int m>
    using State = LinkState<T, m, 3, 1, 0>;

    static std::array<LinkQuantity, 4> history()
    {
      return {
        {{"effective_radius", "m", "R*, product of the radii over their sum; against a face the radius"},
         {"effective_mass", "kg", "m*, product of the masses over their sum; against a face the mass"},
         {"viscous_force", "N", "part of the normal force that depends on the speed of approach, pressure positive"},
         {"elastic_shear", "-", "elastic tangential displacement over the sum of radii"}}};
    }
    static void put(const Constants &k, double *record)
    {
      record[0] = k.normal, record[1] = k.shear, record[2] = k.friction, record[3] = k.viscosity;
    }
    BRECCIA_KERNEL static HertzMindlinNumbers<Pack> gathered(const Pack (&c)[1][pack_size], const Constants &)
    {
      return {c[0][0], c[0][1], c[0][2], c[0][3]};
    }

    static double reference_length(const NewLink &link) { return link.first_radius + link.second_radius; }
    static void   begin(const Constants &, const NewLink &link, double *numbers)
    {
      numbers[effective_radius] = link.on_face ?
                                    link.first_radius :
                                    link.first_radius * link.second_radius / (link.first_radius + link.second_radius);
      numbers[effective_mass]   = link.effective_mass;
      numbers[viscous_force]    = 0;
    }

    template <typename Numbers, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Numbers &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      const T deep   = motion.reference * maximum(T(0.0) - motion.strain, T(0.0));
      const T before = motion.reference * maximum(T(0.0) - motion.strain_before, T(0.0));
      const T radius = square_root(state.number[effective_radius] * deep);
      const T spring = T(4.0 / 3.0) * (T(k.normal) * (radius * deep));

      const T dashpot = square_root(T(2.0) * T(k.normal) * radius * state.number[effective_mass]);
      const T nearer  = motion.reference * (motion.strain_before - motion.strain);
      const T viscous = T(k.viscosity) * dashpot * (nearer * motion.per_second);
      work.viscous += T(0.5) * (state.number[viscous_force] + viscous) * nearer;
      state.number[viscous_force] = viscous;

      LinkForce<T, m> answer;
      answer.normal = T(0.0) - (spring + viscous);
      answer.event  = Comparison<T>(false);
      shear_force(k, motion, radius, square_root(state.number[effective_radius] * before), T(k.friction) * spring,
                  state.shear[0], answer, work);
      return answer;
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 1u << viscous_force;
    }
    static double damping_ratio(const Constants &k) { return 0.5 * k.viscosity; }

    /** Slope of the force across, 2 E* a, and along, 8 G* a, as moduli; zero where the two do not touch. */
    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double per_modulus = contact_radius(link, state) * link.reference / link.area;
      return {2 * k.normal * per_modulus, 8 * k.shear * per_modulus, 0, 0};
    }
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      return stiffness(k, link, state);
    }
    /** 8/15 E* a d^2 + 4 G* a s^2 */
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double overlap = link.reference * std::max(-link.strain, 0.0), a = contact_radius(link, state);
      return a * (8.0 / 15.0 * k.normal * overlap * overlap +
                  4 * k.shear * link.reference * link.reference * dot(state.shear[0], state.shear[0]));
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &state, const double, const double shear)
    {
      const double overlap = link.reference * std::max(-link.strain, 0.0);
      return friction_used(k.friction * 4.0 / 3.0 * k.normal * contact_radius(link, state) * overlap, shear);
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);

  private:
    /** a [m]; zero where the two do not touch. */
    template <typename S>
    static double contact_radius(const LinkGeometry &link, const S &state)
    {
      return std::sqrt(state.number[effective_radius] * link.reference * std::max(-link.strain, 0.0));
    }

    /**
     * Shear force by its elastic displacement, in which the step's increment is. @param radius a at the end of the step @param before at
     * its start [m] @param limit the largest force that friction bears [N]
     */
    template <typename Numbers, typename T, int m>
    BRECCIA_KERNEL static void shear_force(const Numbers          &k,
                                           const LinkMotion<T, m> &motion,
                                           const T                &radius,
                                           const T                &before,
                                           const T                &limit,
                                           Vec<T, m>              &shear,
                                           LinkForce<T, m>        &answer,
                                           LinkWork<T>            &work)
    {
      constexpr double smallest = std::numeric_limits<double>::min();
      const T          now = T(8.0) * T(k.shear) * radius, was = T(8.0) * T(k.shear) * before; // [N/m]
      // A contact that grows keeps its force, so its elastic displacement becomes less; one that shrinks keeps the displacement.
      const T         kept = select(before < radius, before / maximum(radius, T(smallest)), T(1.0));
      const Vec<T, m> old  = shear - motion.shear_increment;
      const Vec<T, m> trial =
        kept * old + (T(0.5) * (T(1.0) + kept)) * motion.shear_increment; // the mean stiffness meets the increment
      const T lost = T(0.5) * kept * maximum(now - was, was - now) * dot(old, old);

      const T force2 = (now * now) * (motion.reference * motion.reference) * dot(trial, trial);
      answer.slides  = force2 > limit * limit;
      const T size   = square_root(select(answer.slides, force2, T(1.0)));
      const T keep   = select(answer.slides, limit / size, T(1.0));
      shear          = select(radius > T(0.0), keep, T(0.0)) * trial;
      // Mean of the forces before and after the step times what slipped; of second order in the step.
      const T slid = T(0.5) * dot(was * old + now * shear, trial - shear);
      work.friction += motion.reference * motion.reference * (lost + maximum(slid, T(0.0)));
      answer.shear = (now * motion.reference) * shear;
    }
  };

  /** Contacts of elastic spheres as a scene chooses them. */
  struct HertzMindlinLaw
  {
    using Parameters = HertzMindlinParameters;

    static constexpr const char *name    = "hertz-mindlin";
    static constexpr const char *meaning = "Contacts of elastic spheres with Coulomb friction and a restitution that "
                                           "does not depend on the speed: no tension, no moment";
    static constexpr bool        touches_only = true;

    /** E* and G* as those of two elastic bodies are; means of restitution and friction angle. */
    static HertzMindlinParameters mean_of(const Material<HertzMindlinParameters> &one,
                                          const Material<HertzMindlinParameters> &other);
    static void                   check(const HertzMindlinParameters &parameters) { HertzMindlinConstants{parameters}; }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<HertzMindlinParameters> &pairs, const Physics &physics, int vector_dimension)
    {
      return contacts(pairs, physics, vector_dimension); // nothing bonds: links live where particles meet
    }
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<HertzMindlinParameters> &pairs, const Physics &physics, int vector_dimension);

    template <typename Number, typename Choice>
    static void describe(HertzMindlinParameters &p, Number &&number, Choice &&)
    {
      constexpr double largest = std::numeric_limits<double>::max();
      number("Young modulus", p.young_modulus, "Pa", "E of the spheres' material", std::numeric_limits<double>::min(),
             largest, true);
      number("Poisson ratio", p.poisson_ratio, "-", "nu of it", 0.0, 0.5, false);
      number("Friction coefficient", p.friction_coefficient, "-",
             "mu, shear force that sliding keeps over the normal one", 0.0, largest, false);
      number("Restitution", p.restitution, "-", restitution_meaning, smallest_restitution, 1.0, false);
    }
  };
} // namespace dem

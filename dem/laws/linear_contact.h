#pragma once

#include "dem/laws/contact_defaults.h"
#include "dem/laws/restitution.h"
#include "dem/model/materials.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct LinearContactLaw;

  /** How the normal force of a linear contact is found. */
  enum class NormalForce
  {
    absolute,   ///< from the overlap itself: no drift
    incremental ///< summed up from the changes of the overlap since the contact was made
  };

  /** Constants of linear contacts: stiffness by the deformability method, Coulomb friction. */
  struct LinearContactParameters
  {
    using Law = LinearContactLaw;

    double effective_modulus    = 0;   ///< E* [Pa]: k_n = A E* / (r_J + r_K)
    double stiffness_ratio      = 2.5; ///< kappa* = k_n/k_s [-]
    double friction_coefficient = 0;   ///< mu [-]

    NormalForce normal_force = NormalForce::absolute;
    double      restitution  = 1; ///< e, speed after a head-on impact over that before [-]
  };

  /** The same as an update takes them. */
  template <typename Number>
  struct LinearContactNumbers
  {
    Number normal, shear; ///< E*, E*/kappa* [Pa]
    Number friction;      ///< mu [-]
  };

  struct LinearContactConstants : LinearContactNumbers<double>
  {
    /** @throws base::InputError naming the entry that is out of range */
    explicit LinearContactConstants(const LinearContactParameters &parameters);
  };

  /**
   * Force of a linear contact with Coulomb friction (Cundall and Strack, Geotechnique 29, 1979): F_n = k_n g_s while the particles
   * overlap (g_s < 0), nothing otherwise; shear grows with the tangential displacement and is held at mu |F_n|. No moment, no tension.
   *
   * @param strain   overlap over the reference length, negative while touching
   * @param shear    in: elastic tangential displacement over the reference length, this step's included; out: after sliding
   * @param increment of this step in it
   * @param work     what sliding dissipates, with the mean of the shear forces before and after the step
   */
  template <typename Constants, typename T, int m>
  BRECCIA_KERNEL LinkForce<T, m> linear_contact_force(const Constants &k,
                                                      const T         &strain,
                                                      const T         &area,
                                                      const T         &reference,
                                                      const Vec<T, m> &increment,
                                                      Vec<T, m>       &shear,
                                                      LinkWork<T>     &work)
  {
    const auto      touches = strain < T(0.0);
    const T         normal  = select(touches, T(k.normal) * strain, T(0.0)); // stresses, until the area comes in
    const T         limit   = T(0.0) - T(k.friction) * normal;
    const Vec<T, m> trial   = shear;
    const T         trial2  = T(k.shear * k.shear) * dot(trial, trial);
    LinkForce<T, m> answer;
    answer.slides = trial2 > limit * limit;
    if (any(answer.slides))
      {
        const T size = square_root(select(answer.slides, trial2, T(1.0)));
        const T keep = select(answer.slides, limit / size, T(1.0));
        shear        = keep * trial;
        // Mean of the stresses before and after the step times what slipped; of second order in the step.
        const Vec<T, m> before = trial - increment;
        const T         done   = T(0.5 * k.shear) * dot(before + shear, trial - shear);
        work.friction += area * reference * maximum(done, T(0.0));
      }
    answer.normal = area * normal;
    answer.shear  = (area * T(k.shear)) * shear;
    answer.event  = Comparison<T>(false);
    return answer;
  }

  /**
   * Links of the linear contact law. While the particles are apart the force and the elastic shear are zero by the update itself (there is
   * no strength, everything slides and dissipates nothing), so a link may be there long before and after they touch.
   */
  struct LinearContact : UndamagedContact
  {
    using Constants = LinearContactConstants;

    static constexpr const char *name    = "linear";
    static constexpr int         records = 1;

    template <typename T, int m>
    using State = LinkState<T, m, 0, 1, 0>;

    static std::array<LinkQuantity, 1> history()
    {
      return {{{"elastic_shear", "-", "elastic tangential displacement over the reference length"}}};
    }
    static void put(const Constants &k, double *record)
    {
      record[0] = k.normal, record[1] = k.shear, record[2] = k.friction;
    }
    BRECCIA_KERNEL static LinearContactNumbers<Pack> gathered(const Pack (&c)[1][pack_size], const Constants &)
    {
      return {c[0][0], c[0][1], c[0][2]};
    }

    static double reference_length(const NewLink &link) { return link.first_radius + link.second_radius; }
    static void   begin(const Constants &, const NewLink &, double *) {}

    template <typename Numbers, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Numbers &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      return linear_contact_force(k, motion.strain, motion.area, motion.reference, motion.shear_increment,
                                  state.shear[0], work);
    }

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 0;
    }

    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &, const S &)
    {
      return {k.normal, k.shear, 0, 0};
    }
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &)
    {
      return link.strain < 0 ? LinkStiffnesses{k.normal, k.shear, 0, 0} : LinkStiffnesses{};
    }
    /** 1/2 F_n^2/k_n + 1/2 F_s^2/k_s */
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double overlap = std::min(link.strain, 0.0);
      return 0.5 * link.area * link.reference *
             (k.normal * overlap * overlap + k.shear * dot(state.shear[0], state.shear[0]));
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &, const S &, const double normal, const double shear)
    {
      return friction_used(-k.friction * normal, shear);
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);
  };

  /** Tangent of linear_contact_force(): d (force over area) / d (strain vector) [Pa]. @param trial elastic shear before it slides */
  Eigen::Matrix3d linear_contact_tangent(const LinearContactConstants &k,
                                         const Eigen::Vector3d        &direction,
                                         double                        strain,
                                         const Eigen::Vector3d        &trial,
                                         LinkTangent                   kind);

  /**
   * The same in the incremental form of Cundall and Strack (1979): F_n <- min(0, F_n + k_n d delta_n) while the particles overlap,
   * nothing and forgotten when they part. Of a step in which they meet, only the part in touch counts. It differs from the absolute
   * form where particles overlapped when the contact was made: that overlap is without force.
   */
  struct IncrementalContact : LinearContact
  {
    template <typename T, int m>
    using State = LinkState<T, m, 1, 1, 0>;

    static std::array<LinkQuantity, 2> history()
    {
      return {{{"elastic_normal", "-", "elastic approach over the reference length, zero or negative"},
               LinearContact::history()[0]}};
    }
    static void begin(const Constants &, const NewLink &, double *numbers) { numbers[0] = 0; }

    template <typename Numbers, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const Numbers &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      const T nearer  = minimum(motion.strain, T(0.0)) - minimum(motion.strain_before, T(0.0));
      state.number[0] = select(motion.strain < T(0.0), minimum(state.number[0] + nearer, T(0.0)), T(0.0));
      return linear_contact_force(k, state.number[0], motion.area, motion.reference, motion.shear_increment,
                                  state.shear[0], work);
    }
    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 1u;
    }
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      LinkGeometry elastic = link;
      elastic.strain       = state.number[0];
      return LinearContact::stored(k, elastic, state);
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);
  };

  struct DampedContactConstants : LinearContactConstants
  {
    double damping; ///< 2 zeta [-]: viscous force 2 zeta sqrt(k_n m*) times the speed of approach

    /** @throws base::InputError likewise */
    explicit DampedContactConstants(const LinearContactParameters &parameters);
  };

  /**
   * The same with a dashpot beside the normal spring, F_n = k_n g + 2 zeta sqrt(k_n m*) g' while the particles overlap: it may pull a
   * little just before they part. Friction is in proportion to the spring's force (doc/theory/linear-contact.md, 2).
   */
  struct DampedContact : LinearContact
  {
    using Constants = DampedContactConstants;

    static constexpr bool viscous = true;

    /** What the history's numbers are. */
    enum Remembered
    {
      effective_mass, ///< m* [kg]
      viscous_force   ///< of the last step [N]
    };
    template <typename T, int m>
    using State = LinkState<T, m, 2, 1, 0>;

    template <typename Number>
    struct Numbers : LinearContactNumbers<Number>
    {
      Number damping;
    };

    static std::array<LinkQuantity, 3> history()
    {
      return {
        {{"effective_mass", "kg", "m*, product of the masses over their sum; against a face the mass"},
         {"viscous_force", "N", "part of the normal force that depends on the speed of approach, pressure positive"},
         LinearContact::history()[0]}};
    }
    static void put(const Constants &k, double *record)
    {
      LinearContact::put(k, record);
      record[3] = k.damping;
    }
    BRECCIA_KERNEL static Numbers<Pack> gathered(const Pack (&c)[1][pack_size], const Constants &)
    {
      return {{c[0][0], c[0][1], c[0][2]}, c[0][3]};
    }
    static void begin(const Constants &, const NewLink &link, double *numbers)
    {
      numbers[effective_mass] = link.effective_mass;
      numbers[viscous_force]  = 0;
    }

    template <typename N, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const N &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      auto    answer  = linear_contact_force(k, motion.strain, motion.area, motion.reference, motion.shear_increment,
                                             state.shear[0], work);
      const T spring  = motion.area * T(k.normal) / motion.reference;
      const T nearer  = motion.reference * (motion.strain_before - motion.strain);
      const T dashpot = T(k.damping) * square_root(spring * state.number[effective_mass]);
      const T viscous = select(motion.strain < T(0.0), dashpot * (nearer * motion.per_second), T(0.0));
      work.viscous += T(0.5) * (state.number[viscous_force] + viscous) * nearer;
      state.number[viscous_force] = viscous;
      answer.normal               = answer.normal - viscous;
      return answer;
    }
    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return 1u << viscous_force;
    }
    static double        damping_ratio(const Constants &k) { return 0.5 * k.damping; }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &,
                                 const LinkTangent kind)
    {
      LinearContact::State<double, 3> shear;
      shear.shear[0] = before.shear[0];
      return LinearContact::tangent(k, step, shear, shear, kind);
    }
  };

  /** Linear contacts as a scene chooses them. */
  struct LinearContactLaw
  {
    using Parameters = LinearContactParameters;

    static constexpr const char *name         = "linear";
    static constexpr const char *meaning      = "Linear contact with Coulomb friction: no tension, no moment";
    static constexpr bool        touches_only = true;

    /** Means of modulus and stiffness ratio, and of the friction angle. @throws base::InputError if their normal forces differ in kind */
    static LinearContactParameters mean_of(const Material<LinearContactParameters> &one,
                                           const Material<LinearContactParameters> &other);
    static void check(const LinearContactParameters &parameters) { LinearContactConstants{parameters}; }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<LinearContactParameters> &pairs, const Physics &physics, int vector_dimension);
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<LinearContactParameters> &pairs, const Physics &physics, int vector_dimension);

    template <typename Number, typename Choice>
    static void describe(LinearContactParameters &p, Number &&number, Choice &&choice)
    {
      constexpr double smallest = std::numeric_limits<double>::min();
      constexpr double largest  = std::numeric_limits<double>::max();
      number("Effective modulus", p.effective_modulus, "Pa", "E*: normal stiffness is A E* over the sum of radii",
             smallest, largest, true);
      number("Stiffness ratio", p.stiffness_ratio, "-", "k_n/k_s, normal over shear stiffness", smallest, largest,
             false);
      number("Friction coefficient", p.friction_coefficient, "-",
             "mu, shear force that sliding keeps over the normal one", 0.0, largest, false);
      choice("Normal force", p.normal_force,
             {{"absolute", NormalForce::absolute}, {"incremental", NormalForce::incremental}},
             "absolute: from the overlap; incremental: summed up since they touched, overlaps at the start are without "
             "force");
      number("Restitution", p.restitution, "-", restitution_meaning, smallest_restitution, 1.0, false);
    }
  };
} // namespace dem

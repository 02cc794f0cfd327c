#pragma once

#include "dem/kernels/link_law_of.h"
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
  struct LinearContact
  {
    using Constants = LinearContactConstants;

    static constexpr const char *name  = "linear";
    static constexpr bool        bonds = false, moment = false, breaks_in_place = false, waits = true;
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
    template <typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &link, const S &)
    {
      return link.strain > 0 ? LinkPhase::apart : LinkPhase::broken;
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
    static double damage_dissipation(const Constants &, const LinkGeometry &, const S &)
    {
      return 0;
    }
    template <typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &)
    {
      return {1, 1};
    }
    template <typename S>
    static double damaging_strain(const Constants &, const S &)
    {
      return std::numeric_limits<double>::infinity();
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &, const S &, const double normal, const double shear)
    {
      const double strength = -k.friction * normal;
      return {0, shear == 0 ? 0.0 : strength > 0 ? shear / strength : std::numeric_limits<double>::infinity()};
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

  /** Linear contacts as a scene chooses them. */
  struct LinearContactLaw
  {
    using Parameters = LinearContactParameters;

    static constexpr const char *name    = "linear";
    static constexpr const char *meaning = "Linear contact with Coulomb friction: no tension, no moment";

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
    }
  };
} // namespace dem

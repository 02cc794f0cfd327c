#pragma once

#include "dem/core/exponential.h"
#include "dem/core/simd.h"
#include "dem/core/vector.h"
#include "dem/laws/cpm_options.h"
#include "dem/model/materials.h"

#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  /** Shape of the softening branch (doc/theory/cpm.md, 3). */
  enum class DamageLaw
  {
    exponential, ///< softening strain = decay length: the initial tangent of softening meets zero at eps_0 + eps_f
    linear       ///< softening strain = strain of zero stress
  };

  /** How the slip of a link follows from the motion of its ends (doc/theory/shear-kinematics.md). */
  enum class ShearKinematics
  {
    exact,      ///< of the contact point, without any error from rotation
    first_order ///< with the radii as arms and the first-order update in common use: only to compare with others
  };

  struct CpmLaw;

  /** Constants of one link material of the cohesive particle model; strains and ratios are pure numbers. */
  struct CpmParameters
  {
    using Law = CpmLaw;

    double normal_modulus       = 0; ///< E of the link [Pa]
    double shear_ratio          = 0; ///< G/E of the link
    double limit_elastic_strain = 0; ///< eps_0
    double relative_ductility   = 0; ///< eps_f / eps_0
    double cohesion             = 0; ///< c_0 [Pa]
    double friction_coefficient = 0; ///< tan(phi)

    DamageLaw       damage_law              = DamageLaw::exponential;
    double          shear_contribution      = 0;    ///< xi: weight of the shear strain in the equivalent strain
    double          residual_strength_limit = 1e-4; ///< a link in tension is deleted below this residual strength (3.5)
    ShearKinematics shear_kinematics        = ShearKinematics::exact;
    CpmOptions      options                 = {};

    double shear_modulus() const { return shear_ratio * normal_modulus; }
    double softening_strain() const { return relative_ductility * limit_elastic_strain; }
  };

  /** The numbers that an update takes from the material: of one link (double), or of eight side by side (Pack). */
  template <typename Number>
  struct CpmNumbers
  {
    Number    E, G, onset, softening, inverse_softening, cohesion, friction, shear_weight;
    Number    linear_factor; ///< 1 / (1 - eps_0/eps_f)
    Number    kappa_broken;  ///< kappa past which a link in tension is deleted
    DamageLaw law;

    /** Damage omega = g(kappa), (2.17) of Stransky (2018) or its linear counterpart; 0 up to the onset. */
    template <typename T>
    BRECCIA_BRANCH T damage_at(const T &kappa) const
    {
      const T reached = maximum(kappa, T(onset)); // at the onset both laws give exactly 0
      if (law == DamageLaw::exponential)
        return T(1.0) - (onset / reached) * exponential((onset - reached) * inverse_softening);
      return select(reached < T(softening), (T(1.0) - onset / reached) * linear_factor, T(1.0));
    }
  };

  /** Constants derived once from the parameters, so that no link pays for them. */
  class CpmConstants : public CpmNumbers<double>
  {
  public:
    /** @throws base::InputError for a value out of range, or a combination without meaning; the message names the entry. */
    explicit CpmConstants(const CpmParameters &parameters);

    /** Inverse of damage_at(): the kappa with g(kappa) = omega, for omega in [0, 1). */
    double kappa_at(double omega) const;

    /** Strength lost by a link, omega-hat = 1 - (1 - omega) kappa / eps_0, (6.6) of Stransky (2018); 0 before the onset. */
    double strength_damage(double kappa, double omega) const;

    /** Energy dissipated per link volume on the way to kappa in tension [J/m^3]: area under the envelope less what is stored. */
    double dissipated_at(double kappa, double omega) const;
  };

  /** History of one link: what it remembers from step to step. */
  template <typename T, int shear_components>
  struct CpmState
  {
    T                        kappa;         ///< largest equivalent strain so far
    T                        damage;        ///< omega = g(kappa)
    Vec<T, shear_components> elastic_shear; ///< eps_T - eps_T^p, the part of the shear strain that makes stress
  };

  /** What a link answers. */
  template <typename T, int shear_components>
  struct CpmResponse
  {
    T                        normal_stress; ///< [Pa]
    Vec<T, shear_components> shear_stress;  ///< [Pa]
    T                        plastic_work; ///< sigma_T after the return times the plastic strain of this update [J/m^3]
    Comparison<T>            slides;       ///< whether the shear stress was returned to the strength
  };

  /**
 * The cohesive particle model: damage in tension, cohesion and friction in shear; Stransky (2018), (2.13)-(2.19).
 *
 * One update takes the total normal strain, the state with the elastic shear strain already advanced by this step's shear
 * increment, and the magnitude squared of the total shear strain (used only where shear damages); it returns the stresses and
 * leaves the new history in the state. Constants are CpmNumbers of one link, or of a pack. The normal part never depends on the shear stress, so the update is explicit and exact.
 *
 * @tparam damage   softens in tension; otherwise omega keeps the value it has (0 for a cohesive link, 1 for a contact)
 * @tparam sliding  shear stress limited by c_0 (1 - omega) - sigma_N tan(phi)
 */
  template <bool damage, bool sliding>
  struct Cpm
  {
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static CpmResponse<T, m>
    update(const Constants &k, const T &normal_strain, const T &total_shear_squared, CpmState<T, m> &state)
    {
      CpmResponse<T, m> response;
      response.plastic_work = T(0.0);
      response.slides       = Comparison<T>(false);
      const T opening       = maximum(normal_strain, T(0.0));
      if constexpr (damage)
        grow_damage(k, opening, total_shear_squared, state);
      response.normal_stress = k.E * negative_multiply_add(state.damage, opening, normal_strain);
      response.shear_stress  = T(k.G) * state.elastic_shear;
      if constexpr (sliding)
        slide(k, state, response);
      return response;
    }

    /**
   * Dissipated by the damage of an update where shear damages too, 1/2 E <eps_N>^2 d omega with the mean of <eps_N>^2 before and
   * after: of second order in the step (doc/theory/energy.md, 2); zero where only opening damages, which has a closed form [J/m^3].
   */
    template <typename Constants, typename T>
    BRECCIA_KERNEL static T damage_work(const Constants &k, const T &strain_before, const T &strain, const T &growth)
    {
      const T before = maximum(strain_before, T(0.0)), after = maximum(strain, T(0.0));
      return select(Comparison<T>(k.shear_weight > 0.0), T(0.25 * k.E) * (before * before + after * after) * growth,
                    T(0.0));
    }

    /** kappa and omega after an opening. @param total_shear_squared used only where shear damages */
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static void
    grow_damage(const Constants &k, const T &opening, const T &total_shear_squared, CpmState<T, m> &state)
    {
      T          equivalent    = opening;
      const auto shear_damages = k.shear_weight > 0.0; // of each link
      if (any(shear_damages))
        equivalent =
          square_root(multiply_add(T(k.shear_weight * k.shear_weight), total_shear_squared, opening * opening));
      const auto grows = equivalent > maximum(state.kappa, T(k.onset));
      state.kappa      = maximum(state.kappa, equivalent);
      if (any(grows))
        {
          const T kappa = state.kappa; // a copy: the address of the state itself would keep it in memory
          state.damage  = select(grows, k.damage_at(kappa), state.damage);
        }
    }

  private:
    template <typename Constants, typename T, int m>
    BRECCIA_KERNEL static void slide(const Constants &k, CpmState<T, m> &state, CpmResponse<T, m> &response)
    {
      const T    whole  = k.cohesion * (T(1.0) - state.damage);
      const T    limit  = maximum(negative_multiply_add(T(k.friction), response.normal_stress, whole), T(0.0));
      const T    trial2 = dot(response.shear_stress, response.shear_stress);
      const auto slides = trial2 > limit * limit;
      if (!any(slides))
        return;
      response.slides       = slides;
      const T trial         = square_root(select(slides, trial2, T(1.0)));
      const T keep          = select(slides, limit / trial, T(1.0));
      state.elastic_shear   = keep * state.elastic_shear;
      response.shear_stress = keep * response.shear_stress;
      response.plastic_work = select(slides, limit * (trial - limit) * T(1.0 / k.G), T(0.0));
    }
  };

  using CpmMaterial  = Material<CpmParameters>;
  using CpmMaterials = Materials<CpmParameters>;

  /**
   * Constants of a link between particles of two materials: arithmetic means of modulus, shear ratio, limit strain, ductility,
   * cohesion, shear contribution, residual strength limit, and of the friction ANGLE (doc/theory/links.md, 3). So G is mean
   * ratio times mean modulus, and eps_f mean eps_0 times mean ductility. Equal materials give their own constants, to the last bit.
   *
   * @throws base::InputError if their damage laws or shear kinematics differ; the message names both materials
   */
  CpmParameters mean_of(const CpmMaterial &one, const CpmMaterial &other);

  /** The cohesive particle model as a scene chooses it: its entries, declared once, and the laws that they make. */
  struct CpmLaw
  {
    using Parameters = CpmParameters;

    static constexpr const char *name    = "CPM";
    static constexpr const char *meaning = "Cohesive particle model: damage in tension, cohesion and friction in shear";
    static constexpr bool        touches_only = false;

    static CpmParameters mean_of(const CpmMaterial &one, const CpmMaterial &other) { return dem::mean_of(one, other); }
    /** @throws base::InputError naming the entry that is out of range */
    static void check(const CpmParameters &parameters);
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<CpmParameters> &pairs, const Physics &physics, int vector_dimension);
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<CpmParameters> &pairs, const Physics &physics, int vector_dimension);

    /**
   * Call `number(key, member, unit, meaning, lower, upper, required)` for every number and `choice(key, member, values,
   * meaning)` for every word of a block. A required entry has no default; the others keep the member's own.
   */
    template <typename Number, typename Choice>
    static void describe(CpmParameters &p, Number &&number, Choice &&choice)
    {
      constexpr double smallest = std::numeric_limits<double>::min();
      constexpr double largest  = std::numeric_limits<double>::max();
      number("Normal modulus", p.normal_modulus, "Pa", "E, stiffness of the link material along the link", smallest,
             largest, true);
      number("Shear ratio", p.shear_ratio, "-", "G/E, shear over normal modulus of the link material", smallest,
             largest, true);
      number("Limit elastic strain", p.limit_elastic_strain, "-", "eps_0, normal strain at which damage starts",
             smallest, largest, true);
      number("Relative ductility", p.relative_ductility, "-", "eps_f/eps_0, softening strain over limit elastic strain",
             smallest, largest, true);
      number("Cohesion", p.cohesion, "Pa", "c_0, shear strength of an undamaged link without normal stress", 0.0,
             largest, true);
      number("Friction coefficient", p.friction_coefficient, "-", "tan(phi), growth of shear strength with compression",
             0.0, largest, true);
      number("Shear contribution", p.shear_contribution, "-",
             "xi, weight of shear strain in the strain that drives damage; 0: none", 0.0, largest, false);
      number("Residual strength limit", p.residual_strength_limit, "-",
             "a link in tension is deleted when (1 - omega) kappa/eps_0 falls below this", smallest, 1.0, false);
      choice("Damage law", p.damage_law, {{"exponential", DamageLaw::exponential}, {"linear", DamageLaw::linear}},
             "shape of the softening branch");
      choice(
        "Shear kinematics", p.shear_kinematics,
        {{"exact", ShearKinematics::exact}, {"first-order", ShearKinematics::first_order}},
        "slip of a link: of the contact point, exact for any rotation; or by radii as arms and to first order, only "
        "to compare with programs that do so");
      CpmOptions::describe(p.options, number, choice);
    }
  };
} // namespace dem

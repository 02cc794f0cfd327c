#pragma once

#include "fem/materials/damage_plastic/damage_law.h"
#include "fem/materials/damage_plastic/return_mapping.h"
#include "fem/materials/dissipation.h"
#include "fem/materials/element_extent.h"
#include "fem/materials/initial_state.h"
#include "fem/materials/mixed_target.h"
#include "fem/materials/point_quantity.h"

namespace fem
{
  struct StressInvariants;

  /// History of a point of damage-plastic concrete. Strains [-], stresses [Pa].
  struct DamagePlasticState
  {
    base::Voigt plastic_strain = base::Voigt::Zero();
    double      kappa_p        = 0.0;
    double      kappa_d        = 0.0;
    double      damage         = 0.0;
    double      size           = 0.0;  ///< effective element size h [m], frozen at first damage; 0: not yet set
    double      localised_at   = -1.0; ///< kappa_D + omega f_t/E when h_ref was left; -1: not yet
    double      crack_opening  = 0.0;  ///< estimate h (kappa_D + omega <largest elastic strain>) [m]
    base::Voigt strain         = base::Voigt::Zero();
    base::Voigt stress         = base::Voigt::Zero();
  };

  /**
   * Damage-plastic concrete, Grassl and Jirasek (2006), IJSS 43, 7166.
   *
   * sigma = (1 - omega) D_e (eps - eps_p): plasticity in effective stress by backward Euler, damage driven by the plastic
   * volume change after the peak. A strain increment above `largest_increment`, or one whose return finds no state, is
   * divided into equal parts; the response says into how many.
   *
   * Departure: the tangent is the exact derivative of this algorithm, sub-steps included, and not a difference
   * quotient. It takes h as given in the step in which a point damages first, and at the compressive meridian, where
   * the model has a kink, one of the one-sided derivatives.
   */
  class DamagePlasticConcrete
  {
  public:
    using Parameters                     = DamagePlasticParameters;
    using State                          = DamagePlasticState;
    static constexpr const char *name    = "damage-plastic concrete";
    static constexpr const char *meaning = "Grassl and Jirasek (2006): plasticity and damage";

    template <typename Number>
    static void describe(Parameters &p, Number &&number)
    {
      Parameters::describe(p, std::forward<Number>(number));
    }

    static bool is_numerical(const std::string &key) { return Parameters::is_numerical(key); }

    template <typename Column>
    static void describe_state(State &s, Column &&column)
    {
      using Kind  = PointQuantity::Kind;
      using Role  = PointQuantity::Role;
      using Shown = PointQuantity::Shown;
      column(PointQuantity{"plastic_strain", "-", "", Kind::strain}, s.plastic_strain.data());
      column(PointQuantity{"kappa_P", "-", "hardening variable", Kind::number, Role::hardening}, &s.kappa_p);
      column(PointQuantity{"kappa_D", "-", "damage-driving variable", Kind::number, Role::damage_driving}, &s.kappa_d);
      column(PointQuantity{"damage", "-", "", Kind::number, Role::damage}, &s.damage);
      column(PointQuantity{"element_size", "m", "across the crack, with which the law regularises"}, &s.size);
      column(PointQuantity{"localised_at", "-", "damage-driving variable at which the size was fixed"},
             &s.localised_at);
      column(PointQuantity{"crack_opening", "m", "", Kind::number, Role::crack_opening}, &s.crack_opening);
      column(PointQuantity{"strain", "-", "", Kind::strain, Role::other, Shown::nowhere}, s.strain.data());
      column(PointQuantity{"stress", "Pa", "", Kind::stress, Role::other, Shown::nowhere}, s.stress.data());
    }

    /// @throws base::InputError on a parameter out of its range.
    explicit DamagePlasticConcrete(const Parameters &parameters);

    /// @throws MaterialFailure if no admissible state is found with the finest division;
    ///         base::InputError if the element is larger than E w_f / f_t.
    Response<State> evaluate(const base::Voigt   &strain,
                             const State         &committed,
                             const ElementExtent &element,
                             bool                 with_tangent = true) const;

    /// History that answers the given stress to zero strain (doc/theory/damage-plastic-concrete.md, 5).
    /// @throws base::InputError on damage outside [0, 1] or an undamaged hardening outside [0, 1).
    State initial_state(const InitialPointState &given, const ElementExtent &element) const;

    const base::Stiffness &elastic_stiffness() const noexcept { return stiffness; }

    /// The elastic part [J/m^3].
    double stored_energy(const base::Voigt &strain, const base::Voigt &stress, const State &state) const
    {
      const base::Voigt elastic = strain - state.plastic_strain;
      return 0.5 * stress.dot(elastic);
    }

    /// In one short piece of a path: by the mean stress and the mean elastic energy at its ends.
    Dissipation dissipation(const State &from, const State &to) const;

    UniaxialStrengths uniaxial_strengths() const { return {p.tensile_strength, p.compressive_strength}; }

    // Used by solve_mixed().
    double        strain_scale() const { return p.tensile_strength / p.young_modulus; }
    Increments    increments() const { return p.largest_increment > 0 ? Increments::followed : Increments::whole; }
    static double damage_of(const State &s) { return s.damage; }
    static bool   was_elastic(const State &from, const State &to) { return to.plastic_strain == from.plastic_strain; }
    static bool   leapt(const State &from, const State &to) { return to.localised_at != from.localised_at; }

    /// Widest element in which softening does not snap back [m]; infinite where the size is given.
    double largest_element_size() const
    {
      return p.element_size > 0 ? std::numeric_limits<double>::infinity() : law.largest_size();
    }
    /// @throws base::InputError for a wider element
    void require_size(double size) const;

    double averaging_length() const { return p.nonlocal_length; }
    double averaging_factor() const { return p.nonlocal_factor; }

    static double driving_of(const State &s) { return s.kappa_d; } ///< of the point itself

    const ReturnMapping &plasticity() const noexcept { return return_mapping; }

    const DamageLaw &damage_law() const noexcept { return law; }

    const Parameters &parameters() const noexcept { return p; }

    /// Where a strain drives by plasticity alone, which does not know of damage; derivatives are with that strain.
    struct March
    {
      base::Voigt elastic, plastic; // strains
      base::Voigt effective;        // stress [Pa]
      double      kappa_p, kappa_d;

      base::Stiffness             d_elastic = base::Stiffness::Zero(), d_effective = base::Stiffness::Zero();
      Eigen::Matrix<double, 1, 6> d_kappa_p = Eigen::Matrix<double, 1, 6>::Zero(),
                                  d_kappa_d = Eigen::Matrix<double, 1, 6>::Zero();
      double fraction                       = 0; // of the step done
      int    substeps                       = 1;

      double      driving() const { return kappa_d; }
      base::Voigt driving_by_strain() const { return d_kappa_d.transpose(); }
    };

    /// First half of evaluate(). @throws MaterialFailure
    March flow(const base::Voigt &strain, const State &committed, bool with_tangent = true) const;

    /// Second half: damage by a driving variable, kappa_D of the point itself or an average over its neighbours.
    struct Damaged
    {
      Response<State> response; ///< its tangent is (1 - omega) d effective stress / d strain alone
      base::Voigt     stress_by_driving = base::Voigt::Zero(); ///< [Pa], where the damage grows
    };

    /// @throws base::InputError as evaluate().
    Damaged damage(const March         &flown,
                   double               driving,
                   const base::Voigt   &strain,
                   const State         &committed,
                   const ElementExtent &element,
                   bool                 with_tangent = true) const;

  private:
    std::optional<March>
           march(const base::Voigt &strain, const State &committed, int substeps, bool with_tangent) const;
    bool   substep(March &m, const base::Voigt &increment, double fraction, bool with_tangent) const;
    void   accumulate_damage(March                             &m,
                             const PlasticTrial                &trial,
                             const PlasticReturn               &end,
                             const StressInvariants            &invariants,
                             bool                               with_tangent,
                             const Eigen::Matrix<double, 4, 6> &trial_by_strain) const;
    double effective_size(const State &state, const ElementExtent &element) const;

    Parameters      p;
    base::Stiffness stiffness, compliance;
    ReturnMapping   return_mapping;
    DamageLaw       law;
  };
}

#pragma once

#include "fem/materials/damage_plastic/damage_law.h"
#include "fem/materials/damage_plastic/return_mapping.h"
#include "fem/materials/element_extent.h"

namespace fem
{
  struct StressInvariants;

  /// History of a point of damage-plastic concrete. Strains [-], stresses [Pa].
  struct DamagePlasticState
  {
    Voigt  plastic_strain = Voigt::Zero();
    double kappa_p        = 0.0;
    double kappa_d        = 0.0;
    double damage         = 0.0;
    double size           = 0.0;  ///< effective element size h [m], frozen at first damage; 0: not yet set
    double localised_at   = -1.0; ///< kappa_D + omega f_t/E when h_ref was left; -1: not yet
    double crack_opening  = 0.0;  ///< estimate h (kappa_D + omega <largest elastic strain>) [m]
    Voigt  strain         = Voigt::Zero();
    Voigt  stress         = Voigt::Zero();
  };

  /// What a discrete model, or the user, knows about a point before the first step.
  struct InitialPointState
  {
    Voigt  stress  = Voigt::Zero(); ///< [Pa], at zero strain
    double damage  = 0.0;           ///< omega in [0, 1]; 1 is taken as 1 - 1e-6
    double kappa_p = 0.0;           ///< used where the point is undamaged; must then be below 1
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
    using Parameters                  = DamagePlasticParameters;
    using State                       = DamagePlasticState;
    static constexpr const char *name = "damage-plastic concrete";

    template <typename Entry>
    static void describe(Parameters &p, Entry &&entry)
    {
      Parameters::describe(p, std::forward<Entry>(entry));
    }

    template <typename Column> // column(name with unit, first value, number of values)
    static void describe_state(State &s, Column &&column)
    {
      column("plastic strain", s.plastic_strain.data(), 6);
      column("kappa_P", &s.kappa_p, 1);
      column("kappa_D", &s.kappa_d, 1);
      column("damage", &s.damage, 1);
      column("element size [m]", &s.size, 1);
      column("localised at", &s.localised_at, 1);
      column("crack opening [m]", &s.crack_opening, 1);
      column("old strain", s.strain.data(), 6);
      column("old stress [Pa]", s.stress.data(), 6);
    }

    /// @throws std::invalid_argument on a parameter out of its range.
    explicit DamagePlasticConcrete(const Parameters &parameters);

    /// @throws MaterialFailure if no admissible state is found with the finest division;
    ///         std::invalid_argument if the element is larger than E w_f / f_t.
    Response<State>
    evaluate(const Voigt &strain, const State &committed, const ElementExtent &element, bool with_tangent = true) const;

    /// History that answers the given stress to zero strain (doc/theory/damage-plastic-concrete.md, 5).
    /// @throws std::invalid_argument on damage outside [0, 1] or an undamaged kappa_P outside [0, 1).
    State initial_state(const InitialPointState &given, const ElementExtent &element) const;

    const Stiffness &elastic_stiffness() const noexcept { return stiffness; }

    const ReturnMapping &plasticity() const noexcept { return return_mapping; }

    const DamageLaw &damage_law() const noexcept { return law; }

    const Parameters &parameters() const noexcept { return p; }

    /// Where a strain leads by plasticity alone, which does not know of damage; derivatives are with that strain.
    struct March
    {
      Voigt  elastic, plastic; // strains
      Voigt  effective;        // stress [Pa]
      double kappa_p, kappa_d;

      Stiffness                   d_elastic = Stiffness::Zero(), d_effective = Stiffness::Zero();
      Eigen::Matrix<double, 1, 6> d_kappa_p = Eigen::Matrix<double, 1, 6>::Zero(),
                                  d_kappa_d = Eigen::Matrix<double, 1, 6>::Zero();
      double fraction                       = 0; // of the step done
      int    substeps                       = 1;
    };

    /// First half of evaluate(). @throws MaterialFailure
    March flow(const Voigt &strain, const State &committed, bool with_tangent = true) const;

    /// Second half: damage by a driving variable, kappa_D of the point itself or an average over its neighbours.
    struct Damaged
    {
      Response<State> response; ///< its tangent is (1 - omega) d effective stress / d strain alone
      Voigt           stress_by_driving = Voigt::Zero(); ///< [Pa], where the damage grows
    };

    /// @throws std::invalid_argument as evaluate().
    Damaged damage(const March         &flown,
                   double               driving,
                   const Voigt         &strain,
                   const State         &committed,
                   const ElementExtent &element,
                   bool                 with_tangent = true) const;

  private:
    std::optional<March> march(const Voigt &strain, const State &committed, int substeps, bool with_tangent) const;
    bool                 substep(March &m, const Voigt &increment, double fraction, bool with_tangent) const;
    void                 accumulate_damage(March                             &m,
                                           const PlasticTrial                &trial,
                                           const PlasticReturn               &end,
                                           const StressInvariants            &invariants,
                                           bool                               with_tangent,
                                           const Eigen::Matrix<double, 4, 6> &trial_by_strain) const;
    double               effective_size(const State &state, const ElementExtent &element) const;
    void                 require_size(double size) const;

    Parameters    p;
    Stiffness     stiffness, compliance;
    ReturnMapping return_mapping;
    DamageLaw     law;
  };
}

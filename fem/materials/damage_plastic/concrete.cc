#include "fem/materials/damage_plastic/concrete.h"

#include "base/number_text.h"
#include "fem/materials/damage_plastic/stress_invariants.h"
#include "fem/materials/refuse.h"

#include <cmath>

namespace fem
{
  namespace
  {
    using RowVoigt = Eigen::Matrix<double, 1, 6>;

    constexpr double nearly_damaged = 1 - 1e-6; // stands for full damage in an initial state
    constexpr int    finest         = 64;       // times the requested number of parts
    constexpr double flat           = 1e-6;     // extent over size of an element across its plane
    // Beyond it nothing is left of a point but rounding, and a solver that may go there takes an absurd equilibrium for one.
    constexpr double largest_strain = 10;

    /// Ductility of softening x_s from the ratio R_s of negative to total plastic volume, and its slope; doc/theory/damage-plastic-concrete.md, 3.
    std::pair<double, double> softening_ductility(const double a_s, const double ratio)
    {
      if (ratio < 1)
        return {1 + a_s * ratio * ratio, 2 * a_s * ratio};
      return {1 - 3 * a_s + 4 * a_s * std::sqrt(ratio), 2 * a_s / std::sqrt(ratio)};
    }
  }

  DamagePlasticConcrete::DamagePlasticConcrete(const Parameters &parameters)
    : p(parameters)
    , stiffness(base::isotropic_stiffness(p.bulk(), p.shear()))
    , compliance(stiffness.inverse())
    , return_mapping(p)
    , law(p.tensile_strength / p.young_modulus, p.softening_opening(), p.softening_curve())
  {
    if (p.element_size > 0)
      require_size(p.element_size);
    if (p.reference_size > 0)
      require_size(p.reference_size);
  }

  Response<DamagePlasticState> DamagePlasticConcrete::evaluate(const base::Voigt   &strain,
                                                               const State         &committed,
                                                               const ElementExtent &element,
                                                               const bool           with_tangent) const
  {
    const March flown = flow(strain, committed, with_tangent);
    Damaged     done  = damage(flown, flown.kappa_d, strain, committed, element, with_tangent);
    if (with_tangent && flown.kappa_d > committed.kappa_d)
      done.response.tangent += done.stress_by_driving * flown.d_kappa_d;
    return done.response;
  }

  DamagePlasticConcrete::March
  DamagePlasticConcrete::flow(const base::Voigt &strain, const State &committed, const bool with_tangent) const
  {
    if (!strain.allFinite())
      throw MaterialFailure("damage-plastic concrete: the strain is not a finite number.");
    const double largest = (strain - committed.strain).cwiseAbs().maxCoeff();
    int          first   = 1;
    if (p.largest_increment > 0 && largest > p.largest_increment)
      {
        if (largest > 1e6 * p.largest_increment)
          throw MaterialFailure("damage-plastic concrete: strain increment of " + base::number_text(largest) +
                                " in one step.");
        first = static_cast<int>(std::ceil(largest / p.largest_increment));
      }
    if (strain.cwiseAbs().maxCoeff() > largest_strain)
      throw MaterialFailure("damage-plastic concrete: a strain of more than 1000 %: nothing holds together there.");
    for (int parts = first; parts <= finest * first; parts *= 2)
      if (const auto done = march(strain, committed, parts, with_tangent))
        return *done;
    std::ostringstream text;
    text << "damage-plastic concrete: no admissible stress for strain " << strain.transpose() << " from strain "
         << committed.strain.transpose() << " with kappa_P = " << committed.kappa_p << ", not even in "
         << finest * first << " parts.";
    throw MaterialFailure(text.str());
  }

  std::optional<DamagePlasticConcrete::March> DamagePlasticConcrete::march(const base::Voigt &strain,
                                                                           const State       &committed,
                                                                           const int          substeps,
                                                                           const bool         with_tangent) const
  {
    March m;
    m.plastic               = committed.plastic_strain;
    m.elastic               = committed.strain - committed.plastic_strain;
    m.kappa_p               = committed.kappa_p;
    m.kappa_d               = committed.kappa_d;
    m.substeps              = substeps;
    const base::Voigt whole = strain - committed.strain;
    for (int k = 1; k <= substeps; ++k)
      {
        // The last part ends on the strain itself, not on the rounded sum of the parts.
        const base::Voigt end = k == substeps ? strain : base::Voigt(committed.strain + whole * (double(k) / substeps));
        const base::Voigt increment = end - (m.elastic + m.plastic);
        if (!substep(m, increment, double(k) / substeps - m.fraction, with_tangent))
          return std::nullopt;
        m.fraction = double(k) / substeps;
      }
    return m;
  }

  bool DamagePlasticConcrete::substep(March             &m,
                                      const base::Voigt &increment,
                                      const double       fraction,
                                      const bool         with_tangent) const
  {
    const double           fc      = p.compressive_strength;
    const base::Voigt      trial_e = m.elastic + increment;
    const base::Voigt      trial_s = stiffness * trial_e;
    const StressInvariants inv(trial_s);
    const PlasticTrial     trial{inv.volumetric / fc, inv.deviatoric / fc, inv.lode, m.kappa_p};
    const auto             end = return_mapping(trial);
    if (!end)
      return false;

    Eigen::Matrix<double, 4, 6> trial_by_strain = Eigen::Matrix<double, 4, 6>::Zero();
    base::Stiffness             d_trial_e;
    if (with_tangent)
      {
        d_trial_e              = m.d_elastic + fraction * base::Stiffness::Identity();
        const double two_g     = 2 * p.shear();
        const double over_rho  = inv.deviatoric > 0 ? two_g / inv.deviatoric : 0.0;
        trial_by_strain.row(0) = p.bulk() / fc * base::voigt_identity().transpose() * d_trial_e;
        trial_by_strain.row(1) = two_g / fc * inv.direction.transpose() * d_trial_e;
        trial_by_strain.row(2) = over_rho * inv.lode_direction.transpose() * d_trial_e;
        trial_by_strain.row(3) = m.d_kappa_p;
      }
    if (end->kind == ReturnKind::elastic)
      {
        m.elastic   = trial_e;
        m.effective = trial_s;
        if (with_tangent)
          {
            m.d_elastic   = d_trial_e;
            m.d_effective = stiffness * d_trial_e;
          }
        return true;
      }

    accumulate_damage(m, trial, *end, inv, with_tangent, trial_by_strain);
    if (with_tangent)
      {
        const Eigen::Matrix<double, 3, 6> d_end = end->sensitivity * trial_by_strain;
        m.d_effective = fc * (base::voigt_identity() * d_end.row(0) + inv.direction * d_end.row(1));
        if (inv.deviatoric > 0)
          {
            const base::Stiffness d_direction =
              2 * p.shear() / inv.deviatoric *
              (base::deviatoric_projector() - inv.direction * inv.direction.transpose()) * d_trial_e;
            m.d_effective += fc * end->y * d_direction;
          }
        m.d_elastic = compliance * m.d_effective;
        m.d_kappa_p = d_end.row(2);
      }
    m.effective = fc * (end->x * base::voigt_identity() + end->y * inv.direction);
    m.elastic   = compliance * m.effective;
    m.plastic += trial_e - m.elastic;
    m.kappa_p = end->kappa;
    return true;
  }

  void DamagePlasticConcrete::accumulate_damage(March                             &m,
                                                const PlasticTrial                &trial,
                                                const PlasticReturn               &end,
                                                const StressInvariants            &inv,
                                                const bool                         with_tangent,
                                                const Eigen::Matrix<double, 4, 6> &trial_by_strain) const
  {
    const double v_scale = p.compressive_strength / p.bulk(), w_scale = p.compressive_strength / (2 * p.shear());
    const double volume = v_scale * (trial.x - end.x); // plastic volume change of this part
    if (end.kappa <= 1 || volume <= 0)
      return;
    const double          shape = w_scale * (trial.y - end.y); // its deviatoric length
    const Eigen::Vector3d axes = inv.principal_direction(), turn = inv.principal_lode_direction();

    double negative = 0, negative_v = 0, negative_w = 0, negative_theta = 0;
    for (int i = 0; i < 3; ++i)
      if (volume / 3 + shape * axes[i] < 0)
        {
          negative -= volume / 3 + shape * axes[i];
          negative_v -= 1.0 / 3.0;
          negative_w -= axes[i];
          negative_theta -= shape * turn[i];
        }
    const double ratio         = negative / volume;
    const auto [x_s, x_s_rate] = softening_ductility(p.softening, ratio);

    // Share of the volume change that comes after the peak, kappa_P = 1 being crossed by linear interpolation.
    const double before  = base::trace(m.plastic);
    const double gained  = end.kappa - trial.kappa;
    double       after   = volume;
    RowVoigt     d_after = RowVoigt::Zero(), d_volume, d_end_kappa;
    if (with_tangent)
      {
        d_volume    = v_scale * (trial_by_strain.row(0) - end.sensitivity.row(0) * trial_by_strain);
        d_end_kappa = end.sensitivity.row(2) * trial_by_strain;
        d_after     = d_volume;
      }
    if (trial.kappa < 1)
      {
        const double share = (end.kappa - 1) / gained;
        if (before + (1 - share) * volume >= 0)
          {
            after = share * volume;
            if (with_tangent)
              d_after = share * d_volume +
                        volume / (gained * gained) * ((1 - trial.kappa) * d_end_kappa + (end.kappa - 1) * m.d_kappa_p);
          }
        else
          {
            after = before + volume; // the volume at the peak counts as zero if it was a contraction
            if (with_tangent)
              d_after = d_volume + m.fraction * base::voigt_identity().transpose() -
                        base::voigt_identity().transpose() * m.d_elastic;
            if (after <= 0)
              return;
          }
      }
    m.kappa_d += after / x_s;
    if (with_tangent)
      {
        const RowVoigt d_shape = w_scale * (trial_by_strain.row(1) - end.sensitivity.row(1) * trial_by_strain);
        const RowVoigt d_ratio =
          ((negative_v - ratio) * d_volume + negative_w * d_shape + negative_theta * trial_by_strain.row(2)) / volume;
        m.d_kappa_d += d_after / x_s - after * x_s_rate / (x_s * x_s) * d_ratio;
      }
  }

  DamagePlasticConcrete::Damaged DamagePlasticConcrete::damage(const March         &m,
                                                               const double         driving,
                                                               const base::Voigt   &strain,
                                                               const State         &committed,
                                                               const ElementExtent &element,
                                                               const bool           with_tangent) const
  {
    Damaged          done;
    Response<State> &response = done.response;
    response.substeps         = m.substeps;
    response.trial            = committed;
    State &s                  = response.trial;
    s.strain                  = strain;
    s.plastic_strain          = m.plastic;
    s.kappa_p                 = m.kappa_p;
    s.kappa_d                 = m.kappa_d;

    DamageLaw::Integrity integrity{1.0, 0.0};
    if (driving > 0)
      {
        s.size = effective_size(s, element);
        // h_ref acts until the second-order work has been negative; then only what comes on top uses h.
        const bool   reference = p.reference_size > 0 && s.localised_at < 0;
        const double offset    = s.localised_at < 0 ? 0.0 : (p.reference_size - s.size) * s.localised_at;
        integrity              = law.integrity(driving, reference ? p.reference_size : s.size, offset);
        s.damage               = std::fmax(1 - integrity.value, committed.damage);
      }
    const double whole = 1 - s.damage;
    response.stress    = whole * m.effective;
    s.stress           = response.stress;
    if (p.reference_size > 0 && s.localised_at < 0 && driving > 0 &&
        (s.strain - committed.strain).dot(s.stress - committed.stress) < 0)
      s.localised_at = driving + s.damage * p.tensile_strength / p.young_modulus;

    if (s.damage > 0)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> elastic(base::strain_tensor(m.elastic),
                                                                     Eigen::EigenvaluesOnly);
        s.crack_opening = s.size * (std::fmax(driving, 0.0) + s.damage * std::fmax(elastic.eigenvalues()[2], 0.0));
      }
    if (with_tangent)
      {
        response.tangent       = whole * m.d_effective;
        done.stress_by_driving = integrity.slope * m.effective;
      }
    return done;
  }

  Dissipation DamagePlasticConcrete::dissipation(const State &from, const State &to) const
  {
    const auto undamaged_energy = [this](const State &s) {
      const base::Voigt elastic = s.strain - s.plastic_strain;
      return 0.5 * elastic.dot(stiffness * elastic);
    };
    Dissipation d;
    d.plasticity = 0.5 * (from.stress + to.stress).dot(to.plastic_strain - from.plastic_strain);
    d.damage     = 0.5 * (undamaged_energy(from) + undamaged_energy(to)) * (to.damage - from.damage);
    return d;
  }

  double DamagePlasticConcrete::effective_size(const State &state, const ElementExtent &element) const
  {
    if (state.size > 0)
      return state.size;
    if (p.element_size > 0)
      return p.element_size;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> total(base::strain_tensor(state.strain));
    double                                               size = element.along(total.eigenvectors().col(2));
    if (size <
        flat * element.mean_size) // a plane element that opens across its plane: the mesh divides the next direction
      size = element.along(total.eigenvectors().col(1));
    require_size(size);
    return size;
  }

  void DamagePlasticConcrete::require_size(const double size) const
  {
    demand(size > 0, "element size [m]", size, "a softening point needs the size of its element.");
    std::ostringstream rule;
    rule << "must be below E w_f / f_t = " << law.largest_size()
         << " m, or softening would snap back inside the element. "
         << (p.element_size > 0 ? "Lower Element size" : "Refine the mesh") << " or raise the fracture energy";
    if (p.fracture_energy > 0 && p.fracture_energy < 1) // typed in N/mm
      rule << ", " << p.fracture_energy << " J/m^2, where about 100 is usual for concrete";
    rule << ".";
    demand(size < law.largest_size(), "element size [m]", size, rule.str());
  }

  DamagePlasticState DamagePlasticConcrete::initial_state(const InitialPointState &given,
                                                          const ElementExtent     &element) const
  {
    demand(given.damage >= 0 && given.damage <= 1, "initial damage", given.damage, "must lie in [0, 1].");
    demand(given.stress.allFinite(), "initial stress", given.stress.sum(), "must be finite.");
    State s;
    s.stress = given.stress;
    if (given.damage == 0)
      {
        demand(given.hardening >= 0 && given.hardening < 1, "initial kappa_P", given.hardening,
               "must lie in [0, 1) where there is no damage.");
        s.kappa_p        = given.hardening;
        s.plastic_strain = -compliance * given.stress;
        return s;
      }
    s.damage = std::fmin(given.damage, nearly_damaged);
    s.size   = p.element_size > 0 ? p.element_size : element.mean_size;
    require_size(s.size);
    s.kappa_d        = law.inverse(s.damage, p.reference_size > 0 ? p.reference_size : s.size);
    s.kappa_p        = 1 + s.kappa_d;
    s.plastic_strain = -compliance * given.stress / (1 - s.damage);
    return s;
  }
}

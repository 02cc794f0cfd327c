#include "coupling/sequential/identify.h"

#include "base/errors.h"
#include "fem/points/driven_point.h"
#include "fem/points/registry.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

namespace coupling
{
  ContinuumReference::ContinuumReference(const fem::MaterialConstants &material,
                                         const double                  size,
                                         const bool                    compression,
                                         const double                  strain_step,
                                         const double                  lowest)
  {
    constexpr int            most_steps = 100000;
    const auto               point      = material.make_point();
    const fem::ElementExtent extent     = fem::ElementExtent::uniform(size);
    const auto               strengths  = material.uniaxial_strengths();
    const double             unit       = compression ? strengths.compression : strengths.tension;
    fem::MixedTarget         target;
    target.stress_given = {{false, true, true, true, true, true}};
    samples.push_back({0, 0, 0});
    for (int n = 1; n <= most_steps; ++n)
      {
        target.value[0] = (compression ? -1 : 1) * n * strain_step;
        point->go_to(target, extent, unit, fem::Increments::followed);
        const double stress = std::abs(point->stress()[0]);
        if (stress > largest)
          {
            largest = stress;
            at_peak = samples.size();
          }
        samples.push_back({stress, 0, 0});
        point->visit([&here = samples.back()](const fem::PointQuantity &of, const double *value) {
          if (of.role == fem::PointQuantity::Role::hardening)
            here.hardening = *value;
          if (of.role == fem::PointQuantity::Role::damage)
            here.damage = *value;
        });
        if (stress < lowest * largest)
          return;
      }
  }

  double ContinuumReference::hardening_at(const double relative_stress) const
  {
    const double wanted = relative_stress * largest;
    for (std::size_t i = 1; i <= at_peak; ++i)
      if (samples[i].stress >= wanted)
        {
          const Sample &a = samples[i - 1], &b = samples[i];
          const double  part = b.stress > a.stress ? (wanted - a.stress) / (b.stress - a.stress) : 1;
          return std::min(1.0, a.hardening + part * (b.hardening - a.hardening));
        }
    return std::min(1.0, samples[at_peak].hardening);
  }

  double ContinuumReference::damage_at(const double relative_stress) const
  {
    const double wanted = relative_stress * largest;
    for (std::size_t i = at_peak + 1; i < samples.size(); ++i)
      if (samples[i].stress <= wanted)
        {
          const Sample &a = samples[i - 1], &b = samples[i];
          const double  part = a.stress > b.stress ? (a.stress - wanted) / (a.stress - b.stress) : 1;
          return a.damage + part * (b.damage - a.damage);
        }
    return samples.back().damage;
  }

  namespace
  {
    MappingLaw with(const Eigen::VectorXd &x, MappingLaw law)
    {
      law.factor   = std::exp(x[0]);
      law.exponent = std::exp(x[1]);
      law.weights  = {{x[2], 0, 1 - x[2]}};
      return law;
    }

    struct Wanted
    {
      Eigen::Matrix3d tensor;
      double          value;
    };

    /** Raw damage less wanted damage, for Eigen's Levenberg-Marquardt with differences for the Jacobian. */
    struct Misfit
    {
      using Scalar = double;
      enum
      {
        InputsAtCompileTime = Eigen::Dynamic,
        ValuesAtCompileTime = Eigen::Dynamic
      };
      using InputType    = Eigen::VectorXd;
      using ValueType    = Eigen::VectorXd;
      using JacobianType = Eigen::MatrixXd;

      const std::vector<Wanted> &wanted;
      const MappingLaw          &start;

      int inputs() const { return 3; }
      int values() const { return static_cast<int>(wanted.size()); }
      int operator()(const Eigen::VectorXd &x, Eigen::VectorXd &misfit) const
      {
        const MappingLaw law = with(x, start);
        for (std::size_t i = 0; i < wanted.size(); ++i)
          misfit[static_cast<Eigen::Index>(i)] = map_damage(wanted[i].tensor, law).raw - wanted[i].value;
        return 0;
      }
    };

    double root_mean_square(const Eigen::VectorXd &v)
    {
      return v.size() > 0 ? v.norm() / std::sqrt(static_cast<double>(v.size())) : 0;
    }

    /** Start and slope of the hardening over raw damage; what may not be exceeded is cut off, the slope first. */
    void fit_hardening(const std::vector<Wanted> &undamaged, Identification &found)
    {
      MappingLaw                            &law       = found.law;
      constexpr double                       below_one = 1 - 1e-6;
      double                                 n = 0, x = 0, y = 0, xx = 0, xy = 0;
      std::vector<std::pair<double, double>> line;
      for (const Wanted &w : undamaged)
        if (const double raw = map_damage(w.tensor, law).raw; raw < law.switch_damage)
          line.emplace_back(raw, w.value);
      for (const auto &[raw, kappa] : line)
        {
          n += 1;
          x += raw;
          y += kappa;
          xx += raw * raw;
          xy += raw * kappa;
        }
      found.undamaged = line.size();
      if (line.size() < 2 || n * xx - x * x <= 0)
        return;
      const double slope  = (n * xy - x * y) / (n * xx - x * x);
      law.hardening_start = std::clamp((y - slope * x) / n, 0.0, below_one * below_one);
      law.hardening_slope = std::clamp(slope, 0.0, (below_one - law.hardening_start) / law.switch_damage);
      double squares      = 0;
      for (const auto &[raw, kappa] : line)
        squares += std::pow(law.hardening_start + law.hardening_slope * raw - kappa, 2);
      found.hardening_error = std::sqrt(squares / n);
    }
  } // namespace

  Identification identify(const std::vector<ParticleObservation> &observations,
                          const ContinuumReference               &reference,
                          const MappingLaw                       &start)
  {
    std::vector<Wanted> damaged, undamaged;
    for (const ParticleObservation &o : observations)
      if (o.after_peak)
        damaged.push_back({o.damage_tensor, reference.damage_at(o.relative_stress)});
      else
        undamaged.push_back({o.damage_tensor, reference.hardening_at(o.relative_stress)});
    if (damaged.size() < 4)
      throw base::InputError(
        "identify: " + std::to_string(damaged.size()) +
        " states after the peak; three constants need at least four. Strain the particles further.");

    Identification found;
    found.damaged = damaged.size();
    Eigen::VectorXd x(3);
    x << std::log(1.17), std::log(3.95), 0.85; // of the published states: near enough for any concrete
    const Misfit                                            misfit{damaged, start};
    Eigen::NumericalDiff<Misfit>                            differences(misfit);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Misfit>> search(differences);
    search.minimize(x);
    found.law = with(x, start);
    Eigen::VectorXd left(misfit.values());
    misfit(x, left);
    found.damage_error = root_mean_square(left);
    fit_hardening(undamaged, found);
    found.law.validate();
    return found;
  }
} // namespace coupling

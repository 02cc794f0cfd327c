// Hard case S8: return mapping under 10^6 random increments, and the tangent against differences.
#include "fem/materials/damage_plastic/stress_invariants.h"
#include "fem/references/concrete_points.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace fem::references;

using base::Voigt;

namespace
{
  /// Strain increments of 0.01 to 100 times the elastic limit, in every direction of strain space; one in four near the
  /// hydrostatic axis, so that both vertices are met, and one in eight near a meridian.
  class RandomIncrement
  {
  public:
    explicit RandomIncrement(const unsigned int seed)
      : engine(seed)
    {
    }

    Voigt operator()(const double elastic_limit)
    {
      Voigt direction;
      for (int i = 0; i < 6; ++i)
        direction[i] = normal(engine);
      const double kind = uniform(engine);
      const double sign = uniform(engine) < 0.5 ? -1 : 1;
      if (kind < 0.25)
        direction = sign * base::voigt_identity() + std::pow(10, -4 * uniform(engine)) * direction;
      else if (kind < 0.375)
        {
          const Voigt axial = (Voigt() << 1, 0, 0, 0, 0, 0).finished();
          direction =
            sign * axial + normal(engine) * base::voigt_identity() + std::pow(10, -6 * uniform(engine)) * direction;
        }
      const double size = elastic_limit * std::pow(10, -2 + 4 * uniform(engine));
      return direction * (size / direction.cwiseAbs().maxCoeff());
    }

    double fraction() { return uniform(engine); }

  private:
    std::mt19937_64                        engine;
    std::normal_distribution<double>       normal;
    std::uniform_real_distribution<double> uniform{0, 1};
  };

  /// f at the effective stress of a state.
  double yield_of(const fem::DamagePlasticConcrete &law, const fem::DamagePlasticState &s, const double fc)
  {
    const fem::StressInvariants inv(law.elastic_stiffness() * (s.strain - s.plastic_strain));
    const auto                 &surface = law.plasticity().surface();
    return surface.yield(inv.volumetric / fc, inv.deviatoric / fc, surface.lode_radius(inv.lode).value,
                         surface.hardening(s.kappa_p).value);
  }

  struct Tally
  {
    long   steps = 0, plastic = 0, vertex = 0, divided = 0, failed = 0, broken = 0;
    double worst_yield = 0;
  };

  Tally drive(const fem::DamagePlasticParameters &p, const long increments)
  {
    const fem::DamagePlasticConcrete law(p);
    RandomIncrement                  random(20240611);
    fem::DamagePlasticState          state;
    Tally                            tally;
    const double                     limit = p.compressive_strength / p.young_modulus;
    for (long n = 0; n < increments; ++n)
      {
        if (random.fraction() < 0.1)
          state = {};
        // From the last stress-free strain half of the time: otherwise the strain would walk far away.
        const Voigt base = random.fraction() < 0.5 ? state.strain : state.plastic_strain;
        ++tally.steps;
        try
          {
            const auto r = law.evaluate(base + random(limit), state, {}, false);
            tally.divided += r.substeps > 1;
            tally.plastic += r.trial.kappa_p > state.kappa_p;
            tally.worst_yield = std::max(tally.worst_yield, yield_of(law, r.trial, p.compressive_strength));
            if (!r.stress.allFinite() || r.trial.kappa_p < state.kappa_p || r.trial.kappa_d < state.kappa_d ||
                r.trial.damage < state.damage || r.trial.damage > 1)
              ++tally.broken;
            state = r.trial;
          }
        catch (const fem::MaterialFailure &failure)
          {
            UNSCOPED_INFO(failure.what());
            ++tally.failed;
            state = {};
          }
      }
    return tally;
  }
}

namespace
{
  void require_sound(const Tally &t)
  {
    INFO("plastic " << t.plastic << ", divided " << t.divided << ", worst yield " << t.worst_yield);
    CHECK(t.failed == 0);
    CHECK(t.broken == 0);
    CHECK(t.worst_yield <= 1e-8);
    CHECK(t.plastic > t.steps / 3); // or the test measures elasticity
  }

  /// Smallest relative difference between the tangent and central differences over a range of widths: wide ones are
  /// truncated, narrow ones rounded, and between them lies what the tangent is really worth.
  double tangent_error(const fem::DamagePlasticConcrete &law, const fem::DamagePlasticState &state, const Voigt &strain)
  {
    const base::Stiffness tangent = law.evaluate(strain, state, {}).tangent;
    double                best    = 1e300;
    for (const double width : {1e-4, 1e-5, 1e-6, 1e-7})
      {
        const double    h = width * std::max(strain.cwiseAbs().maxCoeff(), 1e-5);
        base::Stiffness difference;
        for (int j = 0; j < 6; ++j)
          {
            const auto at = [&](const double f) {
              return law.evaluate(strain + f * h * Voigt::Unit(j), state, {}, false).stress;
            };
            difference.col(j) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h); // fourth order
          }
        best = std::min(best, (difference - tangent).norm() / law.elastic_stiffness().norm());
      }
    return best;
  }

  /// Errors of the tangent over random states, sorted.
  std::vector<double> tangent_errors(const fem::DamagePlasticParameters &p, const int samples, const unsigned int seed)
  {
    const fem::DamagePlasticConcrete law(p);
    RandomIncrement                  random(seed);
    std::vector<double>              errors;
    const double                     limit = p.compressive_strength / p.young_modulus;
    fem::DamagePlasticState          state;
    for (int n = 0; n < samples; ++n)
      {
        if (random.fraction() < 0.2)
          state = {};
        const Voigt strain = state.plastic_strain + 0.1 * random(limit);
        errors.push_back(tangent_error(law, state, strain));
        state = law.evaluate(strain, state, {}, false).trial;
      }
    std::sort(errors.begin(), errors.end());
    return errors;
  }
}

TEST_CASE("S8: the return of concrete converges for 10^5 random increments taken whole", "[fem][stability]")
{
  require_sound(drive(material_m1(), 100000));
}

TEST_CASE("S8: the return of concrete converges for 10^6 random increments taken whole, two materials",
          "[fem][stability][slow]")
{
  require_sound(drive(material_m1(), 1000000));
  require_sound(drive(material_m2(), 1000000));
}

TEST_CASE("S8: the return of concrete converges for 10^5 random increments in sub-steps", "[fem][stability][slow]")
{
  auto p              = material_m1();
  p.largest_increment = 2e-4;
  require_sound(drive(p, 100000));
}

TEST_CASE("S8: the tangent of concrete agrees with differences to 1e-6", "[fem][stability]")
{
  auto divided              = material_m1();
  divided.largest_increment = 2e-4;
  for (const auto &p : {material_m1(), divided})
    {
      const auto errors = tangent_errors(p, 2000, 7);
      INFO("median " << errors[1000] << ", 99 % " << errors[1980] << ", 99.9 % " << errors[1998]);
      CHECK(errors.back() <= 1e-6);
    }
}

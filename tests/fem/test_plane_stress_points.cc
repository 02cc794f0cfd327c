// Points of a solid in plane stress, evaluated as by a solver: strain after strain from one committed history.
#include "fem/points/material_points.h"
#include "tests/fem/random_concrete.h"

#include <catch2/catch.hpp>

#include <memory>

namespace
{
  using base::Voigt;
  using Law = fem::DamagePlasticConcrete;

  constexpr std::array<bool, 6> across{false, false, true, true, true, false}; // stresses given: zero

  Voigt in_plane(Voigt strain)
  {
    strain[2] = strain[3] = strain[4] = 0;
    return strain;
  }

  /// One point, which goes from strain to strain.
  class DrivenPoint
  {
  public:
    explicit DrivenPoint(const Law &law)
      : points(fem::make_points(law, fem::Plane::stress))
    {
      points->allocate(1);
    }

    Voigt response(const Voigt &strain)
    {
      points->evaluate(0, strain, fem::ElementExtent{}, false, answer);
      return answer.stress;
    }

    void begin_step() { points->begin_step(); }
    void commit() { points->commit(); }

    /// So many steps in a straight line. @return the stress at the end
    Voigt go_to(const Voigt &strain, const int steps)
    {
      const Voigt from = in_plane(state("strain"));
      Voigt       stress;
      for (int k = 1; k <= steps; ++k)
        {
          stress = response(from + (strain - from) * (double(k) / steps));
          commit();
        }
      return stress;
    }

    /// The committed history, one column of it.
    Voigt state(const std::string &name)
    {
      Voigt found = Voigt::Zero();
      points->visit(0, [&](const fem::PointQuantity &of, const double *values) {
        if (of.name == name)
          std::copy(values, values + of.values(), found.data());
      });
      return found;
    }

    /// Goes on from where another is.
    void stand_where(DrivenPoint &other)
    {
      std::vector<double> all;
      other.points->visit(0, [&](const fem::PointQuantity &of, const double *values) {
        all.insert(all.end(), values, values + of.values());
      });
      auto next = all.begin();
      points->visit(0, [&](const fem::PointQuantity &of, double *values) {
        std::copy(next, next + of.values(), values);
        next += of.values();
      });
    }

  private:
    std::unique_ptr<fem::MaterialPoints> points;
    fem::PointAnswer                     answer;
  };

  /// 0.1 to 10 times the elastic limit, in the plane.
  Voigt any_strain(const Law &law, const fem::DamagePlasticParameters &p, Random &random)
  {
    return in_plane(any_target(law, p, across, random).value);
  }
}

TEST_CASE("plane stress: 10000 random steps of a solid's points end within 2 % of many short ones, or are refused",
          "[fem][slow]")
{
  Random random(2077);
  int    answered = 0;
  double worst    = 0;
  for (int i = 0; i < 10000; ++i)
    {
      const auto  p = any_concrete(random);
      const Law   law(p);
      DrivenPoint point(law), before(law), fine(law);
      if (random.one_in(3)) // from a history that has yielded or softened
        try
          {
            before.go_to(any_strain(law, p, random), 50);
          }
        catch (const fem::MaterialFailure &)
          {
          }
      point.stand_where(before);
      fine.stand_where(before);
      const Voigt from   = in_plane(before.state("strain"));
      Voigt       target = any_strain(law, p, random);
      if (random.one_in(2) && from.norm() > 0) // back to where little strain is left
        target = (target * random.between(-0.1, 0.1) + from * random.between(-0.1, 0.1)).eval();
      const double tried = random.one_in(2) ? random.between(0.2, 1.5) : 0;
      INFO("step " << i << ", nu = " << p.poisson_ratio << ", tried first at " << tried << " of it");
      Voigt stress;
      try
        {
          point.begin_step();
          if (tried > 0) // as an iteration that ends elsewhere
            point.response(from + tried * (target - from));
          stress = point.response(target);
        }
      catch (const fem::MaterialFailure &)
        {
          continue;
        }
      ++answered;
      point.commit();
      const double length = (target - from).cwiseAbs().maxCoeff() / law.strain_scale();
      double       d      = 1;
      try
        {
          const Voigt  exact = fine.go_to(target, std::max(200, static_cast<int>(16 * length)));
          const double unit  = std::fmax(exact.cwiseAbs().maxCoeff(), 0.01 * p.tensile_strength);
          d                  = (stress - exact).cwiseAbs().maxCoeff() / unit;
          if (fine.state("damage")[0] <= 0.999) // else no stiffness is left to determine the strain across
            {
              const Voigt there = fine.state("strain");
              d = std::fmax(d, (point.state("strain") - there).cwiseAbs().maxCoeff() / there.cwiseAbs().maxCoeff());
            }
        }
      catch (const fem::MaterialFailure &failure)
        {
          FAIL_CHECK("answered, but not in short steps: " << failure.what());
        }
      CHECK(d < 0.02);
      worst = std::fmax(worst, d);
    }
  CAPTURE(answered, worst);
  CHECK(answered > 8000);
}

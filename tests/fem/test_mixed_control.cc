// Points of which some components are given in stress: the answer is the end of the path from the last state.
#include "fem/references/concrete_points.h"
#include "tests/fem/random_concrete.h"

#include <catch2/catch.hpp>

using namespace fem::references;

namespace
{
  using base::Voigt;
  using fem::MixedTarget;
  using Law      = fem::DamagePlasticConcrete;
  using State    = fem::DamagePlasticState;
  using Solution = fem::MixedSolution<Law>;

  constexpr double unit = 1e6; // [Pa]

  Solution solve(const Law &law, const MixedTarget &target, const State &from)
  {
    return fem::solve_mixed(law, target, from, fem::ElementExtent{}, unit);
  }

  MixedTarget uniaxial(const double strain)
  {
    MixedTarget target;
    target.stress_given = {false, true, true, true, true, true};
    target.value[0]     = strain;
    return target;
  }

  MixedTarget plane_stress(const double xx, const double yy, const double xy)
  {
    MixedTarget target;
    target.stress_given = {false, false, true, true, true, false};
    target.value << xx, yy, 0, 0, 0, xy;
    return target;
  }

  /// The same way in so many steps of their own, or all but the last two of them.
  State
  stepped(const Law &law, const MixedTarget &target, const State &from, const int steps, const bool to_the_end = true)
  {
    State state = from;
    for (int k = 1; k <= steps - (to_the_end ? 0 : 2); ++k)
      {
        MixedTarget next = target;
        for (int i = 0; i < 6; ++i)
          {
            const double start = target.stress_given[i] ? from.stress[i] : from.strain[i];
            next.value[i]      = start + (target.value[i] - start) * k / steps;
          }
        state = solve(law, next, state).response.trial;
      }
    return state;
  }

  std::array<bool, 6> any_control(Random &random)
  {
    std::array<bool, 6> given{};
    switch (static_cast<int>(random.between(0, 4)))
      {
      case 0:
        return {false, true, true, true, true, true};
      case 1:
        return {false, false, true, true, true, false};
      default:
        do
          for (bool &component : given)
            component = random.one_in(2);
        while (std::count(given.begin(), given.end(), true) % 6 == 0);
        return given;
      }
  }

  double difference(const Solution &found, const State &fine, const double tensile_strength)
  {
    const double stress = std::fmax(fine.stress.cwiseAbs().maxCoeff(), 0.01 * tensile_strength);
    const double d      = (found.response.stress - fine.stress).cwiseAbs().maxCoeff() / stress;
    if (fine.damage > 0.999) // no stiffness is left to determine strains
      return d;
    return std::fmax(d, (found.strain - fine.strain).cwiseAbs().maxCoeff() / fine.strain.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("mixed control: one long step ends where many short ones do, not at a far, fully damaged answer", "[fem]")
{
  fem::DamagePlasticParameters p = material_m1();
  p.largest_increment            = 2e-4;
  p.poisson_ratio                = 0.4;
  const Solution pressed         = solve(Law(p), uniaxial(-4e-4), {});
  CHECK(pressed.response.stress[0] == Approx(-11.65e6).epsilon(0.01));
  CHECK(pressed.response.trial.damage == 0);

  p                       = material_m2();
  p.largest_increment     = 2e-4;
  const Solution crushing = solve(Law(p), uniaxial(-2e-3), {});
  CHECK(crushing.response.stress[0] == Approx(-39.9e6).epsilon(0.01));
  CHECK(crushing.response.trial.damage == 0);

  p.poisson_ratio = 0.25;
  const Law      law(p);
  const Solution pulled = solve(law, plane_stress(1.1e-4, 0, 0), {});
  const State    fine   = stepped(law, plane_stress(1.1e-4, 0, 0), {}, 50);
  CHECK(fine.stress[0] > 1e5);
  CHECK(pulled.response.stress[0] == Approx(fine.stress[0]).epsilon(0.01));
  CHECK(pulled.response.stress[1] == Approx(fine.stress[1]).epsilon(0.01));
}

TEST_CASE("mixed control: a step taken whole ends at the answer next to the path", "[fem]")
{
  fem::DamagePlasticParameters p = material_m1();
  p.poisson_ratio                = 0.4;
  const Law      whole(p);
  const Solution found =
    fem::solve_mixed(whole, uniaxial(-4e-4), {}, fem::ElementExtent{}, unit, fem::Increments::whole);
  CHECK(found.parts == 1);
  CHECK(found.response.stress[0] == Approx(-11.65e6).epsilon(0.05));
  CHECK(found.response.trial.damage == 0);
  // The answer of one increment: the law itself gives it for the strain that was found.
  CHECK((whole.evaluate(found.strain, {}, {}).stress - found.response.stress).norm() < 1e-3);
}

TEST_CASE("mixed control: a stress beyond the strength is refused with the part of the path that exists", "[fem]")
{
  fem::DamagePlasticParameters p = material_m1();
  p.largest_increment            = 2e-4;
  const Law   law(p);
  MixedTarget target;
  target.stress_given.fill(true);
  target.value[0] = 4e6; // f_t is three quarters of it
  try
    {
      solve(law, target, {});
      FAIL("it was borne");
    }
  catch (const fem::MaterialFailure &failure)
    {
      const std::string text  = failure.what();
      const std::string words = "can be followed over ";
      REQUIRE(text.find(words) != std::string::npos);
      CHECK(std::stod(text.substr(text.find(words) + words.size())) == Approx(75).margin(3));
      CHECK_THAT(text, Catch::Contains("no strain nearby meets the prescribed stresses"));
    }
}

TEST_CASE("mixed control: the tangent is the derivative of the answer, of steps at once and of walks", "[fem]")
{
  fem::DamagePlasticParameters p = material_m1();
  p.largest_increment            = 2e-4;
  p.element_size                 = 0.1;
  const Law law(p);
  for (const bool walked : {false, true})
    {
      const State       from   = stepped(law, plane_stress(1e-4, 2e-5, 3e-5), {}, 20);
      const MixedTarget target = walked ? plane_stress(4e-4, 0, 1e-4) : plane_stress(1.1e-4, 2.2e-5, 3.2e-5);
      const Solution    at     = solve(law, target, from);
      CHECK((at.parts > 1) == walked);
      const base::Stiffness tangent = fem::mixed_tangent(law, target, from, fem::ElementExtent{}, unit, at);
      for (const int j : {0, 1, 5})
        {
          const double step = 1e-9;
          MixedTarget  low = target, high = target;
          low.value[j] -= step;
          high.value[j] += step;
          const Voigt slope =
            (solve(law, high, from).response.stress - solve(law, low, from).response.stress) / (2 * step);
          for (const int i : {0, 1, 5})
            CHECK(tangent(i, j) == Approx(slope[i]).margin(2e-4 * p.young_modulus));
        }
      CHECK(tangent.row(2).norm() == 0);
      CHECK(tangent.col(3).norm() == 0);
    }
}

TEST_CASE(
  "mixed control: 10000 steps of 0.1 to 10 times the elastic limit end within 2 % of many short ones, or are refused",
  "[fem][slow]")
{
  Random random(1966);
  int    answered = 0, refused = 0;
  double worst = 0;
  for (int i = 0; i < 10000; ++i)
    {
      const auto        p = any_concrete(random);
      const Law         law(p);
      const MixedTarget target = any_target(law, p, any_control(random), random);
      State             from;
      if (random.one_in(3)) // from a state that has yielded or softened
        try
          {
            from = stepped(law, any_target(law, p, any_control(random), random), {}, 50);
          }
        catch (const fem::MaterialFailure &)
          {
          }
      std::optional<Solution> found;
      try
        {
          found = solve(law, target, from);
        }
      catch (const fem::MaterialFailure &)
        {
          ++refused;
          continue;
        }
      ++answered;
      INFO("step " << i << ", nu = " << p.poisson_ratio << ", parts " << found->parts << ", damage "
                   << found->response.trial.damage);
      const int steps = std::max(200, 4 * found->parts);
      double    d     = 1;
      try
        {
          State fine;
          try
            {
              fine = stepped(law, target, from, steps);
            }
          catch (const fem::MaterialFailure &)
            {
              // A way that ends on the vertex of the yield surface: the last, short steps find no slope there.
              fine = stepped(law, target, from, steps, false);
            }
          d = difference(*found, fine, p.tensile_strength);
        }
      catch (const fem::MaterialFailure &failure)
        {
          FAIL_CHECK("answered, but not in short steps: " << failure.what());
        }
      CHECK(d < 0.02);
      worst = std::fmax(worst, d);
    }
  CAPTURE(answered, refused, worst);
  CHECK(answered > 8000);
}

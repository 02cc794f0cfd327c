// What holds for every material that a scene can name.
#include "fem/points/driven_point.h"
#include "fem/points/registry.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <set>
#include <string>

namespace
{
  /// A value for every constant without a default; a new name wants one here.
  double typical(const std::string &key)
  {
    if (key == "Young modulus")
      return 30e9;
    if (key == "Poisson ratio")
      return 0.2;
    if (key == "Compressive strength")
      return 30e6;
    if (key == "Tensile strength")
      return 3e6;
    if (key.size() == 3 && key[0] == 'D')
      return key[1] != key[2] ? (key[2] <= '3' ? 6e9 : 0.1e9) : (key[1] <= '3' ? 30e9 : 12e9);
    FAIL("no typical value for " << key);
    return 0;
  }

  std::unique_ptr<fem::MaterialConstants> typical_constants(const fem::MaterialKind &kind)
  {
    auto constants = kind.constants();
    constants->visit([&](const char *key, double &member, const char *, const char *, double, double, bool required) {
      if (required)
        member = typical(key);
      if (std::string(key) == "Fracture energy") // one of two
        member = 100;
    });
    return constants;
  }

  constexpr const char *roles[] = {"none", "damage", "damage driving", "hardening", "crack opening"};
}

TEST_CASE("every material describes each constant once, with unit, meaning and a default within its bounds", "[fem]")
{
  for (const auto &kind : fem::material_kinds())
    {
      CHECK_FALSE(kind->name().empty());
      CHECK_FALSE(kind->meaning().empty());
      std::set<std::string> keys;
      kind->constants()->visit([&](const std::string &key, const double &value, const std::string &unit,
                                   const std::string &meaning, const double lower, const double upper,
                                   const bool required) {
        INFO(kind->name() << ": " << key);
        CHECK(keys.insert(key).second);
        CHECK_FALSE(unit.empty());
        CHECK_FALSE(meaning.empty());
        CHECK(lower < upper);
        CHECK((required ? std::isnan(value) : value >= lower && value <= upper));
      });
      CHECK_FALSE(keys.empty());
      CHECK_FALSE(kind->is_numerical("no such constant"));
      typical_constants(*kind)->check();
    }
}

TEST_CASE("every material names what it remembers, each once, with a unit, and gives a role to one column only",
          "[fem]")
{
  for (const auto &kind : fem::material_kinds())
    {
      INFO(kind->name());
      std::set<std::string>              names;
      std::set<fem::PointQuantity::Role> given;
      const auto                         quantities = kind->quantities();
      CHECK(kind->has_history() == !quantities.empty());
      for (const fem::PointQuantity &of : quantities)
        {
          INFO(of.name);
          const std::string name = of.name;
          CHECK(names.insert(name).second);
          CHECK(name.find_first_of(" -/[],") == std::string::npos);
          CHECK_FALSE(std::string(of.unit).empty());
          if (of.role != fem::PointQuantity::Role::other)
            {
              INFO(roles[static_cast<int>(of.role)]);
              CHECK(given.insert(of.role).second);
              CHECK(of.kind == fem::PointQuantity::Kind::number);
            }
        }
      CHECK(kind->takes_initial_state() <= (given.count(fem::PointQuantity::Role::damage) == 1));
      const auto points = typical_constants(*kind)->make_points(fem::Plane::strain);
      CHECK(points->material_name() == kind->name());
      CHECK(points->linear() == !kind->has_history());
      CHECK(points->quantities().size() == quantities.size());
    }
}

TEST_CASE(
  "every material answers with the derivative of its stress, and a history that is read back gives the same bits",
  "[fem]")
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const fem::ElementExtent               element = fem::ElementExtent::uniform(0.1);
  for (const auto &kind : fem::material_kinds())
    {
      INFO(kind->name());
      const auto constants = typical_constants(*kind);
      const auto points = constants->make_points(fem::Plane::strain), copy = constants->make_points(fem::Plane::strain);
      points->allocate(1);
      copy->allocate(1);
      base::Voigt      strain = base::Voigt::Zero();
      fem::PointAnswer now, ahead, behind, again;
      for (int step = 0; step < 20; ++step)
        {
          for (int i = 0; i < 6; ++i)
            strain[i] += 2e-5 * in(random);
          points->evaluate(0, strain, element, true, now);
          points->commit();
          CHECK(points->stored_energy(0, strain, now.stress) >= 0);
        }
      std::vector<double> numbers;
      points->visit(0, [&](const fem::PointQuantity &of, const double *first) {
        numbers.insert(numbers.end(), first, first + of.values());
      });
      auto next = numbers.begin();
      copy->visit(0, [&](const fem::PointQuantity &of, double *first) {
        std::copy_n(next, of.values(), first);
        next += of.values();
      });
      copy->commit(); // the trial history is the one that was read
      const base::Voigt further = 1.1 * strain;
      points->evaluate(0, further, element, true, now);
      copy->evaluate(0, further, element, true, again);
      CHECK(now.stress == again.stress);
      CHECK(now.tangent == again.tangent);
      for (int j = 0; j < 6; ++j)
        {
          constexpr double h     = 1e-9;
          base::Voigt      moved = further;
          moved[j] += h;
          points->evaluate(0, moved, element, false, ahead);
          moved[j] -= 2 * h;
          points->evaluate(0, moved, element, false, behind);
          const base::Voigt difference = (ahead.stress - behind.stress) / (2 * h);
          CHECK((difference - now.tangent.col(j)).norm() < 1e-4 * now.tangent.norm());
        }
    }
}

TEST_CASE("every material stores and dissipates the work of its stresses, and accounts for it in long steps too",
          "[fem]")
{
  const fem::ElementExtent element = fem::ElementExtent::uniform(0.1);
  for (const auto &kind : fem::material_kinds())
    for (const fem::Plane plane : {fem::Plane::strain, fem::Plane::stress})
      {
        INFO(kind->name() << (plane == fem::Plane::stress ? ", plane stress" : ""));
        base::Voigt straight;
        straight << 5e-4, -1e-4, 0, 0, 0, 2e-4;
        double lost[2], stored = 0;
        for (const int steps : {1, 200})
          {
            const auto points = typical_constants(*kind)->make_points(plane);
            points->allocate(1);
            fem::PointAnswer now;
            base::Voigt      last = base::Voigt::Zero();
            double           work = 0, &sum = lost[steps == 1 ? 0 : 1];
            sum = 0;
            for (int k = 1; k <= steps; ++k)
              {
                points->begin_step();
                points->evaluate(0, straight * (double(k) / steps), element, false, now);
                const fem::Dissipation d = points->dissipated(0, element);
                CHECK(d.plasticity >= 0);
                CHECK(d.damage >= 0);
                sum += d.total();
                points->commit();
                work += 0.5 * (last + now.stress).dot(straight) / steps;
                last = now.stress;
              }
            stored = points->stored_energy(0, straight, now.stress);
            if (steps > 1)
              CHECK(work == Approx(stored + sum).epsilon(1e-3));
          }
        CHECK((lost[1] > 0) == kind->has_history());
        CHECK(lost[0] == Approx(lost[1]).epsilon(0.02));
      }
}

TEST_CASE("every material can be driven alone along a path of stresses", "[fem]")
{
  for (const auto &kind : fem::material_kinds())
    {
      INFO(kind->name());
      const auto       point = typical_constants(*kind)->make_point();
      fem::MixedTarget target;
      target.stress_given = {true, true, true, true, true, true};
      target.value << 1e6, -2e6, 0, 0, 0, 0.5e6;
      point->go_to(target, fem::ElementExtent::uniform(0.1), 1e6, point->increments());
      CHECK((point->stress() - target.value).norm() < 1);
      CHECK(point->strain()[1] < 0);
      CHECK(point->parts() >= 1);
    }
}

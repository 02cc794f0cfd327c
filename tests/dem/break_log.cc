// The log of what breaks: each element of a bond once, with its time, place and mode; and the balance of a pair in every state (T11).
#include "dem/model/break_log.h"

#include "dem/laws/contact_bond.h"
#include "dem/laws/parallel_bond.h"
#include "held_joint.h"
#include "held_pair.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using Eigen::Vector3d;

namespace
{
  using namespace held_pair;
  using held_joint::mortar;

  template <typename Parameters>
  Parameters bond()
  {
    Parameters p;
    p.effective_modulus = 10e9;
    p.tensile_strength  = 1e6;
    p.cohesion          = 2e6;
    return p;
  }

  dem::ParallelBondParameters cement() { return bond<dem::ParallelBondParameters>(); }
  dem::ContactBondParameters  spot() { return bond<dem::ContactBondParameters>(); }

  /** What a pair logs that is opened, or slips, to beyond its strength. */
  std::vector<dem::Break> logged(const int dimension, const dem::LinkMaterials &law, const bool opens)
  {
    HeldPair     pair(dimension, law, 0.7);
    const double strain = 1e-3; // ten times and more of what any of them bears
    pair.drive(opens ? strain * 2 * R : 0, opens ? 0 : strain * 2 * R, 0, 4000);
    pair.specimen.advance(4000);
    return pair.specimen.breaks();
  }
} // namespace

TEST_CASE("bonds are logged once with the mode in which they broke, where they lay", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const bool opens : {true, false})
      for (const dem::LinkMaterials &law : {dem::LinkMaterials(cement()), dem::LinkMaterials(spot())})
        {
          const auto found = logged(dimension, law, opens);
          REQUIRE(found.size() == 1);
          CHECK(found[0].mode == (opens ? dem::BreakMode::tension : dem::BreakMode::shear));
          CHECK(found[0].element == 0);
          CHECK(std::set<std::int32_t>(found[0].ends.begin(), found[0].ends.end()) == std::set<std::int32_t>{0, 1});
          CHECK(found[0].area == Approx(section(dimension)));
          CHECK((found[0].place - R * Vector3d(std::cos(0.7), std::sin(0.7), 0)).norm() < 1e-2 * R);
          CHECK(std::abs(found[0].normal.dot(Vector3d(std::cos(0.7), std::sin(0.7), 0))) > 1 - 1e-5);
          CHECK(found[0].time > 0);
          CHECK(found[0].step > 0);
        }
}

TEST_CASE("links of a law that does not report how they break are logged as damaged until broken", "[dem]")
{
  const auto found = logged(3, cluster::concrete(), true);
  for (const dem::Break &b : found)
    CHECK(b.mode == dem::BreakMode::gradual);
  HeldPair pair(3, cluster::concrete());
  pair.drive(0.1 * R, 0, 0, 4000);
  pair.specimen.advance(4000);
  REQUIRE(pair.specimen.breaks().size() == 1);
  CHECK(pair.specimen.logged_breaks() == 1);
}

TEST_CASE("elements of a flat joint are logged one by one, from the side that opens", "[dem][laws]")
{
  const auto   law  = mortar(4);
  const double unit = law.tensile_strength * 2 * R / law.effective_modulus / R; // sigma_c/(k_n R)
  HeldPair     pair(2, law);
  pair.drive(0, 0, 5 * unit, 3000);
  pair.specimen.advance(3000);
  const auto bent = pair.specimen.breaks();
  REQUIRE(bent.size() == 2); // about a fixed middle two of four elements open
  CHECK(bent[0].step < bent[1].step);
  const std::set<std::int32_t> both = {bent[0].element, bent[1].element};
  CHECK((both == std::set<std::int32_t>{0, 1} || both == std::set<std::int32_t>{2, 3}));
  CHECK((bent[0].element == 0 || bent[0].element == 3)); // the outermost first
  // The second turns counter-clockwise: what lies below opens.
  CHECK(bent[0].place.y() == Approx(-0.75 * R).epsilon(1e-3));
  CHECK(bent[1].place.y() == Approx(-0.25 * R).epsilon(1e-3));
  for (const dem::Break &b : bent)
    {
      CHECK(b.mode == dem::BreakMode::tension);
      CHECK(b.area == Approx(0.25 * section(2)));
      CHECK(b.place.x() == Approx(R).epsilon(1e-3));
    }
  CHECK(pair.specimen.counts().broken == 0); // the joint still holds by the others

  // Pulled on, the rest breaks; each element stands in the log once.
  pair.drive(1e-3 * R, 0, 0, 3000);
  pair.specimen.advance(3000);
  const auto all = pair.specimen.breaks();
  REQUIRE(all.size() == 4);
  std::set<std::int32_t> elements;
  for (const dem::Break &b : all)
    elements.insert(b.element);
  CHECK(elements.size() == 4);
  CHECK(pair.specimen.counts().broken == 1);
}

TEST_CASE("joint under shear logs shear in all elements, with their places across its disk", "[dem][laws]")
{
  auto law         = mortar();
  law.rings        = 2;
  law.sectors      = 6;
  const auto found = logged(3, law, false);
  REQUIRE(found.size() == 12);
  Vector3d middle = Vector3d::Zero();
  double   area   = 0;
  for (const dem::Break &b : found)
    {
      CHECK(b.mode == dem::BreakMode::shear);
      middle += b.place / 12;
      area += b.area;
      CHECK(std::abs((b.place - found[0].place).dot(b.normal)) < 1e-9);
    }
  CHECK(area == Approx(section(3)));
  CHECK((middle - R * Vector3d(std::cos(0.7), std::sin(0.7), 0)).norm() < 2e-2 * R);
}

TEST_CASE("joints that never held are not logged", "[dem][laws]")
{
  auto law          = mortar();
  law.slit_fraction = 1;
  CHECK(logged(2, law, true).empty());
  CHECK(logged(3, law, false).empty());
}

TEST_CASE("log of what broke goes on after a restart, without a second entry of anything", "[dem][laws]")
{
  const auto made = [] {
    HeldPair     pair(2, mortar(4));
    const double unit = mortar().tensile_strength * 2 * R / mortar().effective_modulus / R;
    pair.drive(0, 0, 5 * unit, 3000);
    return pair;
  };
  HeldPair whole = made();
  whole.specimen.advance(3000);
  HeldPair first = made();
  first.specimen.advance(1500);
  MemoryState         memory;
  MemoryState::Writer writer(memory);
  first.specimen.visit_state(writer);
  HeldPair            second = made();
  MemoryState::Reader reader(memory);
  second.specimen.visit_state(reader);
  second.specimen.advance(1500);
  const auto one = whole.specimen.breaks(), two = second.specimen.breaks();
  REQUIRE(one.size() == two.size());
  for (std::size_t b = 0; b < one.size(); ++b)
    {
      CHECK(one[b].time == two[b].time);
      CHECK(one[b].place == two[b].place);
      CHECK(one[b].element == two[b].element);
    }
}

TEST_CASE("forces and moments of an isolated pair balance in every state: bonded, partly broken, sliding (T11)",
          "[dem][laws]")
{
  auto rubs                 = mortar(4);
  rubs.friction_coefficient = 0.5;
  for (const int dimension : {2, 3})
    for (const dem::LinkMaterials &law :
         {dem::LinkMaterials(rubs), dem::LinkMaterials(cement()), dem::LinkMaterials(spot())})
      {
        const double unit = rubs.tensile_strength * 2 * R / rubs.effective_modulus;
        HeldPair     pair(dimension, law, 0.4);
        double       largest = 0;
        // Pressed, bent until elements break, sheared until all slide.
        for (const auto &[opening, slip, bend] :
             {std::array<double, 3>{-0.3, 0.1, 0.1}, {0.2, 0.1, 3}, {-0.8, 40, 1}, {-0.2, -20, -2}})
          {
            pair.drive(opening * unit, slip * unit, bend * unit / R, 1000);
            for (int i = 0; i < 1000; i += 50)
              {
                pair.specimen.advance(50);
                const Vector3d one = pair.specimen.grips().reaction(0), two = pair.specimen.grips().reaction(1);
                const Vector3d origin = Vector3d::Zero();
                const Vector3d moment =
                  pair.specimen.grips().reaction_moment(0, origin) + pair.specimen.grips().reaction_moment(1, origin);
                largest = std::max(largest, one.norm());
                CHECK((one + two).norm() <= 1e-12 * largest);
                CHECK(moment.norm() <= 1e-12 * largest * 2 * R);
              }
          }
        CHECK(largest > 0);
      }
}

TEST_CASE("a pair answers the same whichever of the two comes first, and however it is turned (T12)", "[dem][laws]")
{
  // Strains of per cents, so that rounding of places is far below them.
  auto joint                 = mortar(4);
  joint.friction_coefficient = 0.5;
  joint.tensile_strength *= 100;
  joint.cohesion *= 100;
  auto bond = cement();
  bond.tensile_strength *= 100;
  bond.cohesion *= 100;
  struct Answer
  {
    std::vector<double> numbers;
    double              largest = 0;
  };
  const auto follow = [](const dem::LinkMaterials &law, const double angle, const bool swapped) {
    Answer       answer;
    const double unit    = 0.05 * R;
    dem::Packing packing = HeldPair::turned(angle);
    if (swapped)
      std::swap(packing.centre[0], packing.centre[1]);
    dem::Specimen     body(packing, in(2), law);
    const Vector3d    along(std::cos(angle), std::sin(angle), 0), across(-along.y(), along.x(), 0);
    const std::size_t first = swapped ? 1 : 0, second = 1 - first;
    for (const std::size_t i : {0, 1})
      {
        dem::Grip grip;
        grip.particles  = {i};
        grip.prescribed = all;
        body.grips().add(grip);
      }
    for (const auto &[opening, slip, bend] :
         {std::array<double, 3>{-0.3, 0.1, 0.1}, {0.2, 0.1, 3}, {-0.8, 10, 1}, {-0.2, -5, -2}})
      {
        const double time = 100 * body.time_step();
        body.grips().set_velocity(first, Vector3d::Zero(), Vector3d(0, 0, -0.5 * bend * unit / R / time));
        body.grips().set_velocity(second, unit * (opening * along + slip * across) / time,
                                  Vector3d(0, 0, 0.5 * bend * unit / R / time));
        for (int i = 0; i < 100; i += 5)
          {
            body.advance(5);
            const Vector3d force = body.grips().reaction(second);
            answer.numbers.insert(answer.numbers.end(),
                                  {force.dot(along), force.dot(across), body.grips().reaction_moment(second).z() / R});
            answer.largest = std::max(answer.largest, force.norm());
          }
      }
    answer.numbers.push_back(answer.largest * static_cast<double>(body.logged_breaks()));
    return answer;
  };
  for (const dem::LinkMaterials &law : {dem::LinkMaterials(joint), dem::LinkMaterials(bond)})
    {
      const Answer straight = follow(law, 0, false);
      REQUIRE(straight.largest > 0);
      CHECK(straight.numbers.back() > 0); // something breaks on the way
      for (const double angle : {0.0, 0.7, 2.0})
        for (const bool swapped : {false, true})
          {
            const Answer other = follow(law, angle, swapped);
            double       worst = 0;
            for (std::size_t k = 0; k < straight.numbers.size(); ++k)
              worst = std::max(worst, std::abs(other.numbers[k] - straight.numbers[k]) / straight.largest);
            INFO("angle " << angle << ", swapped " << swapped << ", differs by " << worst);
            CHECK(worst < 1e-12);
          }
    }
}

#include "dem/measures/couple_stress.h"
#include "dem/measures/stress.h"
#include "measures_fixture.h"

#include <catch2/catch.hpp>

using namespace measures_fixture;

namespace
{
  /** Table 4.1 of Stransky (2018): centre, right, left, top, bottom; the centre is linked to the four others. */
  struct Case
  {
    std::vector<Eigen::Vector3d> force  = std::vector<Eigen::Vector3d>(5, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> couple = std::vector<Eigen::Vector3d>(5, Eigen::Vector3d::Zero());
    Eigen::Matrix3d              stress = Eigen::Matrix3d::Zero(), couple_stress = Eigen::Matrix3d::Zero();
  };
  enum Place
  {
    centre,
    right,
    left,
    top,
    bottom
  };

  std::vector<Case> table_4_1()
  {
    const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    std::vector<Case>     c(8);
    c[1].force[right] = x, c[1].force[left] = -x, c[1].stress(0, 0) = 2;
    c[2].force[left] = -x, c[2].force[centre] = x, c[2].stress(0, 0) = 1;
    c[3].force[right] = y, c[3].force[left] = -y, c[3].force[top] = x, c[3].force[bottom] = -x;
    c[3].stress(0, 1) = c[3].stress(1, 0) = 2;
    c[4].couple[right] = z, c[4].couple[left] = -z, c[4].couple_stress(0, 2) = 2;
    c[5].couple[right] = z, c[5].couple[centre] = -z, c[5].couple_stress(0, 2) = 1;
    c[6].force[right] = y, c[6].force[left] = -y, c[6].couple[centre] = -2 * z, c[6].stress(0, 1) = 2;
    c[7].force[top] = x, c[7].force[centre] = -x, c[7].couple[centre] = z, c[7].stress(1, 0) = 1;
    return c;
  }

  /** The links' forces from equilibrium of the four outer particles: the star is statically determinate. */
  std::vector<dem::LinkLoad> links_of(const Case &c, const std::vector<Eigen::Vector3d> &place)
  {
    std::vector<dem::LinkLoad> links;
    for (int k = right; k <= bottom; ++k)
      {
        dem::LinkLoad l;
        l.first   = place[centre];
        l.branch  = place[k] - place[centre];
        l.contact = 0.5 * (place[k] + place[centre]);
        l.force   = c.force[k]; // the link pulls the outer particle with -f, which its load balances
        l.couple  = c.couple[k] - (l.contact - place[k]).cross(l.force);
        links.push_back(l);
      }
    return links;
  }
} // namespace

TEST_CASE("stress and couple stress are those of table 4.1, wherever the assembly lies", "[dem][measures]")
{
  for (const Eigen::Vector3d &shift : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3)})
    for (const Case &c : table_4_1())
      {
        std::vector<Eigen::Vector3d> place = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
        for (auto &x : place)
          x += shift;
        std::vector<dem::ExternalLoad> loads;
        for (int k = centre; k <= bottom; ++k)
          loads.push_back({place[k], c.force[k], c.couple[k]});
        const auto links = links_of(c, place);

        // Sums of some ten products of numbers below 4: round-off a few 1e-16 each.
        REQUIRE((dem::stress_moment(loads) - c.stress).norm() < 1e-14);
        REQUIRE((dem::stress_moment(links) - c.stress).norm() < 1e-14);
        REQUIRE((dem::couple_stress_moment(loads, shift) - c.couple_stress).norm() < 2e-14);
        REQUIRE((dem::couple_stress_moment(links, shift) - c.couple_stress).norm() < 2e-14);
      }
}

TEST_CASE("internal and external form of stress and couple stress agree in any equilibrium", "[dem][measures]")
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
      const Assembly        a = random_assembly(seed, 12, 40);
      const Eigen::Vector3d x0(0.3, -0.2, 0.7);
      const Eigen::Matrix3d stress = dem::stress_moment(a.loads), couple = dem::couple_stress_moment(a.loads, x0);
      REQUIRE(stress.norm() > 1);
      REQUIRE(couple.norm() > 1);
      REQUIRE((dem::stress_moment(a.links) - stress).norm() < 1e-13 * stress.norm());
      REQUIRE((dem::couple_stress_moment(a.links, x0) - couple).norm() < 1e-13 * couple.norm());
    }
}

TEST_CASE("the skew part of stress balances the outer couples", "[dem][measures]")
{
  // (4.44) of Stransky (2018): 1 x V sigma = sum l x f; (4.25): it is minus the sum of outer couples.
  const Assembly  a      = random_assembly(5, 9, 30);
  Eigen::Vector3d torque = Eigen::Vector3d::Zero(), couples = Eigen::Vector3d::Zero();
  for (const auto &l : a.links)
    torque += l.branch.cross(l.force);
  for (const auto &load : a.loads)
    couples += load.couple;
  const Eigen::Vector3d skew = dem::axial(dem::stress_moment(a.links));
  REQUIRE((skew - torque).norm() < 1e-14 * 30);
  REQUIRE((skew + couples).norm() < 1e-14 * 100);
}

TEST_CASE("couple stress does not depend on the origin of coordinates", "[dem][measures]")
{
  Assembly              a = random_assembly(3, 10, 30);
  const Eigen::Vector3d x0(0.1, 0.2, -0.4), shift(10, -20, 30);
  const Eigen::Matrix3d before = dem::couple_stress_moment(a.links, x0);
  for (auto &l : a.links)
    {
      l.first += shift;
      l.contact += shift;
    }
  // Places are some 40 units off: the round-off of products grows alike.
  REQUIRE((dem::couple_stress_moment(a.links, x0 + shift) - before).norm() < 1e-12 * before.norm());
}

TEST_CASE("periodic couple stress: the free form without crossing links, blind to images and origin", "[dem][measures]")
{
  const Assembly                   a = random_assembly(8, 10, 30);
  const Eigen::Vector3d            x0(0.1, 0.2, -0.4);
  std::vector<dem::LinkLoad>       links = a.links;
  std::vector<dem::ParticleMoment> moments;
  for (const auto &load : a.loads)
    moments.push_back({load.place, {0, 0, 0}});
  for (const auto &l : links) // moments of the forces alone
    for (auto &p : moments)
      {
        if (p.place == l.first)
          p.moment += (l.contact - l.first).cross(l.force);
        if ((p.place - l.second()).norm() < 1e-14)
          p.moment -= (l.contact - l.second()).cross(l.force);
      }
  const Eigen::Matrix3d free_form = dem::couple_stress_moment(links, x0);
  REQUIRE((dem::periodic_couple_stress_moment(links, moments, x0) - free_form).norm() < 1e-13 * free_form.norm());

  // The same cell written with another image of every third link, and about another origin.
  const Eigen::Vector3d shift(4, -5, 6), cell(3, 0, 0);
  for (std::size_t l = 0; l < links.size(); ++l)
    {
      const Eigen::Vector3d moved = shift + (l % 3 == 0 ? cell : Eigen::Vector3d(0, 0, 0));
      links[l].first += moved;
      links[l].contact += moved;
    }
  for (auto &p : moments)
    p.place += shift;
  const Eigen::Matrix3d again = dem::periodic_couple_stress_moment(links, moments, x0 + shift);
  REQUIRE((again - free_form).norm() < 1e-12 * free_form.norm());
}

TEST_CASE("mean stress refuses a volume that is not one", "[dem][measures]")
{
  REQUIRE(dem::stress_of(2 * Eigen::Matrix3d::Identity(), 4.0)(1, 1) == 0.5);
  REQUIRE_THROWS_AS(dem::stress_of(Eigen::Matrix3d::Identity(), 0.0), std::invalid_argument);
}

// What a link does depends on no other link that is updated beside it, so that copies have the bits of their originals: doc/theory/ranks.md, 3.
#include "clusters.h"
#include "dem/laws/smooth_joint.h"
#include "dem/specimen/core.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

using namespace shared_bodies;
using namespace weak_bonds;

namespace
{
  constexpr std::size_t particles = 200;

  /** Every link across the middle is cut by the joint. */
  dem::Packing cut_in_the_middle()
  {
    dem::Packing packing = bar(particles);
    for (std::size_t j = 0; j < packing.size(); ++j)
      for (std::size_t k = j + 1; k < packing.size(); ++k)
        if (const Vector3d &one = packing.centre[j], &other = packing.centre[k];
            one.x() * other.x() < 0 && (one - other).norm() < 1.2 * (packing.radius[j] + packing.radius[k]))
          packing.cuts.push_back({static_cast<std::int32_t>(j), static_cast<std::int32_t>(k), 0, 1e-6});
    return packing;
  }

  dem::SmoothJointParameters joint()
  {
    dem::SmoothJointParameters p;
    p.normal_stiffness     = 4e12;
    p.shear_stiffness      = 1.5e12;
    p.friction_coefficient = 0.6;
    p.dilation_angle       = 5;
    p.tensile_strength     = 1e6;
    p.cohesion             = 2e6;
    p.plane                = Vector3d(1, 0.2, 0.1).normalized();
    return p;
  }

  /** Links of each law where others of that law were: the line that each new one had. */
  std::vector<std::pair<std::size_t, std::size_t>> shuffled(const dem::LinkSet &links, dem::LinkSet &other)
  {
    const auto                            none = static_cast<std::int32_t>(particles); // lines of padding end there
    std::vector<std::vector<std::size_t>> of_law(links.laws());
    for (std::size_t k = 0; k < of_law.size(); ++k)
      {
        const std::size_t begin =
          links.first_block.empty() ? 0 : static_cast<std::size_t>(links.first_block[k]) * dem::links_per_block;
        const std::size_t end = links.first_block.empty() ?
                                  links.count :
                                  static_cast<std::size_t>(links.first_block[k + 1]) * dem::links_per_block;
        for (std::size_t l = begin; l < std::min(end, links.count); ++l)
          if (links.first[l] != none)
            of_law[k].push_back(l);
      }
    std::vector<std::size_t> counts;
    for (const auto &lines : of_law)
      counts.push_back(lines.size());
    const std::vector<std::size_t>                   first = other.resize_by_law(counts, particles);
    std::vector<std::pair<std::size_t, std::size_t>> came;
    std::mt19937                                     random(3);
    for (std::size_t k = 0; k < of_law.size(); ++k)
      {
        std::shuffle(of_law[k].begin(), of_law[k].end(), random);
        for (std::size_t n = 0; n < of_law[k].size(); ++n)
          {
            other.copy_line(links, of_law[k][n], first[k] + n);
            came.emplace_back(first[k] + n, of_law[k][n]);
          }
      }
    return came;
  }

  /** Update the links, in this order and in another. @return how many of them differ */
  std::size_t
  differing(dem::SpecimenCore &core, dem::LinkSet &links, const dem::LinkPass &pass, const dem::LinkLaw &law)
  {
    dem::LinkSet other = links.empty_like();
    const auto   came  = shuffled(links, other);
    other.per_second   = links.per_second;
    REQUIRE(came.size() >= links.alive);
    pass(links, core.particles, law, links.whole());
    pass(other, core.particles, law, other.whole());
    const auto row = [](const dem::LinkSet &set, const std::size_t l) {
      std::vector<double> numbers;
      set.get_history(l, numbers);
      numbers.insert(numbers.end(), &set.force[dem::record_size * l],
                     &set.force[dem::record_size * l] + dem::record_size);
      const Vector3d moment = set.moment_of(l);
      numbers.insert(numbers.end(), moment.data(), moment.data() + 3);
      return numbers;
    };
    std::size_t different = 0;
    for (const auto &[now, before] : came)
      different += links.is_alive(before) && row(links, before) != row(other, now);
    return different;
  }

  /** A specimen that a motion linear in place takes apart, or together. */
  dem::SpecimenCore taken(const dem::Packing            &packing,
                          const dem::SpecimenParameters &parameters,
                          const dem::LinkMaterials      &materials,
                          const double                   rate,
                          const double                   shear)
  {
    dem::SpecimenCore core(packing, parameters, materials, nullptr);
    for (std::size_t i = 0; i < packing.size(); ++i)
      for (int c = 0; c < 3; ++c)
        core.particles.velocity[dem::record_size * i + static_cast<std::size_t>(c)] =
          rate * core.particles.pose_of(i)[c] + (c == 1 ? shear * core.particles.pose_of(i)[0] : 0);
    core.begin();
    for (int step = 0; step < 100; ++step)
      core.step();
    return core;
  }
} // namespace

TEST_CASE("what a link does depends on no other link in its pack", "[dem][ranks]")
{
  omp_set_num_threads(1);
  const dem::LinkMaterials jointed = dem::LinkMaterials(point()).with_joints(std::vector{joint()});
  for (const auto &[materials, cut] :
       {std::pair(dem::LinkMaterials(cluster::concrete()), false), std::pair(dem::LinkMaterials(with_options()), false),
        std::pair(dem::LinkMaterials(parallel()), false), std::pair(dem::LinkMaterials(point()), false),
        std::pair(dem::LinkMaterials(flat()), false), std::pair(jointed, true)})
    {
      dem::SpecimenParameters p = cluster::bonded(1.2);
      p.step_factor             = 0.1;
      dem::SpecimenCore core    = taken(cut ? cut_in_the_middle() : bar(particles), p, materials, 2000, 8000);
      INFO(core.bond_law->name());
      const base::Column &remembered = core.bonds.history.front();
      REQUIRE((core.cracks.count() > 20 ||
               std::any_of(remembered.begin(), remembered.end(), [](const double number) { return number > 0; })));
      if (cut)
        REQUIRE(core.bonds.alive_by_law().back() > 20);
      CHECK(differing(core, core.bonds, core.bond_pass, *core.bond_law) == 0);
    }
}

TEST_CASE("what a contact does depends on no other contact in its pack", "[dem][ranks]")
{
  omp_set_num_threads(1);
  dem::LinearContactParameters lossy = grains::rough();
  lossy.restitution                  = 0.6;
  for (const dem::LinkMaterials &materials :
       {dem::LinkMaterials(grains::rough()), dem::LinkMaterials(lossy), dem::LinkMaterials(elastic_grains()),
        dem::LinkMaterials(cluster::concrete()), dem::LinkMaterials(with_options())})
    {
      dem::SpecimenParameters p = grains::falling();
      p.gravity.setZero();
      p.step_factor     = 0.1;
      const bool bonded = materials.bonds(p.physics)->bonds();
      if (bonded) // nearly all are to meet without a bond
        {
          p.interaction_ratio = 1.2;
          p.loose             = particles - 10;
        }
      dem::SpecimenCore core = taken(bar(particles), p, materials, bonded ? -10000 : -1000, 3000);
      INFO(core.contact_law->name());
      std::size_t pressed = 0, sheared = 0;
      for (std::size_t l = 0; l < core.contacts.count; ++l)
        {
          const Vector3d force(&core.contacts.force[dem::record_size * l]);
          const Vector3d along = branch_of(core.particles, core.contacts, l).normalized();
          pressed += force.norm() > 0;
          sheared += force.cross(along).norm() > 1e-3 * force.norm();
        }
      REQUIRE(pressed > 100);
      REQUIRE(sheared > 100);
      CHECK(differing(core, core.contacts, core.contact_pass, *core.contact_law) == 0);
    }
}

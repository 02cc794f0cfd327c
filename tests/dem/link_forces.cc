#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "reference_links.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

using Eigen::Vector3d;

namespace
{
  /** A choice of everything that a link kernel is compiled for. */
  struct Choice
  {
    int    dimension;
    bool   rotations, damage, friction, equal_radii;
    double shear_contribution;
    double turn; ///< largest rotation per step [rad]

    std::string words() const
    {
      std::ostringstream text;
      text << dimension << "D, rotations " << rotations << ", damage " << damage << ", friction " << friction
           << ", equal radii " << equal_radii << ", xi " << shear_contribution << ", turns up to " << turn;
      return text.str();
    }
  };

  dem::Packing small_packing(const Choice &choice)
  {
    dem::Packing packing = cluster::random_cluster(11, 30, choice.equal_radii ? 1e-3 : 0.5e-3, 1e-3);
    if (choice.dimension == 2)
      {
        packing = cluster::cubic_lattice(6, 5, 1, 1e-3);
        dem::UniformRandom random(3);
        for (std::size_t i = 0; i < packing.size(); ++i)
          {
            packing.centre[i] += 1e-4 * cluster::random_vector(random);
            packing.centre[i].z() = 0;
            if (!choice.equal_radii)
              packing.radius[i] *= 0.7 + 0.3 * random();
          }
      }
    return packing;
  }

  struct Difference
  {
    double force = 0, reaction = 0, damage = 0, strain = 0;
    bool   damaged = false, slid = false;
  };

  /** Drive a specimen and the reference with the same random motion, every particle held; the largest differences. */
  Difference compare(const Choice &choice)
  {
    const dem::Packing      packing = small_packing(choice);
    dem::SpecimenParameters p       = cluster::bonded(1.5);
    p.physics                       = {choice.dimension, choice.rotations, choice.damage, choice.friction, false};
    p.thickness                     = 2e-3;
    reference::Model model{cluster::concrete(), choice.damage, choice.friction};
    model.p.shear_contribution = choice.shear_contribution;
    model.p.relative_ductility = 300; // nothing breaks, however far it is sheared
    dem::Specimen       specimen(packing, p, model.p);
    reference::Assembly exact(packing, p.interaction_ratio, choice.dimension, p.thickness);
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        dem::Grip grip;
        grip.particles = {i};
        grip.prescribed.fill(true);
        specimen.grips().add(grip);
      }

    const double       dt = specimen.time_step(), scale = model.p.normal_modulus * 1e-4 * M_PI * 1e-6;
    dem::UniformRandom random(17);
    Difference         largest;
    for (int step = 0; step < 6; ++step)
      {
        std::vector<Vector3d> move(packing.size()), turn(packing.size());
        for (std::size_t i = 0; i < packing.size(); ++i)
          {
            move[i] = 0.15e-3 * 1e-3 * cluster::random_vector(random); // strains of the order of eps_0 and above
            turn[i] = choice.rotations ? Vector3d(choice.turn * cluster::random_vector(random)) : Vector3d::Zero();
            if (choice.dimension == 2)
              {
                move[i].z() = 0;
                turn[i].x() = turn[i].y() = 0;
              }
            specimen.grips().set_velocity(i, move[i] / dt, turn[i] / dt);
          }
        specimen.advance(1);
        exact.update(model);

        std::map<std::pair<std::size_t, std::size_t>, const reference::Link *> by_ends;
        std::vector<Vector3d>                                                  held(packing.size(), Vector3d::Zero());
        for (const auto &link : exact.links)
          {
            by_ends[{link.J, link.K}] = &link;
            held[link.J] -= link.force;
            held[link.K] += link.force;
            largest.damaged = largest.damaged || link.omega > 0.1;
            largest.slid    = largest.slid || (link.shear - link.elastic_shear).norm() > 1e-6;
          }
        const dem::LinkOutput out = specimen.links();
        REQUIRE(out.ends.size() == exact.links.size());
        for (std::size_t l = 0; l < out.ends.size(); ++l)
          {
            const auto   ends   = std::minmax(out.ends[l][0], out.ends[l][1]);
            const auto  &link   = *by_ends.at({ends.first, ends.second});
            const double normal = link.A * link.normal_stress, shear = link.A * link.shear_stress;
            largest.force  = std::max({largest.force, std::abs(out.normal_force[l] - normal) / scale,
                                       std::abs(out.shear_force[l] - shear) / scale});
            largest.damage = std::max(largest.damage, std::abs(out.damage[l] - link.omega));
            largest.strain = std::max(largest.strain, std::abs(out.normal_strain[l] - link.strain));
          }
        for (std::size_t i = 0; i < packing.size(); ++i)
          {
            largest.reaction = std::max(largest.reaction, (specimen.grips().reaction(i) - held[i]).norm() / scale);
            exact.bodies[i].displacement = move[i];
            exact.bodies[i].turn         = turn[i];
            exact.bodies[i].position += move[i];
          }
      }
    return largest;
  }
} // namespace

TEST_CASE("link forces are those of an independent computation for every choice of physics", "[dem]")
{
  for (const int dimension : {3, 2})
    for (const bool rotations : {true, false})
      for (const bool friction : {true, false})
        for (const bool equal_radii : {true, false})
          for (const double xi : {-1.0, 0.0, 0.6}) // below zero: no damage
            for (const double turn : {1e-4, 0.03}) // the series and the exact functions of rotation
              {
                if (!rotations && turn > 1e-3)
                  continue;
                const Choice choice{dimension, rotations, xi >= 0, friction, equal_radii, std::max(xi, 0.0), turn};
                INFO(choice.words());
                const Difference d = compare(choice);
                // Coordinates of 5e-3 m with 53 bits give strains of 2e-3 m links to 1e-15: forces to 1e-11 of A E eps_0, and
                // turns of 0.03 rad forces 300 times as large.
                CHECK(d.force < 1e-10 * std::max(1.0, turn / 1e-4));
                CHECK(d.reaction < 1e-9 * std::max(1.0, turn / 1e-4));
                CHECK(d.strain < 1e-14);
                CHECK(d.damage < 1e-9);
                CHECK(d.damaged == choice.damage);
                CHECK(d.slid == friction);
              }
}

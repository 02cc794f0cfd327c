#include "closed_system.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <vector>

using Eigen::Vector3d;

namespace
{
  double box_volume(const dem::ParticleOutput &out)
  {
    Eigen::Array3d low = Eigen::Array3d::Constant(1), high = -low;
    for (std::size_t i = 0; i < out.position.size(); ++i)
      {
        const Eigen::Array3d start = (out.position[i] - out.displacement[i]).array();
        low                        = low.min(start - out.radius[i]);
        high                       = high.max(start + out.radius[i]);
      }
    return (high - low).prod();
  }
} // namespace

TEST_CASE("turning and shifting a packing turns and shifts its motion", "[dem]")
{
  omp_set_num_threads(1);
  const dem::Packing    packing = cluster::random_cluster(61, 60, 0.5e-3, 1e-3);
  const Eigen::Matrix3d turn    = Eigen::AngleAxisd(1.1, Vector3d(0.3, -1, 0.5).normalized()).toRotationMatrix();
  dem::Specimen         here(packing, cluster::bonded(1.4), cluster::concrete());
  dem::Specimen         there(cluster::moved(packing, turn, Vector3d(1e-3, 2e-3, -1e-3)), cluster::bonded(1.4),
                              cluster::concrete());
  dem::UniformRandom    random(62);
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      const Vector3d v = 2 * cluster::random_vector(random), w = 1e3 * cluster::random_vector(random);
      here.set_velocity(i, v, w);
      there.set_velocity(i, turn * v, turn * w);
    }
  CHECK(there.time_step() == Approx(here.time_step()).epsilon(1e-12));
  here.advance(100);
  there.advance(100);
  const auto   a = here.particles(), b = there.particles();
  double       velocity = 0, spin = 0, fastest_spin = 0, stress = 0, largest_stress = 0, damage = 0, most_damage = 0;
  const double box = box_volume(a) / box_volume(b); // a particle's share of volume is one of the box along the axes
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      velocity       = std::max(velocity, (b.velocity[i] - turn * a.velocity[i]).norm());
      spin           = std::max(spin, (b.angular_velocity[i] - turn * a.angular_velocity[i]).norm());
      stress         = std::max(stress, (b.stress[i] - box * turn * a.stress[i] * turn.transpose()).norm());
      fastest_spin   = std::max(fastest_spin, a.angular_velocity[i].norm());
      largest_stress = std::max(largest_stress, a.stress[i].norm());
      damage         = std::max(damage, std::abs(b.damage[i] - a.damage[i]));
      most_damage    = std::max(most_damage, a.damage[i]);
    }
  CHECK(velocity < 1e-9 * 2);
  CHECK(spin < 1e-9 * fastest_spin);
  CHECK(stress < 1e-9 * largest_stress);
  CHECK(damage < 1e-9);
  CHECK(most_damage > 0.3);
}

TEST_CASE("symmetric body in symmetric motion stays symmetric while it softens", "[dem]")
{
  omp_set_num_threads(1);
  const int      n = 4;
  dem::Specimen  specimen(cluster::cubic_lattice(n, n, n, 1e-3), cluster::bonded(1.5), cluster::concrete());
  const auto     start  = specimen.particles().position;
  const Vector3d middle = Vector3d::Constant(1e-3 * (n - 1));
  for (std::size_t i = 0; i < start.size(); ++i)
    specimen.set_velocity(i, 500 * (start[i] - middle),
                          Vector3d::Zero()); // grows in all directions at a rate of 500 /s
  specimen.advance(300);
  REQUIRE(specimen.mean_damage() > 0.1);
  const auto out   = specimen.particles();
  double     error = 0;
  const auto at = [&](const int i, const int j, const int k) { return static_cast<std::size_t>(i + n * (j + n * k)); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        {
          const Vector3d u = out.displacement[at(i, j, k)], mirror = out.displacement[at(n - 1 - i, j, k)],
                         turned = out.displacement[at(j, k, i)];
          error                 = std::max(
                            {error, (Vector3d(-u.x(), u.y(), u.z()) - mirror).norm(), (Vector3d(u.y(), u.z(), u.x()) - turned).norm()});
        }
  CHECK(error < 1e-9 * out.displacement[0].norm());
}

namespace
{
  struct Fingerprint
  {
    dem::ParticleOutput particles;
    dem::LinkOutput     links;
    dem::EnergyAccount  energy;
    dem::Counts         counts;
  };

  Fingerprint run(const int threads, const double damping)
  {
    omp_set_num_threads(threads);
    auto p    = cluster::bonded(1.4);
    p.damping = damping;
    // More than one block of links (512) and of particles (256): with fewer, one thread would do it all.
    dem::Specimen specimen(cluster::colliding_clusters(300), p, cluster::concrete());
    cluster::set_colliding_velocities(specimen, 120);
    specimen.advance(250);
    const Fingerprint print{specimen.particles(), specimen.links(), specimen.energy(), specimen.counts()};
    omp_set_num_threads(1);
    return print;
  }

  bool same_bits(const std::vector<Vector3d> &a, const std::vector<Vector3d> &b)
  {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i)
      same = a[i] == b[i];
    return same;
  }
} // namespace

TEST_CASE("results are the same to the last bit with 1, 2 and 4 threads", "[dem]")
{
  for (const double damping : {0.0, 0.1})
    {
      const Fingerprint one = run(1, damping);
      CHECK(one.counts.broken > 100);
      CHECK(one.counts.contacts > 0);
      for (const int threads : {2, 4})
        {
          const Fingerprint many = run(threads, damping);
          CHECK(same_bits(one.particles.position, many.particles.position));
          CHECK(same_bits(one.particles.velocity, many.particles.velocity));
          CHECK(same_bits(one.particles.angular_velocity, many.particles.angular_velocity));
          CHECK(one.particles.damage == many.particles.damage);
          CHECK(one.links.ends == many.links.ends);
          CHECK(one.links.kind == many.links.kind);
          CHECK(one.links.normal_force == many.links.normal_force);
          CHECK(one.links.shear_force == many.links.shear_force);
          CHECK(one.links.damage == many.links.damage);
          CHECK(one.counts.neighbour_searches == many.counts.neighbour_searches);
          one.energy.each([&](const std::string_view name, const double value) {
            many.energy.each([&](const std::string_view other, const double compared) {
              if (name == other)
                {
                  INFO(name);
                  CHECK(value == compared);
                }
            });
          });
        }
    }
}

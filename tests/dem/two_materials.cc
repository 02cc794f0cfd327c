// Specimens of two materials in motion.
#include "two_materials.h"

#include "closed_system.h"
#include "dem/integrators/stable_step.h"
#include "dem/loading/uniaxial.h"
#include "dem/neighbours/cell_list.h"
#include "dem/specimen/specimen.h"
#include "dense_stiffness.h"
#include "memory_state.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, area = M_PI * r * r, E = 25e9, density = 4800;

  dem::CpmMaterials of_moduli(const double first, const double second, const double second_density = 0)
  {
    dem::CpmParameters a = cluster::concrete(), b = a;
    a.normal_modulus = first;
    b.normal_modulus = second;
    return dem::CpmMaterials({{"first", a, 0}, {"second", b, second_density}});
  }

  dem::SpecimenParameters lively()
  {
    auto p    = cluster::bonded(1.4);
    p.damping = 0.05;
    return p;
  }

  /** Two mixed clusters that tear each other apart. */
  dem::Specimen collision(const std::size_t particles_each, const dem::CpmMaterials &materials)
  {
    dem::Specimen specimen(cluster::mixed(cluster::colliding_clusters(particles_each), 34), lively(), materials);
    cluster::set_colliding_velocities(specimen, 120);
    return specimen;
  }

  MemoryState state_of(dem::Specimen &specimen)
  {
    MemoryState         memory;
    MemoryState::Writer writer(memory);
    specimen.visit_state(writer);
    return memory;
  }
} // namespace

TEST_CASE("every link and contact answers with the modulus of the pair that it joins", "[dem]")
{
  omp_set_num_threads(1);
  const double               moduli[] = {20e9, 60e9}, of_pair[] = {20e9, 40e9, 60e9};
  const dem::CpmMaterials    materials = of_moduli(moduli[0], moduli[1]);
  const dem::Packing         packing   = cluster::mixed(cluster::colliding_clusters(60), 34);
  dem::Specimen              specimen(packing, lively(), materials);
  std::array<std::size_t, 3> seen = {}, touching = {};
  cluster::set_colliding_velocities(specimen, 120);
  for (int sample = 0; sample < 10; ++sample)
    {
      specimen.advance(50);
      const dem::LinkOutput links = specimen.links();
      REQUIRE(links.pair.size() == links.ends.size());
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const std::int32_t sum = packing.material[links.ends[l][0]] + packing.material[links.ends[l][1]];
          REQUIRE(links.pair[l] == sum); // 0-0: 0, 1-0: 1, 1-1: 2
          if (links.kind[l] == dem::LinkOutput::broken || std::abs(links.normal_strain[l]) < 1e-6)
            continue;
          const double intact = links.normal_strain[l] > 0 ? 1 - links.damage[l] : 1.0;
          REQUIRE(links.normal_stress[l] == Approx(intact * of_pair[sum] * links.normal_strain[l])
                                              .epsilon(1e-9)
                                              .margin(1e-9 * of_pair[sum] * std::abs(links.normal_strain[l])));
          ++(links.kind[l] == dem::LinkOutput::contact ? touching : seen)[static_cast<std::size_t>(sum)];
        }
    }
  for (const std::size_t count : seen)
    CHECK(count > 10);
  CHECK(touching[1] > 0);
  CHECK(specimen.particles().material == packing.material);
}

TEST_CASE("one material declared twice gives the motion of one, to round-off", "[dem]")
{
  // Two kernels compute the same; which products the compiler fuses with a sum differs between them.
  omp_set_num_threads(1);
  for (const double smallest : {0.5 * r, r}) // radii that differ, and equal ones
    for (const double shear_contribution : {0.0, 0.6})
      {
        dem::CpmParameters once = cluster::concrete();
        once.shear_contribution = shear_contribution;
        const dem::CpmMaterials both({{"a", once, 0}, {"b", once, density}});
        const dem::Packing      packing = cluster::mixed(cluster::random_cluster(41, 120, smallest, r), 42);
        dem::Packing            plain   = packing;
        plain.material.clear();
        dem::Specimen one(plain, lively(), once), two(packing, lively(), both);
        CHECK(one.bytes() < two.bytes()); // materials, and the column of laws
        CHECK(one.time_step() == two.time_step());
        dem::UniformRandom random(43);
        for (std::size_t i = 0; i < packing.size(); ++i)
          {
            const Vector3d v = 5 * cluster::random_vector(random), w = 1e3 * cluster::random_vector(random);
            one.set_velocity(i, v, w);
            two.set_velocity(i, v, w);
          }
        one.advance(100);
        two.advance(100);
        const auto a = one.particles(), b = two.particles();
        double     velocity = 0;
        for (std::size_t i = 0; i < packing.size(); ++i)
          velocity = std::max(velocity, (a.velocity[i] - b.velocity[i]).norm());
        INFO("smallest radius " << smallest << ", shear contribution " << shear_contribution);
        CHECK(velocity < 1e-10 * 5); // of the first velocities
        CHECK(one.mean_damage() > 0.2);
        CHECK(two.mean_damage() == Approx(one.mean_damage()).epsilon(1e-11));
        CHECK(one.counts().broken == two.counts().broken);
        CHECK(two.energy().damage == Approx(one.energy().damage).epsilon(1e-10));
        CHECK(two.energy().friction == Approx(one.energy().friction).epsilon(1e-10));
        CHECK(a.material.empty());
      }
}

TEST_CASE("a wave that meets a stiffer or denser half of a bar is reflected and let through as impedances say", "[dem]")
{
  // Touching spheres in a row: impedance sqrt(k m). Velocities of the reflected and the transmitted wave over that of the incoming
  // one are (Z1 - Z2)/(Z1 + Z2) and 2 Z1/(Z1 + Z2). The pulse is long against the spheres, so that the one link with mean
  // constants at the interface and the dispersion of the lattice (both of second order in spheres over pulse) hardly show.
  omp_set_num_threads(1);
  struct Case
  {
    double stiffer, denser;
  };
  for (const Case c : {Case{4, 1}, Case{1, 4}, Case{4, 4}, Case{0.25, 1}})
    {
      const int    n = 800, interface = 300, start = 150, width = 20;
      dem::Packing bar = cluster::cubic_lattice(n, 1, 1, r);
      for (int i = 0; i < n; ++i)
        bar.material.push_back(i < interface ? 0 : 1);
      auto          p = cluster::elastic(cluster::next_neighbours());
      dem::Specimen specimen(bar, p, of_moduli(E, c.stiffer * E, c.denser * density));
      const double  v = 1e-3;
      for (int i = 0; i < n; ++i) // half of it goes either way
        specimen.set_velocity(i, 2 * v * std::exp(-std::pow((i - start) / double(width), 2) / 2) * Vector3d::UnitX(),
                              Vector3d::Zero());
      const double mass               = density * 4.0 / 3.0 * M_PI * r * r * r,
                   spheres_per_second = std::sqrt(E * area / (2 * r) / mass);
      specimen.advance(std::llround((interface - start + 80) / spheres_per_second / specimen.time_step()));
      const auto out     = specimen.particles();
      const auto extreme = [&](const int from, const int to) {
        double largest = 0;
        for (int i = from; i < to; ++i)
          if (std::abs(out.velocity[static_cast<std::size_t>(i)].x()) > std::abs(largest))
            largest = out.velocity[static_cast<std::size_t>(i)].x();
        return largest;
      };
      const double z = std::sqrt(c.stiffer * c.denser); // second over first
      INFO("stiffer " << c.stiffer << ", denser " << c.denser);
      CHECK(extreme(interface - 80 - 40, interface) == Approx(v * (1 - z) / (1 + z)).epsilon(0.02).margin(0.01 * v));
      CHECK(extreme(interface + 1, n) == Approx(v * 2 / (1 + z)).epsilon(0.02));
    }
}

TEST_CASE("critical step of a chain of two materials is that of its three masses", "[dem]")
{
  // lambda^2 - lambda (k1 (1/m1 + 1/m2) + k2 (1/m2 + 1/m3)) + k1 k2 (m1 + m2 + m3)/(m1 m2 m3) = 0
  omp_set_num_threads(1);
  dem::Packing packing = cluster::cubic_lattice(3, 1, 1, r);
  packing.material     = {0, 0, 1};
  auto p               = cluster::elastic(cluster::next_neighbours());
  p.physics.rotations  = false;
  const dem::Specimen body(packing, p, of_moduli(E, 7 * E, 3 * density));
  const double        m = density * 4.0 / 3.0 * M_PI * r * r * r, m3 = 3 * m, k1 = E * area / (2 * r), k2 = 4 * k1;
  const double        b = k1 * (2 / m) + k2 * (1 / m + 1 / m3), c = k1 * k2 * (2 * m + m3) / (m * m * m3);
  CHECK(body.critical_step() == Approx(2 / std::sqrt((b + std::sqrt(b * b - 4 * c)) / 2)).epsilon(1e-9));
  CHECK(body.particles().mass[2] == Approx(m3).epsilon(1e-14));
}

TEST_CASE("per-particle step stays below the critical one at a stiffness contrast of 1000", "[dem]")
{
  omp_set_num_threads(1);
  for (const bool rotations : {true, false})
    for (const double contrast : {1000.0, 0.001})
      for (std::uint64_t seed = 71; seed < 75; ++seed)
        {
          const dem::ParticleShape shape{3, density, 0};
          const auto               law = dem::LinkMaterials(of_moduli(E, contrast * E)).bonds(dem::Physics());
          const dem::Packing       packing =
            cluster::mixed(cluster::random_cluster(seed, 25, seed % 2 ? r : 0.3 * r, r), seed);
          dem::Particles        particles = dem::make_particles(packing, shape, rotations);
          dem::LinkSet          links;
          std::vector<Vector3d> centre;
          std::vector<double>   radius;
          for (std::size_t i = 0; i < packing.size(); ++i)
            {
              centre.push_back(particles.position_of(i));
              radius.push_back(particles.radius_of(i));
            }
          dem::make_links(links, dem::find_pairs(centre, radius, 1.5, 0.0, std::nullopt), particles, shape, *law);
          const double exact = dense::critical_step(particles, links, *law, rotations);
          CHECK(dem::critical_step(particles, {{links, *law}}, rotations) == Approx(exact).epsilon(1e-9));
          const double bound = dem::stable_step(particles, {{links, *law}}, rotations);
          CHECK(bound <= exact);
          CHECK(bound > 0.4 * exact); // and is of use
        }
}

TEST_CASE("two materials give the same bits with 1, 2 and 4 threads, and after a restart", "[dem]")
{
  const auto materials = cluster::mortar_and_aggregate(2600);
  omp_set_num_threads(1);
  dem::Specimen straight = collision(300, materials);
  straight.advance(300);
  CHECK(straight.counts().broken > 100);
  CHECK(straight.counts().contacts > 0);
  const MemoryState end = state_of(straight);
  for (const int threads : {2, 4})
    {
      omp_set_num_threads(threads);
      dem::Specimen many = collision(300, materials);
      many.advance(300);
      CHECK(state_of(many) == end);
    }
  omp_set_num_threads(1);
  dem::Specimen first = collision(300, materials);
  first.advance(130);
  const MemoryState   half   = state_of(first);
  dem::Specimen       second = collision(300, materials);
  MemoryState::Reader reader(half);
  second.visit_state(reader);
  second.advance(170);
  CHECK(state_of(second) == end);
}

TEST_CASE("energy of a specimen of two materials balances while it damages, slides and breaks", "[dem]")
{
  omp_set_num_threads(1);
  for (const double shear_contribution : {0.0, 0.5}) // of one of the two
    {
      dem::CpmMaterials materials                     = cluster::mortar_and_aggregate();
      materials.list[1].parameters.shear_contribution = shear_contribution;
      auto p                                          = cluster::bonded(1.5);
      p.damping                                       = 0.3;
      dem::Specimen           body(cluster::mixed(cluster::cubic_lattice(4, 4, 8, r), 51), p, materials);
      dem::UniaxialParameters pull;
      pull.strain_rate     = 2;
      pull.grips.thickness = 0.5 * r;
      pull.stop_strain     = 5e-3;
      dem::UniaxialTest test(body, pull);
      double            before = 0;
      for (int i = 0; i < 40; ++i)
        {
          test.advance(50);
          const auto energy = body.energy();
          CHECK(energy.balance_error() < 1e-3);
          CHECK(energy.damage >= before);
          before = energy.damage;
        }
      const auto energy = body.energy();
      INFO("shear contribution " << shear_contribution);
      CHECK(energy.damage > 0.3 * energy.external_work);
      CHECK(energy.friction > 0);
    }
}

TEST_CASE("turning and shifting a packing of two materials turns and shifts its motion", "[dem]")
{
  omp_set_num_threads(1);
  const dem::Packing    packing   = cluster::mixed(cluster::random_cluster(61, 60, 0.5e-3, 1e-3), 62);
  const Eigen::Matrix3d turn      = Eigen::AngleAxisd(1.1, Vector3d(0.3, -1, 0.5).normalized()).toRotationMatrix();
  const auto            materials = cluster::mortar_and_aggregate(2600);
  dem::Specimen         here(packing, cluster::bonded(1.4), materials);
  dem::Specimen      there(cluster::moved(packing, turn, Vector3d(1e-3, 2e-3, -1e-3)), cluster::bonded(1.4), materials);
  dem::UniformRandom random(63);
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      const Vector3d v = 2 * cluster::random_vector(random), w = 1e3 * cluster::random_vector(random);
      here.set_velocity(i, v, w);
      there.set_velocity(i, turn * v, turn * w);
    }
  CHECK(there.time_step() == Approx(here.time_step()).epsilon(1e-12));
  here.advance(100);
  there.advance(100);
  const auto a = here.particles(), b = there.particles();
  double     velocity = 0, damage = 0, most_damage = 0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      velocity    = std::max(velocity, (b.velocity[i] - turn * a.velocity[i]).norm());
      damage      = std::max(damage, std::abs(b.damage[i] - a.damage[i]));
      most_damage = std::max(most_damage, a.damage[i]);
    }
  CHECK(velocity <
        1e-9 * 2); // of the largest velocities, about 2 m/s: round-off of turned places, amplified by 100 steps
  CHECK(damage < 1e-9);
  CHECK(most_damage > 0.2);
}

TEST_CASE("a periodic cell of two materials has the stress of its links, and its stiffness follows them", "[dem]")
{
  // Layers of a cubic lattice along z, A A B B and again: columns of links A-A, A-B, B-B, A-B in series under a strain along z.
  omp_set_num_threads(1);
  dem::Packing packing  = cluster::cubic_lattice(2, 2, 4, r);
  packing.periodic_cell = Vector3d(4 * r, 4 * r, 8 * r);
  for (const auto &x : packing.centre)
    packing.material.push_back(x.z() < 3 * r ? 0 : 1);
  auto p             = cluster::elastic(cluster::next_neighbours());
  p.physics.periodic = true;
  p.damping          = 0.3;
  dem::Specimen body(packing, p, of_moduli(E, 3 * E));
  // Affine: every link strained alike, so the mean of E, 2E, 3E, 2E; along x half of the layers are E, half 3 E.
  const double lattice = M_PI / 4; // doc/theory/homogenisation.md, 5
  CHECK(body.affine_stiffness()(2, 2) == Approx(lattice * 2 * E).epsilon(1e-12));
  CHECK(body.affine_stiffness()(0, 0) == Approx(lattice * 2 * E).epsilon(1e-12));
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
  rate(2, 2)           = 0.1;
  body.set_velocity_gradient(rate);
  while (body.time() * rate(2, 2) < 1e-5)
    body.advance(1);
  body.set_velocity_gradient(Eigen::Matrix3d::Zero());
  body.set_damping(0.7);
  body.advance(3000); // to rest: links in series
  const double strain = body.cell().deformation(2, 2) - 1;
  const double series = 4 / (1 / E + 1 / (2 * E) + 1 / (3 * E) + 1 / (2 * E));
  CHECK(body.cell().stress(2, 2) == Approx(lattice * series * strain).epsilon(1e-4)); // geometry: the strain itself
}

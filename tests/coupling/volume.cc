// Particles inside a solid: what the handshake keeps, whatever its method.
#include "tests/coupling/volume_fixture.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <memory>

using namespace volume;

namespace
{
  /**
   * Of particles and nodes from a motion as a whole, over its largest velocity, after some steps. That part is measured which changes its sign with the
   * motion: a turn of elements of small displacements strains them in second order.
   */
  template <int dim>
  double distance_from_motion(const coupling::VolumeCouplingParameters &method,
                              const int                                 steps,
                              const Vector3d                           &v,
                              const Vector3d                           &spin)
  {
    std::vector<Vector3d> places, velocities;
    for (const double sign : {1.0, -1.0})
      {
        Bar<dim> bar(method);
        bar.set_velocity([&](const Vector3d &place) -> Vector3d { return sign * (v + spin.cross(place)); }, sign *spin);
        places.clear();
        std::size_t next        = 0;
        const auto  check_ratio = [&](const Vector3d &place, const Vector3d &velocity) {
          places.push_back(place);
          if (sign > 0)
            velocities.push_back(0.5 * velocity);
          else
            velocities[next++] -= 0.5 * velocity;
        };
        const dem::Packing at_rest = Bar<dim>::packing();
        bar.advance(steps);
        for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
          check_ratio(at_rest.centre[i], bar.particles.particle(i).velocity);
        for (std::size_t i = 0; i < bar.participant->carriers(); ++i)
          check_ratio(bar.participant->place(i), bar.participant->velocity(i));
      }
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const Vector3d wanted = v + spin.cross(places[k]);
        worst                 = std::max(worst, (velocities[k] - wanted).norm());
        largest               = std::max(largest, wanted.norm());
      }
    return worst / largest;
  }

  template <int dim>
  void check_motion_as_a_whole()
  {
    const Vector3d v(1.2, -0.7, dim == 3 ? 0.4 : 0.0), spin(dim == 3 ? 0.3 : 0.0, dim == 3 ? -0.8 : 0.0, 1.1);
    for (const auto &[name, method] : methods())
      {
        INFO(name);
        if (method.method == VolumeMethod::multipliers) // constrained particles start at rest
          CHECK(distance_from_motion<dim>(method, 50, v, Vector3d::Zero()) <= 1e-10);
        CHECK(distance_from_motion<dim>(method, 3, Vector3d::Zero(), spin) <= 1e-10);
      }
  }

  template <int dim>
  void check_what_is_kept()
  {
    for (const auto &[name, method] : methods())
      {
        INFO(name);
        Bar<dim> bar(method);
        bar.set_velocity(Bar<dim>::noise);
        bar.advance(5); // velocities at the start do not obey what ties both sides
        const coupling::VolumeBalance before = bar.coupled->balance();
        const Vector3d                start  = bar.momentum();
        const double                  energy = bar.energy();
        double                        scale  = 0;
        for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
          scale += bar.particles.particle(i).mass * bar.particles.particle(i).velocity.norm();
        const auto residual = [&] {
          const fem::ExplicitEnergy e = bar.motion->energy();
          return e.start + e.external - e.kinetic - e.internal;
        };
        const double residual_of_solid = residual();
        bar.advance(300);
        CHECK((bar.momentum() - start).norm() <= 1e-10 * scale);
        const coupling::VolumeBalance &b = bar.coupled->balance();
        CHECK((b.to_particles + b.to_solid).norm() <= 1e-10 * scale);
        CHECK((b.turn_to_particles + b.turn_to_solid).norm() <= 1e-10 * scale * Bar<dim>::own_length);
        // Either side accounts for what the other gives; and both of them for the same.
        CHECK(std::fabs(bar.particles.energy().residual()) <= 1e-6 * energy);
        CHECK(std::fabs(residual() - residual_of_solid) <= 1e-9 * energy);
        const double made = b.spurious() - before.spurious();
        if (method.lumped) // takes energy
          CHECK(made < 0);
        else
          CHECK(std::fabs(made) <= 1e-10 * energy);
        if (method.absorbs)
          CHECK(b.absorbed > 0.05 * energy);
        else
          CHECK(b.absorbed == 0);
      }
  }
} // namespace

TEST_CASE("volume coupling: a body that moves as a whole passes the overlap unseen, in the plane and in space",
          "[coupling][volume]")
{
  check_motion_as_a_whole<2>();
  check_motion_as_a_whole<3>();
}

TEST_CASE(
  "volume coupling: momentum, angular momentum and power are equal on both sides, energy is kept or its error reported",
  "[coupling][volume]")
{
  check_what_is_kept<2>();
  check_what_is_kept<3>();
}

namespace
{
  /** Particles of no order, and nodes at the corners of one cube around them. */
  struct IrregularCube
  {
    static constexpr int count = 400;

    coupling::AbsorberCarriers carriers;
    coupling::WeightRows       weights{count, 8};
    coupling::CarrierRows      inverse_node_masses{8, 3};

    IrregularCube()
    {
      carriers.whole_mass.resize(count);
      carriers.damping.resize(count);
      carriers.inverse_mass.resize(count, 3);
      std::vector<Eigen::Triplet<double>> entries;
      for (int i = 0; i < count; ++i)
        {
          const double   k = i + 1;
          const Vector3d place(std::fmod(0.754877666 * k, 1.0), std::fmod(0.569840291 * k, 1.0),
                               std::fmod(0.438579 * k * k, 1.0));
          carriers.places.push_back(place);
          carriers.whole_mass[i] = 1 + 0.5 * std::sin(k);
          carriers.damping[i]    = 0.3 * carriers.whole_mass[i] * place.x();
          carriers.inverse_mass.row(i).setConstant(1 / (carriers.whole_mass[i] * (1.01 - place.x())));
          for (int c = 0; c < 8; ++c)
            entries.emplace_back(i, c, weight(c, place));
        }
      weights.setFromTriplets(entries.begin(), entries.end());
      inverse_node_masses.setConstant(1.0 / 30);
      carriers.point_mass.resize(0);
      carriers.weights.resize(0, 8);
      carriers.inverse_node_mass = inverse_node_masses;
    }

    static Vector3d corner(const int k) { return Vector3d(k & 1, (k >> 1) & 1, (k >> 2) & 1); }

    static double weight(const int k, const Vector3d &place)
    {
      const Vector3d at = corner(k);
      double         w  = 1;
      for (int d = 0; d < 3; ++d)
        w *= at[d] > 0 ? place[d] : 1 - place[d];
      return w;
    }

    /** Translation, rotation and even strain at once [m/s]. */
    static Vector3d even(const Vector3d &place)
    {
      Eigen::Matrix3d gradient;
      gradient << 0.3, -1.2, 0.5, 0.8, -0.1, 0.2, -0.6, 0.4, 0.9;
      return Vector3d(0.7, -0.4, 1.1) + gradient * place;
    }

    coupling::CarrierRows even_of_particles() const
    {
      coupling::CarrierRows rows(count, 3);
      for (int i = 0; i < count; ++i)
        rows.row(i) = even(carriers.places[static_cast<std::size_t>(i)]);
      return rows;
    }

    static coupling::CarrierRows even_of_nodes()
    {
      coupling::CarrierRows rows(8, 3);
      for (int c = 0; c < 8; ++c)
        rows.row(c) = even(corner(c));
      return rows;
    }

    static coupling::CarrierRows noise()
    {
      coupling::CarrierRows rows(count, 3);
      for (int i = 0; i < count; ++i)
        rows.row(i) << std::sin(12.9898 * i), std::cos(78.233 * i), std::sin(37.7 * i + 1);
      return rows;
    }

    double kinetic(const coupling::CarrierRows &v) const
    {
      return 0.5 * v.cwiseProduct(carriers.inverse_mass.cwiseInverse()).cwiseProduct(v).sum();
    }
  };
} // namespace

TEST_CASE("volume coupling: multipliers and absorber leave translation, rotation and even strain alone",
          "[coupling][volume]")
{
  const IrregularCube               cube;
  const coupling::CarrierRows       particles = cube.even_of_particles(), nodes = IrregularCube::even_of_nodes();
  const coupling::FineScaleAbsorber absorber({0.2, 3}, cube.carriers);
  CHECK(absorber.changes(particles, nodes, 5).particles.norm() <= 1e-10 * particles.norm());
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(IrregularCube::count), strict;
  for (const Eigen::VectorXd &parts : {alike, strict})
    for (const bool lumped : {false, true})
      {
        const coupling::Multipliers ties(cube.weights, cube.carriers.inverse_mass, cube.inverse_node_masses, parts,
                                         lumped);
        const auto                  change = ties.changes(particles, nodes);
        CHECK(change.particles.norm() + change.nodes.norm() <= 1e-10 * particles.norm());
      }
}

TEST_CASE("volume coupling: in an absorber what is irregular loses energy, and no momentum, whatever the time",
          "[coupling][volume]")
{
  const IrregularCube               cube;
  const coupling::CarrierRows       noise = IrregularCube::noise(), rest = coupling::CarrierRows::Zero(8, 3);
  const coupling::FineScaleAbsorber absorber({0.2, 3}, cube.carriers);
  for (const double time : {0.01, 1.0, 30.0})
    {
      const auto change = absorber.changes(noise, rest, time);
      CHECK(cube.kinetic(noise + change.particles) < cube.kinetic(noise));
      const coupling::CarrierRows impulse = change.particles.cwiseQuotient(cube.carriers.inverse_mass);
      CHECK(impulse.colwise().sum().norm() <= 1e-10 * impulse.norm());
      Vector3d turn = Vector3d::Zero();
      for (int i = 0; i < IrregularCube::count; ++i)
        turn += cube.carriers.places[static_cast<std::size_t>(i)].cross(Vector3d(impulse.row(i)));
      CHECK(turn.norm() <= 1e-10 * impulse.norm());
    }
}

TEST_CASE("volume coupling: multipliers leave nothing of what they forbid, and are the smallest impulses that do",
          "[coupling][volume]")
{
  const IrregularCube         cube;
  const coupling::CarrierRows noise = IrregularCube::noise(), even = IrregularCube::even_of_nodes();
  const coupling::Multipliers ties(cube.weights, cube.carriers.inverse_mass, cube.inverse_node_masses,
                                   Eigen::VectorXd::Ones(IrregularCube::count), false);
  const auto                  change = ties.changes(noise, even);
  const coupling::CarrierRows v = noise + change.particles, nodes = even + change.nodes;
  const coupling::CarrierRows left = cube.weights.transpose() * (v - cube.weights * nodes);
  CHECK(left.norm() <= 1e-9 * (cube.weights.transpose() * noise).norm());
  // Orthogonal, in the masses, to all that obeys.
  const auto again = ties.changes(change.particles, change.nodes);
  CHECK((again.particles + change.particles).norm() <= 1e-9 * change.particles.norm());
}

TEST_CASE("volume coupling: S10, a solid a hundred times as soft, fifty steps of particles in one: energy never grows",
          "[coupling][volume][slow]")
{
  for (const auto &[name, method] : methods())
    if (method.method == VolumeMethod::multipliers)
      {
        INFO(name);
        // A fifth of the stable step of the particles: fifty of them in one of the solid.
        Bar<2> bar(method, {0.2, 50, 100, 1.5, {}, {}, {}});
        bar.set_velocity(Bar<2>::noise);
        bar.advance(5);
        const double energy = bar.energy(), made = bar.coupled->balance().spurious();
        double       most = 0;
        while (bar.particles.steps() < 100000)
          {
            const auto taken = bar.both->advance(1);
            REQUIRE(taken.particles >= 40);
            most = std::max(most, bar.coupled->balance().spurious() - made);
          }
        CHECK(most <= 1e-3 * energy);
        CHECK(bar.energy() <= 1.001 * energy);
      }
}

TEST_CASE("volume coupling: a million steps close to the critical one neither make nor lose energy",
          "[coupling][volume][slow]")
{
  Bar<2> bar(tied(Compatibility::coarse), {0.99, 1, 1, 1.5, {}, {}, {}});
  bar.set_velocity(Bar<2>::noise);
  bar.advance(5);
  const double energy = bar.energy(), made = bar.coupled->balance().spurious();
  for (int block = 0; block < 100; ++block)
    {
      bar.advance(10000);
      REQUIRE(std::fabs(bar.coupled->balance().spurious() - made) <= 1e-6 * energy);
      REQUIRE(std::fabs(bar.particles.energy().residual()) <= 1e-3 * energy);
    }
}

TEST_CASE(
  "volume coupling: in a hundred thousand steps both sides, what is absorbed and what is made add up, by every method",
  "[coupling][volume][slow]")
{
  for (const auto &[name, method] : methods())
    {
      INFO(name);
      Bar<2> bar(method);
      bar.set_velocity(Bar<2>::noise);
      bar.advance(5);
      const auto whole = [&] {
        const coupling::VolumeBalance &b = bar.coupled->balance();
        return bar.energy() + b.absorbed - b.spurious();
      };
      // The two sides know their energies at times that are not the same: what counts is the mean over many steps.
      const auto mean = [&] {
        constexpr int steps = 2000;
        double        sum   = 0;
        for (int s = 0; s < steps; ++s)
          {
            bar.advance(1);
            sum += whole();
          }
        return sum / steps;
      };
      const double energy = bar.energy(), all = mean();
      double       worst = 0;
      while (bar.particles.steps() < 100000)
        worst = std::max(worst, std::fabs(mean() - all));
      CHECK(worst <= 1e-3 * energy);
    }
}

TEST_CASE("volume coupling: a million steps close to the critical one never add energy, with an absorber",
          "[coupling][volume][slow]")
{
  Bar<2> bar(tied(Compatibility::coarse, false, true), {0.99, 1, 1, 1.5, {}, {}, {}});
  bar.set_velocity(Bar<2>::noise);
  bar.advance(5);
  const double energy = bar.energy();
  for (int block = 0; block < 100; ++block)
    {
      bar.advance(10000);
      REQUIRE(bar.energy() <= 1.001 * energy);
    }
}

TEST_CASE("volume coupling: the same bits with 1 and 2 threads, and after a restart", "[coupling][volume]")
{
  const auto run = [](const int threads, const bool restart) {
    omp_set_num_threads(threads);
    Bar<3> bar(tied(Compatibility::coarse, false, true));
    bar.set_velocity(Bar<3>::noise);
    bar.advance(40);
    Bar<3> fresh(tied(Compatibility::coarse, false, true));
    if (restart)
      {
        MemoryState         memory;
        MemoryState::Writer writer(memory);
        bar.particles.visit_state(writer);
        bar.both->visit_state(writer);
        MemoryState::Reader reader(memory);
        fresh.particles.visit_state(reader);
        fresh.both->visit_state(reader);
        fresh.motion->restore(bar.motion->state());
      }
    Bar<3> &on = restart ? fresh : bar;
    on.advance(40);
    std::vector<double> all;
    for (std::size_t i = 0; i < on.particles.counts().particles; ++i)
      for (int c = 0; c < 3; ++c)
        all.push_back(on.particles.particle(i).velocity[c]);
    for (std::size_t i = 0; i < on.participant->carriers(); ++i)
      for (int c = 0; c < 3; ++c)
        all.push_back(on.participant->velocity(i)[c]);
    return all;
  };
  const auto once = run(1, false);
  CHECK(once == run(2, false));
  omp_set_num_threads(1);
  CHECK(once == run(1, true));
}

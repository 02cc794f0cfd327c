#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "reference_links.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <sstream>
#include <vector>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3, density = 4800;
  const double mass = density * 4.0 / 3.0 * M_PI * r * r * r, inertia = 0.4 * mass * r * r;

  /** Phase by which leap-frog turns an oscillation of circular frequency w in a step: sin(phase/2) = w dt/2. */
  double discrete_phase(const double w, const double dt) { return 2 * std::asin(0.5 * w * dt); }
} // namespace

TEST_CASE("two bonded spheres vibrate along their link with the period of leap-frog", "[dem]")
{
  // 2 pi sqrt(m/(2 k_N)) for a small step; exactly, u(n) = v dt sin(n phase)/sin(phase) from u = 0, v = v(1/2).
  omp_set_num_threads(1);
  const double distance = 2.4e-3, velocity = 1e-6;
  const double k_N = 25e9 * M_PI * r * r / distance, w = std::sqrt(2 * k_N / mass);
  for (const double factor : {0.05, 0.8})
    {
      auto p        = cluster::elastic(cluster::bonded(1.5));
      p.step_factor = factor;
      dem::Specimen specimen(cluster::pair_of_spheres(r, r, distance), p, cluster::concrete());
      specimen.set_velocity(0, {-velocity / 2, 0, 0}, Vector3d::Zero());
      specimen.set_velocity(1, {+velocity / 2, 0, 0}, Vector3d::Zero());
      const double dt = specimen.time_step(), phase = discrete_phase(w, dt);
      const double amplitude = velocity * dt / std::sin(phase);
      double       largest   = 0;
      const int    steps     = static_cast<int>(3 * 2 * M_PI / phase);
      for (int n = 1; n <= steps; ++n)
        {
          specimen.advance(1);
          const auto x = specimen.particles().displacement;
          largest      = std::max(largest, std::abs(x[1].x() - x[0].x() - amplitude * std::sin(n * phase)));
        }
      // Amplitude 1e-12 m: coordinates of 2e-3 m are rounded to 4e-19 m each step.
      CHECK(amplitude > 1e-13);
      CHECK(largest < steps * 1e-18);
      if (factor < 0.1) // and the period itself: leap-frog is off by (w dt)^2/24
        CHECK(2 * M_PI / phase * dt == Approx(2 * M_PI * std::sqrt(mass / (2 * k_N))).epsilon(w * dt * w * dt / 20));
    }
}

TEST_CASE("two bonded spheres vibrate across their link with spin and translation coupled", "[dem]")
{
  // Slip s = u_K - u_J - L theta of equal spins theta: s'' = -k_T (2/m + L^2/(2 I)) s. Angular momentum zero keeps the pair from
  // turning as a whole.
  omp_set_num_threads(1);
  const double distance = 2.4e-3, slip_velocity = 1e-4;
  const double k_T = 5e9 * M_PI * r * r / distance;
  const double w   = std::sqrt(k_T * (2 / mass + distance * distance / (2 * inertia)));
  // m L/2 v_rel + 2 I w = 0 and v_rel - L w = slip velocity
  const double spin  = -slip_velocity / (distance + 4 * inertia / (mass * distance)),
               v_rel = slip_velocity + distance * spin;
  auto          p    = cluster::elastic(cluster::bonded(1.5));
  dem::Specimen specimen(cluster::pair_of_spheres(r, r, distance), p, cluster::concrete());
  specimen.set_velocity(0, {0, -v_rel / 2, 0}, {0, 0, spin});
  specimen.set_velocity(1, {0, +v_rel / 2, 0}, {0, 0, spin});
  const double dt = specimen.time_step(), phase = discrete_phase(w, dt);
  double       largest = 0;
  for (int n = 0; n < 60; ++n)
    {
      specimen.advance(1);
      const double slip =
        slip_velocity * dt * std::sin(n * phase) / std::sin(phase); // force is that of the step's start
      largest = std::max(largest, std::abs(specimen.links().shear_force[0] - std::abs(k_T * slip)));
    }
  // Amplitude 2e-11 m of 2.4e-3 m: the branch turns by 1e-8, its square is beyond double precision; round-off 1e-19 m a step.
  CHECK(largest < 60 * 1e-18 * k_T);
}

namespace
{
  struct Choice
  {
    int    dimension;
    bool   rotations, equal_radii;
    double damping;
  };

  /** The leap-frog step of doc/theory/integration.md, 1, particle by particle, on the reference links. */
  class ReferenceMotion
  {
  public:
    ReferenceMotion(const dem::Packing &packing, const Choice &choice, const double iota, const double thickness)
      : assembly(packing, iota, choice.dimension, thickness)
      , model{cluster::concrete(), true, true}
      , velocity(packing.size(), Vector3d::Zero())
      , spin(packing.size(), Vector3d::Zero())
      , c(choice)
      , disc_thickness(thickness)
    {
    }

    void step(const double dt)
    {
      assembly.update(model);
      std::vector<Vector3d> force(velocity.size(), Vector3d::Zero()), moment = force;
      for (const auto &link : assembly.links)
        {
          force[link.J] += link.force;
          force[link.K] -= link.force;
          moment[link.J] += link.moment_J;
          moment[link.K] += link.moment_K;
        }
      for (std::size_t i = 0; i < velocity.size(); ++i)
        {
          auto        &body   = assembly.bodies[i];
          const double R      = body.radius;
          const double volume = c.dimension == 3 ? 4.0 / 3.0 * M_PI * R * R * R : M_PI * R * R * disc_thickness;
          const double m = density * volume, I = (c.dimension == 3 ? 0.4 : 0.5) * m * R * R;
          kick(velocity[i], force[i] / m, dt);
          if (c.rotations)
            kick(spin[i], moment[i] / I, dt);
          body.displacement = velocity[i] * dt;
          body.turn         = spin[i] * dt;
          body.position += body.displacement;
        }
    }

    reference::Assembly   assembly;
    reference::Model      model;
    std::vector<Vector3d> velocity, spin;

  private:
    void kick(Vector3d &v, Vector3d a, const double dt) const
    {
      for (int i = 0; i < 3; ++i)
        {
          const double ahead = a[i] * (v[i] + 0.5 * dt * a[i]), sign = ahead > 0 ? 1 : ahead < 0 ? -1 : 0;
          v[i] += dt * a[i] * (1 - c.damping * sign);
        }
    }

    Choice c;
    double disc_thickness;
  };
} // namespace

TEST_CASE("free motion is the leap-frog step, with moments and local damping", "[dem]")
{
  omp_set_num_threads(1);
  for (const int dimension : {3, 2})
    for (const bool rotations : {true, false})
      for (const bool equal_radii : {true, false})
        for (const double damping : {0.0, 0.3})
          {
            std::ostringstream words;
            words << dimension << "D, rotations " << rotations << ", equal " << equal_radii << ", damping " << damping;
            INFO(words.str());
            dem::Packing packing = dimension == 3 ? cluster::random_cluster(21, 40, equal_radii ? r : 0.4 * r, r) :
                                                    cluster::cubic_lattice(6, 6, 1, r);
            if (dimension == 2 && !equal_radii)
              for (std::size_t i = 0; i < packing.size(); ++i)
                packing.radius[i] *= i % 3 ? 1.0 : 0.8;
            auto p      = cluster::bonded(1.5);
            p.thickness = 2e-3;
            p.damping   = damping;
            p.physics   = {dimension, rotations, true, true, false};
            dem::Specimen      specimen(packing, p, cluster::concrete());
            ReferenceMotion    exact(packing, {dimension, rotations, equal_radii, damping}, 1.5, p.thickness);
            dem::UniformRandom random(9);
            for (std::size_t i = 0; i < packing.size(); ++i)
              {
                Vector3d v = 3.0 * cluster::random_vector(random), w = 1e3 * cluster::random_vector(random);
                if (dimension == 2)
                  v.z() = w.x() = w.y() = 0;
                if (!rotations)
                  w.setZero();
                specimen.set_velocity(i, v, w);
                exact.velocity[i] = v;
                exact.spin[i]     = w;
              }
            const int steps = 40;
            specimen.advance(steps);
            for (int n = 0; n < steps; ++n)
              exact.step(specimen.time_step());

            const auto out   = specimen.particles();
            double     error = 0, spin_error = 0, damage = 0;
            for (std::size_t i = 0; i < packing.size(); ++i)
              {
                error      = std::max(error, (out.velocity[i] - exact.velocity[i]).norm());
                spin_error = std::max(spin_error, r * (out.angular_velocity[i] - exact.spin[i]).norm());
              }
            for (const auto &link : exact.assembly.links)
              damage = std::max(damage, link.omega);
            REQUIRE(specimen.counts().broken == 0);
            CHECK(damage > 0.5);
            // Velocities of about 3 m/s; round-off of 1e-15 in strains, 1e-11 of the forces, grows a hundredfold at most.
            CHECK(error < 1e-8);
            CHECK(spin_error < 1e-8);
          }
}

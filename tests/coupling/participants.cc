// Requirements on every participant of a coupling, checked of each in the same words.

#include "coupling/participants/particle_participant.h"
#include "coupling/participants/peridynamic_participant.h"
#include "coupling/participants/solid_participant.h"
#include "dem/core/uniform_random.h"
#include "fem/materials/isotropic_elastic.h"
#include "tests/dem/clusters.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

#include <memory>

using coupling::Participant;
using Eigen::Vector3d;

namespace
{
  /** A body with nothing that holds it, and what it is made of. */
  struct Body
  {
    virtual ~Body()                    = default;
    virtual Participant &participant() = 0;
  };

  struct ParticleBody : Body
  {
    ParticleBody()
      : specimen(cluster::cubic_lattice(4, 3, 3, 1e-3), cluster::elastic(cluster::bonded(1.5)), cluster::concrete())
      , side(specimen)
    {
    }
    Participant &participant() override { return side; }

    dem::Specimen                 specimen;
    coupling::ParticleParticipant side;
  };

  template <int dim>
  struct SolidBody : Body
  {
    SolidBody()
      : solid(fem::make_mesh<dim>(
                box<dim>(corner(), std::vector<unsigned int>(dim, 3)), fem::ElementFamily::hypercube, MPI_COMM_SELF),
              {})
    {
      solid.assign("0", fem::make_points(elastic(25e9, 0.2), fem::Plane::strain));
      fem::Loads<dim> loads;
      loads.may_move_freely = true;
      solid.set_loads(loads);
      fem::ExplicitOptions options;
      options.density = {{"0", 2400}};
      motion          = std::make_unique<fem::ExplicitSolver<dim>>(solid, options);
      side            = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
    }
    static dealii::Point<dim> corner()
    {
      dealii::Point<dim> p;
      for (int d = 0; d < dim; ++d)
        p[d] = 6e-3 + 1e-3 * d;
      return p;
    }
    Participant &participant() override { return *side; }

    fem::Solid<dim>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<dim>>        motion;
    std::unique_ptr<coupling::SolidParticipant<dim>> side;
  };

  template <int dim>
  struct PeridynamicBody : Body
  {
    PeridynamicBody()
      : bonds(made())
      , side(bonds, free_of_loads(bonds), {}, bonds.grid().field())
    {
    }
    static dem::peridynamics::Bonds made()
    {
      namespace pd = dem::peridynamics;
      pd::Body body;
      body.space   = dim == 3 ? pd::Space::space : pd::Space::plane_stress;
      body.size    = {5e-3, 4e-3, dim == 3 ? 3e-3 : 0.0};
      body.spacing = body.thickness = 1e-3;
      pd::Material material;
      material.young_modulus = 25e9;
      material.density       = 2400;
      const pd::Horizon horizon{2.015, pd::Volumes::full, false};
      return {pd::Grid(body, pd::reach_of(horizon)), horizon, material};
    }
    static dem::peridynamics::Loads free_of_loads(const dem::peridynamics::Bonds &bonds)
    {
      namespace pd = dem::peridynamics;
      pd::Loads none;
      none.held.assign(bonds.grid().places(), 0);
      none.forces        = [](double, const pd::Field *, pd::Field &) {};
      none.displacements = [](double, pd::Field &) {};
      return none;
    }
    Participant &participant() override { return side; }

    dem::peridynamics::Bonds         bonds;
    coupling::PeridynamicParticipant side;
  };

  struct NamedBody
  {
    const char                            *name;
    std::function<std::unique_ptr<Body>()> make;
  };
  const NamedBody bodies[] = {{"particles", [] { return std::make_unique<ParticleBody>(); }},
                              {"solid", [] { return std::make_unique<SolidBody<3>>(); }},
                              {"plane solid", [] { return std::make_unique<SolidBody<2>>(); }},
                              {"peridynamic block", [] { return std::make_unique<PeridynamicBody<3>>(); }},
                              {"peridynamic plate", [] { return std::make_unique<PeridynamicBody<2>>(); }}};

  Vector3d in_plane(const Participant &p, Vector3d v)
  {
    bool flat = true;
    for (std::size_t i = 0; i < p.carriers(); ++i)
      flat = flat && p.position(i).z() == 0;
    if (flat)
      v.z() = 0;
    return v;
  }

  Vector3d momentum(const Participant &p)
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < p.carriers(); ++i)
      sum += p.mass(i) * p.velocity(i);
    return sum;
  }

  std::vector<Vector3d> positions(const Participant &p)
  {
    std::vector<Vector3d> all;
    for (std::size_t i = 0; i < p.carriers(); ++i)
      all.push_back(p.position(i));
    return all;
  }

  /** Forces that change from window to window, for some of the carriers. @return their sum */
  Vector3d push(Participant &p, const int window)
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < p.carriers(); i += 4)
      {
        const Vector3d force =
          in_plane(p, Vector3d(std::sin(0.3 * window + i), 0.5 * std::cos(0.2 * window), 0.2 * std::sin(i + 1.0)));
        p.add_force(i, 0.5 * force);
        p.add_force(i, 0.5 * force);
        sum += force;
      }
    return sum;
  }
} // namespace

TEST_CASE("participants take up the momentum of forces from outside, window by window", "[coupling]")
{
  for (const NamedBody &body : bodies)
    {
      INFO(body.name);
      const auto   made   = body.make();
      Participant &p      = made->participant();
      const double window = 3.7 * p.stable_step();
      p.advance(window, 4); // the first kick is of another length
      Vector3d expected = momentum(p);
      double   scale    = 0;
      for (int k = 0; k < 50; ++k)
        {
          const Vector3d sum = push(p, k);
          p.advance(window, 4);
          expected += window * sum;
          scale += window * sum.norm();
        }
      CHECK((momentum(p) - expected).norm() < 1e-10 * scale);
      const Vector3d then = momentum(p);
      p.advance(window, 4); // forces are gone after their window
      CHECK((momentum(p) - then).norm() < 1e-10 * scale);
      CHECK(p.time() == Approx(52 * window).epsilon(1e-12));
    }
}

TEST_CASE("what is done to a participant from outside stands in its energy account", "[coupling]")
{
  for (const NamedBody &body : bodies)
    for (const int pieces : {1, 8})
      {
        INFO(body.name << ", " << pieces);
        const auto   made   = body.make();
        Participant &p      = made->participant();
        const double window = 0.5 * p.stable_step() * 8;
        double       worst = 0, scale = 0;
        const auto   group = p.prescribe({0, 1, 2}, {true, false, true});
        for (int k = 0; k < 100; ++k)
          {
            push(p, k);
            if (k % 10 == 3)
              for (std::size_t i = 1; i < p.carriers(); i += 5)
                p.apply_impulse(i, in_plane(p, 0.02 * Vector3d(std::cos(i), std::sin(k), 1)));
            push(p, k + 1); // after an impulse too
            if (k % 25 == 10)
              p.set_motion(group, std::vector<Vector3d>(3, in_plane(p, 0.01 * Vector3d(std::sin(k), 7, 1))));
            p.advance(window, 8 * pieces);
            const auto e = p.energy();
            scale        = std::max(scale, std::fabs(e.external_work) + e.kinetic + e.internal);
            worst        = std::max(worst, std::fabs(e.put_in + e.external_work - e.kinetic - e.internal));
          }
        CHECK(p.energy().external_work > 0);
        INFO(worst / scale);
        CHECK(worst < 5e-4 / (pieces * pieces) * scale); // of second order
      }
}

TEST_CASE("participants go back to a saved state, and on from it to the same bits", "[coupling]")
{
  for (const NamedBody &body : bodies)
    {
      INFO(body.name);
      const auto   made   = body.make();
      Participant &p      = made->participant();
      const double window = 5.3 * p.stable_step();
      CHECK_THROWS_AS(p.restore(), std::logic_error);
      const auto group = p.prescribe({2, 3}, {true, true, false});
      push(p, 1);
      p.advance(window, 6);
      p.set_motion(group, std::vector<Vector3d>(2, Vector3d(0.01, -0.02, 0)));
      p.save();
      std::vector<std::vector<Vector3d>> ends;
      std::vector<double>                work;
      for (int attempt = 0; attempt < 3; ++attempt)
        {
          if (attempt == 1) // another way, which leaves no trace
            {
              p.set_motion(group, std::vector<Vector3d>(2, Vector3d(1, 1, 0)));
              p.prescribe({5}, {true, false, false});
              push(p, 7);
              p.advance(0.3 * window, 11);
              p.apply_impulse(9, {1, 1, 0});
              push(p, 8);
              p.restore();
            }
          for (int k = 0; k < 5; ++k)
            {
              push(p, k);
              p.advance(window, 6);
            }
          ends.push_back(positions(p));
          work.push_back(p.energy().external_work);
          p.restore();
        }
      CHECK(ends[0] == ends[1]);
      CHECK(ends[0] == ends[2]);
      CHECK(work[0] == work[1]);
    }
}

TEST_CASE("prescribed carriers move as prescribed, and reactions of a body at rest balance its forces", "[coupling]")
{
  for (const NamedBody &body : bodies)
    {
      INFO(body.name);
      const auto                  made     = body.make();
      Participant                &p        = made->participant();
      const double                window   = 4 * p.stable_step();
      const auto                  group    = p.prescribe({0, 3}, {true, true, true});
      const auto                  before   = positions(p);
      const std::vector<Vector3d> velocity = {in_plane(p, {0.1, 0.2, -0.1}), in_plane(p, {-0.1, 0, 0.3})};
      p.set_motion(group, velocity);
      p.advance(window, 7);
      CHECK((p.position(0) - before[0] - window * velocity[0]).norm() < 1e-9 * window);
      CHECK((p.position(3) - before[3] - window * velocity[1]).norm() < 1e-9 * window);
      // Momentum changes by what the reaction gives, the inertia of the held carriers left out: their velocity is steady.
      const Vector3d then      = momentum(p);
      const double   step      = window / 7; // like those before: the velocities are half a step back
      const Vector3d before_it = p.reaction(group, Vector3d::Zero()).force;
      p.advance(step, 1);
      const Vector3d gained = momentum(p) - then, after_it = p.reaction(group, Vector3d::Zero()).force;
      CHECK(gained.norm() > 0);
      // Forces are known of the start of the last step, or already of its end.
      CHECK(std::min((gained - step * before_it).norm(), (gained - step * after_it).norm()) < 1e-9 * gained.norm());
    }
}

#pragma once

#include "base/state.h"
#include "clusters.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/laboratory/lab_test.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/hertz_mindlin.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"
#include "dem/loading/periodic_cell.h"
#include "dem/loading/uniaxial.h"
#include "dem/packing/lattice.h"
#include "dem/specimen/specimen.h"
#include "facets_fixture.h"
#include "falling_grains.h"
#include "laboratory_fixture.h"
#include "weak_bonds.h"

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

/** Specimens of all sorts on their way through a test, for tests of what must not change them. */
namespace shared_bodies
{
  using Eigen::Vector3d;

  /** A specimen in a test of some kind. */
  struct Body
  {
    virtual ~Body()                                   = default;
    virtual dem::Specimen      &specimen()            = 0;
    virtual void                advance(std::int64_t) = 0;
    virtual void                visit(base::StateVisitor &visitor) { specimen().visit_state(visitor); }
    virtual std::vector<double> reading() { return {}; } ///< of the test, after its last step
  };
  using Make = std::function<std::unique_ptr<Body>()>;

  /** Left to itself. */
  struct Free : Body
  {
    explicit Free(dem::Specimen &&given)
      : own(std::move(given))
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { own.advance(steps); }
    dem::Specimen  own;
  };

  /** A compact random body. Made once, which takes longer than steps of it do; ranks of tests ask at the same time. */
  inline const dem::Packing &bar(const std::size_t particles)
  {
    static std::mutex                          one_at_a_time;
    static std::map<std::size_t, dem::Packing> made;
    const std::lock_guard<std::mutex>          lock(one_at_a_time);
    dem::Packing                              &found = made[particles];
    if (found.size() == 0)
      found = cluster::random_cluster(5, particles, 0.7e-3, 1e-3);
    return found;
  }

  struct Pulled : Body
  {
    explicit Pulled(const int layers = 16, const double rate = 60)
      : own(
          cluster::cubic_lattice(8, 8, layers, 1e-3),
          [] {
            auto p             = cluster::bonded(1.5);
            p.physics.contacts = true;
            p.damping          = 0.1;
            return p;
          }(),
          cluster::concrete())
      , test(own, [rate] {
        dem::UniaxialParameters p;
        p.axis            = 2;
        p.strain_rate     = rate;
        p.grips.thickness = 2e-3;
        p.stop_strain     = 1;
        p.lateral_blocked = false;
        return p;
      }())
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { test.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      own.visit_state(visitor);
      test.visit_state(visitor);
    }
    std::vector<double> reading() override
    {
      return {test.curve().back().time, test.curve().back().strain, test.curve().back().stress};
    }
    dem::Specimen     own;
    dem::UniaxialTest test;
  };

  struct CellUnderStress : Body
  {
    static dem::Packing packing()
    {
      dem::Packing       p = dem::make_lattice(dem::Lattice::face_centred_cubic, 1e-3, {6, 6, 6});
      dem::UniformRandom random(2);
      for (double &radius : p.radius)
        radius *= 1 - 0.1 * random();
      return p;
    }
    static dem::CellTestParameters path(const double dt)
    {
      dem::CellTestParameters p;
      dem::CellLeg            press, pull;
      press.duration     = 100 * dt;
      press.stress_given = {{true, true, true, true, true, true}};
      press.target << -1e6, -1e6, -1e6, 0, 0, 0;
      pull.duration     = 2000 * dt;
      pull.stress_given = {{true, true, false, true, true, true}};
      pull.target << -1e6, -1e6, 2e-2, 0, 0, 0;
      p.path = {press, pull};
      return p;
    }
    CellUnderStress()
      : own(
          packing(),
          [] {
            auto p             = cluster::bonded(1.2);
            p.physics.periodic = true;
            return p;
          }(),
          cluster::concrete())
      , test(own, path(own.time_step()))
    {
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override { test.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      own.visit_state(visitor);
      test.visit_state(visitor);
    }
    std::vector<double> reading() override
    {
      const dem::CellSample &last = test.curve().back();
      std::vector<double>    row{last.time, last.skew_stress, last.servo_error, last.unbalanced, last.dissipated};
      row.insert(row.end(), last.strain.data(), last.strain.data() + 6);
      row.insert(row.end(), last.stress.data(), last.stress.data() + 6);
      return row;
    }
    dem::Specimen own;
    dem::CellTest test;
  };

  /** A horizontal plate that comes down at a force. */
  inline void press_from_above(dem::Specimen            &specimen,
                               const double              half_edge,
                               const double              height,
                               const dem::LinkMaterials &contact,
                               const double              force,
                               const double              largest_speed)
  {
    dem::SurfaceParameters lid;
    lid.name    = "lid";
    lid.mesh    = dem::plate(Vector3d(-half_edge, -half_edge, height), Vector3d(2 * half_edge, 0, 0),
                             Vector3d(0, 2 * half_edge, 0));
    lid.contact = contact;
    dem::ForceServo servo;
    servo.direction     = Vector3d(0, 0, -1);
    servo.force         = force;
    servo.largest_speed = largest_speed;
    specimen.surfaces().hold_at_force(specimen.surfaces().add(lid), servo);
  }

  /** Loose grains fall into a box and on each other, with friction. @param contact of grains @param pressed by a lid, as they fall */
  inline std::unique_ptr<Body> grains_in_box(const dem::LinkMaterials &contact, const bool pressed)
  {
    dem::Packing       packing = cluster::cubic_lattice(10, 10, 10, 1e-3);
    dem::UniformRandom random(3);
    for (Vector3d &x : packing.centre)
      x = 1.005 * x + Vector3d(1.1e-3, 1.1e-3, 1.1e-3) + 2e-5 * cluster::random_vector(random);
    dem::Specimen          specimen(packing, grains::falling(), contact);
    dem::SurfaceParameters box;
    box.name    = "box";
    box.mesh    = dem::box(Vector3d(0, 0, 0), Vector3d(0.0215, 0.0215, 1), {true, true, true, true, true, false});
    box.contact = grains::rough();
    specimen.surfaces().add(box);
    if (pressed)
      press_from_above(specimen, 0.04, 0.0203, contact, 50, 10);
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, Vector3d(2, 0, -5), Vector3d::Zero());
    return std::make_unique<Free>(std::move(specimen));
  }

  inline std::unique_ptr<Body> falling_grains() { return grains_in_box(grains::rough(), false); }

  /** Elastic spheres with friction, which lose speed where they meet. */
  inline dem::HertzMindlinParameters elastic_grains() { return {2e8, 0.2, 0.3, 0.7}; }

  /**
   * Grains between a floor of many facets over which their contacts are spread, and a lid with friction and restitution that comes down at a
   * force: they stand beside each other in rows, some not quite as low as others, and do not touch each other.
   */
  inline std::unique_ptr<Body> grains_under_lid()
  {
    dem::Packing       packing = cluster::cubic_lattice(24, 24, 2, 1e-3);
    dem::UniformRandom random(5);
    for (Vector3d &x : packing.centre)
      {
        x += 2e-5 * cluster::random_vector(random) - Vector3d(0.023, 0.023, 0);
        x.z() += x.z() < 1e-3 ? 1.02e-3 + 6e-4 * random() : 1.7e-3;
      }
    dem::SpecimenParameters parameters = grains::falling();
    parameters.physics.contacts        = false; // nor is anything gathered to seek them
    dem::Specimen          specimen(packing, parameters, grains::rough());
    dem::SurfaceParameters floor;
    floor.name    = "floor";
    floor.mesh    = walls::patch(0.03, 30);
    floor.contact = grains::rough();
    floor.spread  = true;
    specimen.surfaces().add(floor);
    press_from_above(specimen, 0.03, 4.8e-3, elastic_grains(), 2, 2);
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, Vector3d(1, 0.5, packing.centre[i].z() < 2e-3 ? -1 : 1), Vector3d::Zero());
    return std::make_unique<Free>(std::move(specimen));
  }

  /** Dumb-bells of two that fall into a box, each thrown and turned in its own way. */
  inline dem::Specimen tumbling_clumps_at_first()
  {
    const dem::LinearContactParameters grains     = grains::rough();
    const dem::SpecimenParameters      parameters = grains::falling();
    dem::Packing                       packing    = cluster::cubic_lattice(8, 8, 12, 1e-3);
    dem::UniformRandom                 random(4);
    for (Vector3d &x : packing.centre)
      x = 1.05 * x + Vector3d(1.5e-3, 1.5e-3, 1.5e-3);
    dem::Specimen specimen(packing, parameters, grains);
    const double  mass = 2600 * 4 / 3 * 3.141592653589793 * 1e-9;
    for (std::size_t i = 0; i + 64 < packing.size(); i += 128)
      for (std::size_t k = i; k < i + 64; ++k)
        {
          dem::RigidClump clump;
          clump.particles = {k, k + 64};
          clump.mass      = 2 * mass;
          clump.centre    = 0.5 * (packing.centre[k] + packing.centre[k + 64]);
          clump.inertia   = mass * Vector3d(3e-6, 3e-6, 0.8e-6).asDiagonal();
          specimen.clumps().add(clump);
        }
    dem::SurfaceParameters box;
    box.name    = "box";
    box.mesh    = dem::box(Vector3d(0, 0, 0), Vector3d(0.019, 0.019, 1), {true, true, true, true, true, false});
    box.contact = grains;
    specimen.surfaces().add(box);
    std::vector<dem::PrescribedVelocity> requested;
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        requested.emplace_back();
        requested.back().particle = i;
        requested.back().given    = {{true, true, true, true, true, true}};
        requested.back().velocity = Vector3d(0, 0, -4) + 2 * cluster::random_vector(random);
      }
    specimen.set_velocities(requested);
    return specimen;
  }

  /** Copies of one that is made once, which takes longer than steps of it do. */
  inline std::unique_ptr<Body> tumbling_clumps()
  {
    static const dem::Specimen at_first = tumbling_clumps_at_first();
    return std::make_unique<Free>(dem::Specimen(at_first));
  }

  /** @param times the usual speed */
  inline dem::Specimen thrown_apart(const dem::LinkMaterials &materials,
                                    const int                 dimension = 3,
                                    const double              emission  = 0,
                                    const double              times     = 1)
  {
    dem::SpecimenParameters p = cluster::bonded(1.2);
    p.step_factor             = 0.1;
    p.physics.dimension       = dimension;
    p.thickness               = dimension == 2 ? 1e-3 : 0;
    p.emission_reach          = emission;
    dem::Packing body = dimension == 3 ? bar(700) : dem::make_lattice(dem::Lattice::hexagonal, 1e-3, {30, 20, 1});
    body.periodic_cell.reset();
    if (materials.several())
      for (const auto &x : body.centre)
        body.material.push_back(x.x() > 0 ? 1 : 0);
    dem::Specimen specimen(body, p, materials);
    for (std::size_t i = 0; i < body.size(); ++i)
      specimen.set_velocity(i, times * (200 * body.centre[i] + 800 * Vector3d(0, body.centre[i].x(), 0)),
                            Vector3d(0, 0, 10.0 * static_cast<double>(i % 3)));
    return specimen;
  }

  /** A partner slows particles down by the force on them, moves some that were left to it, kicks others and pushes one. */
  struct Partnered : Body
  {
    Partnered()
      : own(thrown_apart(weak_bonds::parallel()))
    {
      for (std::size_t i = 0; i < own.counts().particles; i += 3)
        watched.push_back(i);
      own.partners().leave({watched[10], watched[20]}, true);
    }
    dem::Specimen &specimen() override { return own; }
    void           advance(const std::int64_t steps) override
    {
      for (std::int64_t s = 0; s < steps; ++s)
        {
          if (own.steps() % 10 == 5)
            own.partners().apply_impulse(3 * static_cast<std::size_t>(own.steps() % 200) + 1, Vector3d(0.1, -0.2, 0.3),
                                         Vector3d(5, 0, -5));
          own.partners().clear_forces();
          own.partners().add_force(400, Vector3d(0, 0.01, 0), Vector3d(0, 0, 1e-6));
          own.partners().advance(watched, correct);
        }
    }
    static void correct(dem::StepCorrection &correction)
    {
      for (std::size_t k = 0; k < correction.particles.size(); ++k)
        for (std::size_t c = 0; c < 6; ++c)
          correction.velocity[6 * k + c] =
            k == 10 || k == 20 ? 0.01 : 0.999 * correction.velocity[6 * k + c] + 1e-3 * correction.force(k)[c];
    }
    dem::Specimen            own;
    std::vector<std::size_t> watched;
  };

  /** Grains in a box that takes three steps in one of theirs, as finite elements would. */
  struct InShakenBox : Body
  {
    dem::Specimen &specimen() override { return grains->specimen(); }
    void           advance(const std::int64_t steps) override
    {
      constexpr int  sub_steps = 3;
      dem::Specimen &own       = specimen();
      for (std::int64_t s = 0; s < steps; ++s)
        {
          own.partners().find_surface_forces();
          const double step = own.longest_step() / sub_steps;
          own.set_time_step(sub_steps * step);
          own.partners().begin_glide();
          for (int taken = 0; taken < sub_steps; ++taken)
            {
              if (taken > 0)
                own.partners().find_surface_forces();
              const double turn = 1e4 * (own.time() + taken * step);
              own.surfaces().set_vertex_velocities(
                0,
                std::vector<Vector3d>(own.surfaces().at(0).place.size(), Vector3d(std::cos(turn), 0, std::sin(turn))));
              own.partners().glide(step, step);
            }
          own.partners().finish_glide();
        }
    }
    std::unique_ptr<Body> grains = falling_grains();
  };

  /** Spheres between platens, under a pressure across that servo walls, a membrane or a jacket hold; then loaded along. */
  struct Confined : Body
  {
    using Confinement = dem::LabParameters::Confinement;

    static dem::LabParameters requested(const Confinement how)
    {
      dem::LabParameters p = laboratory::between_platens(0.5);
      p.test               = laboratory::Test::confined;
      p.press.axis         = 2;
      p.press.smoothing    = how == Confinement::cylinder ? 0.2 * laboratory::R : 0;
      p.pressure           = 1e6;
      p.largest_speed      = how == Confinement::cylinder ? 2 : 0.05;
      p.gain               = how == Confinement::cylinder ? 0.5 : p.gain;
      p.confinement        = how;
      p.membrane_steps     = 60;
      p.ramp_steps         = 80;
      p.rest_steps         = 20; // no longer: what counts is that all of it happens
      p.stop_strain        = 1;
      return p;
    }
    static dem::Packing packing(const Confinement how)
    {
      using laboratory::R;
      return how == Confinement::cylinder ? laboratory::cylinder_of_spheres(8 * R, 30 * R) :
                                            cluster::cubic_lattice(9, 9, 9, R);
    }
    static dem::SpecimenParameters spheres()
    {
      dem::SpecimenParameters p = laboratory::discs();
      p.physics.dimension       = 3;
      p.thickness               = 0;
      return p;
    }
    explicit Confined(const Confinement how)
      : run(packing(how), spheres(), laboratory::weak(), requested(how))
    {
    }
    dem::Specimen &specimen() override { return run.body; }
    void           advance(const std::int64_t steps) override { run.advance(steps); }
    void           visit(base::StateVisitor &visitor) override
    {
      run.body.visit_state(visitor);
      run.test.visit_state(visitor);
    }
    std::vector<double> reading() override
    {
      const dem::LabReading &last = run.test.reading();
      return {last.strain,       last.stress,         last.low,         last.high,
              last.gauge_strain, last.lateral_strain, last.confinement, last.kinetic,
              last.work,         last.force_ratio,    last.breaks,      static_cast<double>(run.test.stage())};
    }
    laboratory::Run run;
  };
} // namespace shared_bodies

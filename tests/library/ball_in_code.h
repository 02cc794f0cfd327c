#pragma once

#include "apps/runs/particles/model.h"
#include "dem/laws/hertz_mindlin.h"

namespace library_tests
{
  constexpr double radius = 0.01, start = 0.0101; // [m]

  inline dem::HertzMindlinParameters glass()
  {
    dem::HertzMindlinParameters p;
    p.young_modulus        = 1e9;
    p.poisson_ratio        = 0.25;
    p.friction_coefficient = 0.3;
    p.restitution          = 0.9;
    return p;
  }

  /** A ball that is thrown obliquely onto a floor. */
  inline apps::ParticlesModel ball_in_code()
  {
    apps::ParticlesModel model;
    model.source.source  = apps::SpecimenSection::Source::none;
    model.source.density = 2500;

    model.source.interaction_ratio = 1;
    apps::AddedParticles &ball     = model.more.added.emplace_back();
    ball.name                      = "ball";
    ball.centre                    = {0, 0, start};
    ball.radius                    = radius;
    model.material.only.choose(glass());

    apps::WallSection &floor = model.walls.walls.emplace_back();
    floor.name               = "floor";
    floor.contact.choose(glass());
    apps::MotionFormulas &thrown = model.initial_velocity.velocities.emplace_back();
    thrown.group                 = "ball";
    thrown.velocity[0]           = apps::Expression("0.5", "Velocity x");
    thrown.velocity[2]           = apps::Expression("-1", "Velocity z");
    apps::ProbeSection &height   = model.probes.probes.emplace_back();
    height.name                  = "height";
    height.quantity              = apps::ProbeSection::Quantity::position;
    height.group                 = "ball";
    height.component             = apps::ProbeSection::Component::z;

    model.end_time         = 1e-3;
    model.time.step_factor = 0.1;
    model.time.damping     = 0;
    model.output.samples   = 50;
    model.output.snapshots = 0;
    return model;
  }
} // namespace library_tests

// A model that is filled here, without any text: a ball falls on a floor, and its largest speed is printed.
#include <apps/results/run_result.h>
#include <apps/runs/particles/run.h>
#include <base/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main()
try
  {
    apps::ParticlesModel model;
    model.source.source            = apps::SpecimenSection::Source::none;
    model.source.density           = 2500;
    model.source.interaction_ratio = 1;
    model.gravity.acceleration     = {0, 0, -9.81};
    model.gravity.start            = apps::GravitySection::Start::none; // it falls
    model.time.damping             = 0;
    model.end_time                 = 0.1;

    dem::LinearContactParameters contact;
    contact.effective_modulus = 1e7;
    model.material.only.choose(contact);

    apps::AddedParticles &ball = model.more.added.emplace_back();
    ball.name                  = "ball";
    ball.centre                = {0, 0, 0.06}; // falls 50 mm
    ball.radius                = 0.01;
    apps::WallSection &floor   = model.walls.walls.emplace_back();
    floor.name                 = "floor";
    floor.contact.linear       = contact;

    apps::ProbeSection &speed = model.probes.probes.emplace_back();
    speed.name                = "speed";
    speed.quantity            = apps::ProbeSection::Quantity::velocity;
    speed.group               = "ball";
    speed.component           = apps::ProbeSection::Component::z;

    model.check({});
    const apps::RunResult result = run(model, apps::RunRequest());

    const std::vector<double> &column  = result.series.column("speed");
    const double               fastest = *std::min_element(column.begin(), column.end());
    const double               exact   = -std::sqrt(2 * 9.81 * 0.05);
    std::printf("falls at up to %.4f m/s; free fall over 50 mm: %.4f m/s\n", fastest, exact);
    return std::abs(fastest / exact - 1) < 0.02 ? 0 : 1;
  }
catch (const base::InputError &refused)
  {
    std::fprintf(stderr, "%s\n", refused.what());
    return 2;
  }

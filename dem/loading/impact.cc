#include "dem/loading/impact.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    /** Steps between two checks of the impactor: it moves less than a thousandth of a radius meanwhile. */
    constexpr std::int64_t steps_between_checks = 20;

    int blow_axis(const int dimension) { return dimension == 3 ? 2 : 1; }

    struct Extent
    {
      Eigen::Vector3d low  = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
      Eigen::Vector3d high = -low;
    };

    /** Of the centres of the first `count` particles. */
    Extent extent_of(const std::vector<Eigen::Vector3d> &centre, const std::size_t count)
    {
      Extent extent;
      for (std::size_t i = 0; i < count; ++i)
        {
          extent.low  = extent.low.cwiseMin(centre[i]);
          extent.high = extent.high.cwiseMax(centre[i]);
        }
      return extent;
    }

    void require(const bool fulfilled, const char *entry, const double value, const char *rule)
    {
      if (fulfilled && std::isfinite(value))
        return;
      std::ostringstream message;
      message << "Impact/" << entry << " = " << value << ": " << rule;
      throw base::InputError(message.str());
    }

    void check(const ImpactParameters &p)
    {
      require(p.span > 0, "Span", p.span, "must be above 0 m.");
      require(p.support_width > 0, "Support width", p.support_width, "must be above 0 m.");
      require(p.impactor_radius > 0, "Impactor radius", p.impactor_radius, "must be above 0 m.");
      require(p.impactor_velocity > 0, "Impactor velocity", p.impactor_velocity, "must be above 0 m/s.");
      require(p.rest_damping > 0 && p.rest_damping < 1, "Rest damping", p.rest_damping, "must lie between 0 and 1.");
      require(p.rest_ratio > 0, "Rest ratio", p.rest_ratio, "must be above 0.");
      require(p.longest > 0, "Longest", p.longest, "must be above 0 s.");
    }
  } // namespace

  Packing with_impactor(const Packing &beam, const ImpactParameters &parameters, const int dimension)
  {
    check(parameters);
    constexpr double clear   = 1.01; // of the sum of the radii: not yet in touch
    const int        up      = blow_axis(dimension);
    const Extent     extent  = extent_of(beam.centre, beam.size());
    const double     largest = *std::max_element(beam.radius.begin(), beam.radius.end());
    Packing          packing = beam;
    packing.periodic_cell.reset();
    Eigen::Vector3d centre = 0.5 * (extent.low + extent.high);
    centre[up]             = extent.high[up] + clear * (largest + parameters.impactor_radius);
    packing.centre.push_back(centre);
    packing.radius.push_back(parameters.impactor_radius);
    if (!packing.material.empty())
      packing.material.push_back(0);
    return packing;
  }

  ImpactTest::ImpactTest(Specimen &body, const ImpactParameters &p)
    : specimen(&body)
    , parameters(p)
    , impactor(body.counts().particles - 1)
    , up(blow_axis(body.parameters().physics.dimension))
  {
    check(p);
    if (body.parameters().loose != 1)
      throw base::InputError("Impact: the specimen must have one loose particle, the impactor.");
    const ParticleKinematics particles = body.kinematics();
    impactor_mass                      = particles.mass[impactor];
    Eigen::Vector3d velocity           = Eigen::Vector3d::Zero();
    velocity[up]                       = -p.impactor_velocity;
    body.set_velocity(impactor, velocity, Eigen::Vector3d::Zero());

    const Extent extent = extent_of(particles.position, impactor);
    const double middle = 0.5 * (extent.low[0] + extent.high[0]);
    for (const double side : {-0.5, 0.5})
      {
        Grip grip;
        for (std::size_t i = 0; i < impactor; ++i)
          if (std::abs(particles.position[i][0] - (middle + side * p.span)) <= 0.5 * p.support_width &&
              particles.position[i][up] <= extent.low[up] + particles.radius[i])
            grip.particles.push_back(i);
        if (grip.particles.empty())
          throw base::InputError(
            "Impact/Support width: a support would hold no particle. Widen it, or shorten the span.");
        grip.prescribed[static_cast<std::size_t>(up)] = true;
        body.grips().add(grip);
      }
  }

  double ImpactTest::impactor_energy() const
  {
    return 0.5 * impactor_mass * parameters.impactor_velocity * parameters.impactor_velocity;
  }

  double ImpactTest::absorbed() const
  {
    return impactor_energy() - 0.5 * impactor_mass * specimen->particle(impactor).velocity.squaredNorm();
  }

  ImpactSample ImpactTest::advance(const std::int64_t steps)
  {
    for (std::int64_t taken = 0; taken < steps && !finished();)
      {
        const std::int64_t now = std::min(steps_between_checks, steps - taken);
        specimen->advance(now);
        taken += now;
        update();
      }
    const ParticleKinematics particles = specimen->kinematics();
    const EnergyAccount      energy    = specimen->energy();
    ImpactSample             sample;
    sample.time              = specimen->time();
    sample.impactor_velocity = -particles.velocity[impactor][up];
    sample.kinetic           = energy.kinetic - 0.5 * impactor_mass * particles.velocity[impactor].squaredNorm();
    sample.mean_damage       = specimen->mean_damage();
    sample.dissipated        = energy.damage + energy.friction + energy.damping + energy.released;
    return sample;
  }

  void ImpactTest::update()
  {
    if (specimen->time() >= parameters.longest)
      {
        episode = Episode::done;
        return;
      }
    const std::size_t contacts = specimen->counts().contacts;
    if (episode == Episode::flight && contacts > 0)
      episode = Episode::contact;
    if (episode == Episode::flight)
      return;
    const ParticleKinematics particles = specimen->kinematics();
    if (episode == Episode::contact && particles.velocity[impactor][up] > 0)
      {
        const Eigen::Vector3d &x    = particles.position[impactor];
        bool                   near = false;
        for (std::size_t i = 0; i < impactor && !near; ++i)
          near = (particles.position[i] - x).norm() < particles.radius[i] + parameters.impactor_radius;
        if (!near)
          {
            episode = Episode::rest;
            specimen->set_damping(parameters.rest_damping);
          }
      }
    if (episode == Episode::rest)
      {
        const double kinetic =
          specimen->energy().kinetic - 0.5 * impactor_mass * particles.velocity[impactor].squaredNorm();
        if (kinetic < parameters.rest_ratio * impactor_energy())
          episode = Episode::done;
      }
  }

  void ImpactTest::visit_state(base::StateVisitor &visitor)
  {
    auto number = static_cast<std::int64_t>(episode);
    visitor.scalar("impact/stage", number);
    episode = static_cast<Episode>(number);
  }
} // namespace dem

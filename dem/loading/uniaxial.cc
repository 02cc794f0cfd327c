#include "dem/loading/uniaxial.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dem
{
  namespace
  {
    /** The peak is believed once the specimen has been strained this much past it; earlier dips are waves. */
    constexpr double strain_past_peak = 1.1;

    void check(const UniaxialParameters &p, const int dimension)
    {
      const auto refuse = [](const std::string &message) { throw base::InputError("Loading/" + message); };
      if (p.axis < 0 || p.axis >= dimension)
        refuse("Axis: must be one of the specimen's directions.");
      if (p.strain_rate == 0 || !std::isfinite(p.strain_rate))
        refuse("strain rate: must not be zero.");
      if (p.turning && !p.lateral_blocked)
        refuse("Grips turn: the specimen would fall over where grips do not hold their particles sideways.");
      if (!(p.grips.thickness > 0))
        refuse("Grip thickness: must be above 0 m.");
      if (!(p.grips.area >= 0 && std::isfinite(p.grips.area)))
        refuse("Area: must be above 0 m^2.");
      if (p.grips.gauge == Gauge::planes && !(p.grips.low_plane < p.grips.high_plane))
        refuse("Gauge planes: the second must lie above the first.");
      if (!(p.stop_fraction >= 0 && p.stop_fraction < 1))
        refuse("stop fraction: must lie between 0 and 1.");
      if (!(p.stop_strain > 0))
        refuse("stop strain: must be above 0.");
    }

    GripLayers layers_of(const ObservedSpecimen &body, const UniaxialParameters &p)
    {
      const SpecimenParameters &made = body.parameters();
      check(p, made.physics.dimension);
      const ParticleKinematics particles = body.kinematics();
      return find_grip_layers({particles.position, particles.radius, made.physics.dimension, made.thickness}, p.axis,
                              p.grips);
    }
  } // namespace

  UniaxialTest::UniaxialTest(Specimen &body, const UniaxialParameters &p)
    : specimen(&body)
    , parameters(p)
    , layers(layers_of(body, p))
    , rate(p.strain_rate)
  {
    const ParticleKinematics particles = body.kinematics();
    const auto              &x         = particles.position;
    const double             radii     = std::accumulate(particles.radius.begin(), particles.radius.end(), 0.0);
    const double             faces     = layers.high_face - layers.low_face;
    row = static_cast<std::int64_t>(std::ceil(faces / (2 * radii / static_cast<double>(x.size()))));

    // Every particle between the grips starts with the velocity of a uniform strain rate: no shock runs in from them.
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
        velocity[p.axis]         = p.strain_rate * layers.distance / faces * (x[i][p.axis] - layers.middle());
        body.set_velocity(i, velocity, Eigen::Vector3d::Zero());
      }
    for (int side = 0; side < 2; ++side)
      {
        Grip grip;
        grip.particles = side == 0 ? layers.low : layers.high;
        if (p.turning)
          grip.turning_face = p.axis;
        for (int c = 0; c < 3; ++c)
          {
            grip.prescribed[c]     = c == p.axis || p.lateral_blocked;
            grip.prescribed[3 + c] = p.spin_blocked;
          }
        grips[side] = body.grips().add(grip);
      }
    move_grips();
  }

  void UniaxialTest::move_grips()
  {
    for (int side = 0; side < 2; ++side)
      {
        Eigen::Vector3d velocity  = Eigen::Vector3d::Zero();
        velocity[parameters.axis] = (side == 0 ? -0.5 : 0.5) * rate * layers.distance;
        specimen->grips().set_velocity(grips[side], velocity, Eigen::Vector3d::Zero());
      }
  }

  UniaxialSample UniaxialTest::advance(const std::int64_t steps)
  {
    if (finished())
      return samples.back();
    if (specimen->steps() == 0 && layers.planes)
      planes_at_start = opening_of_planes();
    look_ahead();
    specimen->advance(steps, [this] {
      measure();
      if (watcher)
        watcher(now);
      look_ahead();
      return !finished();
    });
    samples.push_back(now);
    return now;
  }

  double UniaxialTest::travel() const { return travel_then + rate * (specimen->time() - rate_changed_at); }

  double UniaxialTest::opening_of_planes() const
  {
    const auto along = [this](const std::size_t i) { return specimen->displacement(i)[parameters.axis]; };
    return layers.planes->second.motion(along) - layers.planes->first.motion(along);
  }

  void UniaxialTest::look_ahead()
  {
    next_time   = specimen->time();
    next_travel = travel();
    next_strain = layers.planes ? (opening_of_planes() - planes_at_start) / layers.gauge_length : next_travel;
  }

  void UniaxialTest::measure()
  {
    const double pull = 0.5 * (specimen->grips().reaction(grips[1])[parameters.axis] -
                               specimen->grips().reaction(grips[0])[parameters.axis]);
    now               = {next_time, next_strain, pull / layers.section};
    travelled         = next_travel;

    const double sign = parameters.strain_rate > 0 ? 1 : -1;
    if (record.add(sign * now.strain, sign * now.stress))
      travelled_at_peak = sign * travelled;
    const double part = record.largest_stress() > 0 ? sign * now.stress / record.largest_stress() : 1;
    low_steps         = past_peak() && part < parameters.stop_fraction ? low_steps + 1 : 0;
    fallen_steps      = past_peak() && part < std::max(fallen_part, parameters.stop_fraction) ? fallen_steps + 1 : 0;
  }

  void UniaxialTest::set_strain_rate(const double strain_rate)
  {
    if (!std::isfinite(strain_rate))
      throw base::InputError("Loading/strain rate: must be a finite number.");
    travel_then     = travel();
    rate_changed_at = specimen->time();
    rate            = strain_rate;
    move_grips();
  }

  bool UniaxialTest::past_peak() const { return std::abs(travelled) > strain_past_peak * travelled_at_peak; }

  bool UniaxialTest::finished() const
  {
    // A wave that runs through a specimen may dip below the stop fraction; a crack stays below.
    return std::abs(travelled) >= parameters.stop_strain || low_steps > row;
  }

  std::int64_t UniaxialTest::most_steps() const
  {
    return static_cast<std::int64_t>(
             std::ceil(parameters.stop_strain / std::abs(parameters.strain_rate) / specimen->time_step())) +
           1;
  }

  UniaxialFigures UniaxialTest::figures() const
  {
    UniaxialFigures found = record.figures();
    // As is_past_peak(), but for waves that dip: a crack stays.
    found.peak_passed =
      found.strength > 0 && (fallen_steps > row || std::abs(travelled) >= past_peak_strain * travelled_at_peak);
    return found;
  }

  void UniaxialTest::visit_state(base::StateVisitor &visitor)
  {
    base::Column flat;
    for (const auto &s : samples)
      flat.insert(flat.end(), {s.time, s.strain, s.stress});
    visitor.column("uniaxial/samples", flat);
    samples.resize(flat.size() / 3);
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    visitor.scalar("uniaxial/rate", rate);
    visitor.scalar("uniaxial/rate_changed_at", rate_changed_at);
    visitor.scalar("uniaxial/travel_then", travel_then);
    visitor.scalar("uniaxial/planes_at_start", planes_at_start);
    visitor.scalar("uniaxial/travelled", travelled);
    visitor.scalar("uniaxial/travelled_at_peak", travelled_at_peak);
    visitor.scalar("uniaxial/low_steps", low_steps);
    visitor.scalar("uniaxial/fallen_steps", fallen_steps);
    record.visit_state(visitor);
  }
} // namespace dem

#include "dem/loading/uniaxial.h"

#include "dem/core/errors.h"
#include "dem/loading/grip_layers.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    /** The peak is believed once the specimen has been strained this much past it; earlier dips are waves. */
    constexpr double strain_past_peak = 1.1;
    /** Part of the peak stress up to which the slope counts as the modulus, as in EN 12390-13. */
    constexpr double elastic_part = 1.0 / 3.0;

    void check(const UniaxialParameters &p, const int dimension)
    {
      const auto refuse = [](const std::string &message) { throw InputError("Loading/" + message); };
      if (p.axis < 0 || p.axis >= dimension)
        refuse("Axis: must be one of the specimen's directions.");
      if (p.strain_rate == 0 || !std::isfinite(p.strain_rate))
        refuse("strain rate: must not be zero.");
      if (!(p.grip_thickness > 0))
        refuse("Grip thickness: must be above 0 m.");
      if (!(p.stop_fraction > 0 && p.stop_fraction < 1))
        refuse("stop fraction: must lie between 0 and 1.");
      if (!(p.stop_strain > 0))
        refuse("stop strain: must be above 0.");
    }
  } // namespace

  UniaxialTest::UniaxialTest(Specimen &body, const UniaxialParameters &p)
    : specimen(&body)
    , parameters(p)
    , rate(p.strain_rate)
  {
    const SpecimenParameters &made = body.parameters();
    check(p, made.physics.dimension);
    const ParticleOutput particles = body.particles();
    const auto          &x         = particles.position;
    const GripLayers     layers =
      find_grip_layers({x, particles.radius, made.physics.dimension, made.thickness}, p.axis, p.grip_thickness);
    length = layers.length;
    area   = layers.section;

    // Every particle starts with the velocity of a uniform strain rate: no shock runs in from the grips.
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
        velocity[p.axis]         = p.strain_rate * (x[i][p.axis] - layers.middle);
        body.set_velocity(i, velocity, Eigen::Vector3d::Zero());
      }
    for (int side = 0; side < 2; ++side)
      {
        Grip grip;
        grip.particles = side == 0 ? layers.low : layers.high;
        for (int c = 0; c < 3; ++c)
          {
            grip.prescribed[c]     = c == p.axis || p.lateral_blocked;
            grip.prescribed[3 + c] = p.spin_blocked;
          }
        grip.velocity[p.axis] = (side == 0 ? -0.5 : 0.5) * p.strain_rate * length;
        grips[side]           = body.add_grip(grip);
      }
  }

  UniaxialSample UniaxialTest::advance(const std::int64_t steps)
  {
    specimen->advance(steps);
    UniaxialSample sample;
    sample.time   = specimen->time() - specimen->time_step(); // forces are those of the last step's start
    sample.strain = strain_then + rate * (sample.time - rate_changed_at);
    sample.stress =
      0.5 * (specimen->reaction(grips[1])[parameters.axis] - specimen->reaction(grips[0])[parameters.axis]) / area;
    samples.push_back(sample);
    return sample;
  }

  void UniaxialTest::set_strain_rate(const double strain_rate)
  {
    if (!std::isfinite(strain_rate))
      throw InputError("Loading/strain rate: must be a finite number.");
    strain_then += rate * (specimen->time() - rate_changed_at);
    rate_changed_at = specimen->time();
    rate            = strain_rate;
    for (int side = 0; side < 2; ++side)
      {
        Eigen::Vector3d velocity  = Eigen::Vector3d::Zero();
        velocity[parameters.axis] = (side == 0 ? -0.5 : 0.5) * rate * length;
        specimen->set_grip_velocity(grips[side], velocity, Eigen::Vector3d::Zero());
      }
  }

  bool UniaxialTest::finished() const
  {
    if (samples.empty())
      return false;
    const UniaxialFigures found  = figures();
    const double          strain = std::abs(samples.back().strain),
                 stress          = samples.back().stress * (parameters.strain_rate > 0 ? 1 : -1);
    return strain >= parameters.stop_strain ||
           (strain > strain_past_peak * found.strain_at_peak && stress < parameters.stop_fraction * found.strength);
  }

  std::int64_t UniaxialTest::most_steps() const
  {
    return static_cast<std::int64_t>(
             std::ceil(parameters.stop_strain / std::abs(parameters.strain_rate) / specimen->time_step())) +
           1;
  }

  const std::vector<UniaxialSample> &UniaxialTest::curve() const { return samples; }

  UniaxialFigures UniaxialTest::figures() const
  {
    const double    sign = parameters.strain_rate > 0 ? 1 : -1;
    UniaxialFigures found;
    for (const auto &s : samples)
      if (sign * s.stress > found.strength)
        {
          found.strength       = sign * s.stress;
          found.strain_at_peak = sign * s.strain;
        }
    double product = 0, square = 0;
    for (const auto &s : samples)
      {
        if (sign * s.stress > elastic_part * found.strength)
          break;
        product += s.stress * s.strain;
        square += s.strain * s.strain;
      }
    found.young_modulus = square > 0 ? product / square : 0.0;
    return found;
  }

  double UniaxialTest::section() const { return area; }
  double UniaxialTest::reference_length() const { return length; }

  void UniaxialTest::visit_state(StateVisitor &visitor)
  {
    Column flat;
    for (const auto &s : samples)
      flat.insert(flat.end(), {s.time, s.strain, s.stress});
    visitor.column("uniaxial/samples", flat);
    visitor.scalar("uniaxial/rate", rate);
    visitor.scalar("uniaxial/rate_changed_at", rate_changed_at);
    visitor.scalar("uniaxial/strain_then", strain_then);
    samples.resize(flat.size() / 3);
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  }
} // namespace dem

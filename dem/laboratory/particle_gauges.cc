#include "dem/laboratory/particle_gauges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dem
{
  namespace
  {
    /** Of the height: where the rows lie, and the part between which the sides are measured. */
    constexpr double low_row = 0.25, high_row = 0.75;
    /** Half width of a row in mean diameters, and part of the particles that count as a side. */
    constexpr double diameters = 2, outermost_part = 0.05;

    MeanMotion mean_of(std::vector<std::size_t> chosen, const ParticleKinematics &particles, const int axis)
    {
      MeanMotion mean;
      for (const std::size_t i : chosen)
        mean.place += particles.position[i][axis] / static_cast<double>(chosen.size());
      mean.particles = std::move(chosen);
      return mean;
    }
  } // namespace

  BodyExtent::BodyExtent(const ParticleKinematics &p)
    : low(p.position.front())
    , high(p.position.front())
  {
    for (std::size_t i = 0; i < p.position.size(); ++i)
      {
        low  = low.cwiseMin(Eigen::Vector3d(p.position[i].array() - p.radius[i]));
        high = high.cwiseMax(Eigen::Vector3d(p.position[i].array() + p.radius[i]));
      }
  }

  double MeanMotion::along(const ObservedSpecimen &specimen, const int axis) const
  {
    double sum = 0;
    for (const std::size_t i : particles)
      sum += specimen.displacement(i)[axis];
    return sum / static_cast<double>(particles.size());
  }

  double ParticleGauge::strain(const ObservedSpecimen &specimen) const
  {
    return (high.along(specimen, axis) - low.along(specimen, axis)) / length();
  }

  double mean_diameter(const std::vector<double> &radius)
  {
    return 2 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  }

  MeanMotion
  particles_near(const ParticleKinematics &particles, const int axis, const double place, const double within)
  {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      if (std::abs(particles.position[i][axis] - place) <= within)
        chosen.push_back(i);
    return mean_of(std::move(chosen), particles, axis);
  }

  ParticleGauge rows_along(const ParticleKinematics &particles, const int axis)
  {
    const BodyExtent body(particles);
    const double     within = diameters * mean_diameter(particles.radius);
    const auto       at     = [&](const double part) { return body.low[axis] + part * body.length(axis); };
    return {axis, particles_near(particles, axis, at(low_row), within),
            particles_near(particles, axis, at(high_row), within)};
  }

  ParticleGauge sides_across(const ParticleKinematics &particles, const int axis, const int across)
  {
    const BodyExtent         body(particles);
    std::vector<std::size_t> inner;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      if (std::abs(particles.position[i][axis] - body.middle(axis)) <= 0.25 * body.length(axis))
        inner.push_back(i);
    std::sort(inner.begin(), inner.end(), [&](const std::size_t a, const std::size_t b) {
      const double x = particles.position[a][across], y = particles.position[b][across];
      return x != y ? x < y : a < b;
    });
    const auto count = static_cast<std::ptrdiff_t>(std::ceil(outermost_part * static_cast<double>(inner.size())));
    return {across, mean_of({inner.begin(), inner.begin() + count}, particles, across),
            mean_of({inner.end() - count, inner.end()}, particles, across)};
  }
} // namespace dem

#include "dem/grips/grip_layers.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    /** Outermost centres along the axis [m]. */
    struct Ends
    {
      double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    };

    Ends find_ends(const SpecimenShape &specimen, const int axis)
    {
      Ends ends;
      for (const Eigen::Vector3d &x : specimen.centre)
        {
          ends.low  = std::min(ends.low, x[axis]);
          ends.high = std::max(ends.high, x[axis]);
        }
      return ends;
    }

    void check_grips(const double thickness, const Ends &ends)
    {
      if (ends.low + thickness < ends.high - thickness)
        return;
      std::ostringstream message;
      message << "Loading/Grip thickness = " << thickness << " m: the two grips would meet. Particle centres span "
              << ends.high - ends.low << " m along the axis. Use less than half of that.";
      throw base::InputError(message.str());
    }

    [[noreturn]] void refuse_plane(const double plane, const Ends &ends)
    {
      std::ostringstream message;
      message << "Loading/Gauge planes: at " << plane
              << " m along the axis there are no particles whose motion could be measured; "
              << "centres lie from " << ends.low << " to " << ends.high << " m.";
      throw base::InputError(message.str());
    }

    PlaneGauge gauge_at(const double plane, const SpecimenShape &specimen, const int axis, const Ends &ends)
    {
      if (!(plane >= ends.low && plane <= ends.high))
        refuse_plane(plane, ends);
      const double reach = 2 * *std::max_element(specimen.radius.begin(), specimen.radius.end());
      PlaneGauge   gauge;
      double       mean = 0, spread = 0;
      for (std::size_t i = 0; i < specimen.centre.size(); ++i)
        if (std::abs(specimen.centre[i][axis] - plane) <= reach)
          gauge.particles.push_back(i);
      if (gauge.particles.empty())
        refuse_plane(plane, ends);
      const auto n = static_cast<double>(gauge.particles.size());
      for (const std::size_t i : gauge.particles)
        mean += specimen.centre[i][axis] / n;
      for (const std::size_t i : gauge.particles)
        spread += std::pow(specimen.centre[i][axis] - mean, 2);
      const bool one_layer = spread <= 1e-12 * n * reach * reach; // no slope to be had, and none is needed on the plane
      if (one_layer && std::abs(mean - plane) > 1e-6 * reach)
        refuse_plane(plane, ends);
      for (const std::size_t i : gauge.particles)
        gauge.weight.push_back(1 / n + (one_layer ? 0.0 : (specimen.centre[i][axis] - mean) * (plane - mean) / spread));
      return gauge;
    }
  } // namespace

  GripLayers find_grip_layers(const SpecimenShape &specimen, const int axis, const GripParameters &parameters)
  {
    const Ends ends = find_ends(specimen, axis);
    check_grips(parameters.thickness, ends);
    GripLayers layers;
    layers.low_face  = ends.low;
    layers.high_face = ends.high;
    for (std::size_t i = 0; i < specimen.centre.size(); ++i)
      {
        const double at = specimen.centre[i][axis];
        if (at <= ends.low + parameters.thickness)
          {
            layers.low.push_back(i);
            layers.low_face = std::max(layers.low_face, at);
          }
        if (at >= ends.high - parameters.thickness)
          {
            layers.high.push_back(i);
            layers.high_face = std::min(layers.high_face, at);
          }
      }
    layers.distance =
      parameters.gauge == Gauge::outermost_centres ? ends.high - ends.low : layers.high_face - layers.low_face;
    layers.gauge_length = layers.distance;
    if (parameters.gauge == Gauge::planes)
      {
        layers.gauge_length = parameters.high_plane - parameters.low_plane;
        layers.planes.emplace(gauge_at(parameters.low_plane, specimen, axis, ends),
                              gauge_at(parameters.high_plane, specimen, axis, ends));
      }
    layers.section = parameters.area > 0 ? parameters.area : nominal_section(specimen, axis);
    return layers;
  }
} // namespace dem

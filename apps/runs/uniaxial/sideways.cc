#include "apps/runs/uniaxial/sideways.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double growth = 1.1, elastic_part = 1.0 / 3.0;

    /** Sums for the slope of a straight line by least squares. */
    struct Line
    {
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;

      void add(const double at, const double value)
      {
        n += 1;
        x += at;
        y += value;
        xx += at * at;
        xy += at * value;
      }
      double slope() const { return (n * xy - x * y) / (n * xx - x * x); }
    };
  } // namespace

  void SidewaysStrain::note(const dem::ObservedSpecimen &specimen, const int axis, const double stress)
  {
    if (!(stress > 0) || (!notes.empty() && !(stress > growth * notes[notes.size() - note_length])))
      return;
    const dem::ParticleKinematics now  = specimen.kinematics();
    const int                     dims = specimen.parameters().physics.dimension;
    double                        low = 1e300, high = -1e300;
    const auto place = [&](const std::size_t i, const int d) { return now.position[i][d] - now.displacement[i][d]; };
    for (std::size_t i = 0; i < now.position.size(); ++i)
      {
        low  = std::min(low, place(i, axis));
        high = std::max(high, place(i, axis));
      }
    std::array<Line, 3> lines;
    for (std::size_t i = 0; i < now.position.size(); ++i)
      if (now.held[i] == 0 && std::fabs(place(i, axis) - 0.5 * (low + high)) <= 0.25 * (high - low))
        for (int d = 0; d < dims; ++d)
          lines[static_cast<std::size_t>(d)].add(place(i, d), now.displacement[i][d]);
    double across = 0;
    for (int d = 0; d < dims; ++d)
      if (d != axis)
        across += lines[static_cast<std::size_t>(d)].slope() / (dims - 1);
    const double along = lines[static_cast<std::size_t>(axis)].slope();
    if (std::isfinite(across) && std::isfinite(along)) // too few particles
      notes.insert(notes.end(), {stress, along, across});
  }

  std::optional<double> SidewaysStrain::poisson_ratio(const double largest_stress) const
  {
    Line line;
    for (std::size_t at = 0; at < notes.size(); at += note_length)
      if (notes[at] <= elastic_part * largest_stress)
        line.add(notes[at + 1], notes[at + 2]);
    if (line.n < 3)
      return std::nullopt;
    return -line.slope();
  }
} // namespace apps

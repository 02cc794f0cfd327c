#include "coupling/sequential/cut_comparison.h"

#include "coupling/sequential/transfer_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coupling
{
  namespace
  {
    double worst(const CutComparison &cuts, Eigen::Vector3d SectionForce::*what, const double least)
    {
      double difference = 0, size = least;
      for (std::size_t s = 0; s < cuts.points.size(); ++s)
        {
          difference = std::max(difference, (cuts.points[s].*what - cuts.particles[s].*what).norm());
          size       = std::max({size, (cuts.points[s].*what).norm(), (cuts.particles[s].*what).norm()});
        }
      return size > 0 ? difference / size : 0;
    }

    /** As if the slab were filled by that volume. */
    SectionForce filled(SectionForce slab, const double volume)
    {
      slab.force *= volume / slab.volume;
      slab.moment *= volume / slab.volume;
      return slab;
    }
  } // namespace

  double CutComparison::force_error(const double strength) const
  {
    return worst(*this, &SectionForce::force, strength * section);
  }

  double CutComparison::moment_error(const double strength) const
  {
    double largest = strength * section; // an axial force off the middle is no bending to speak of: its own size counts
    for (const auto *side : {&points, &particles})
      for (const SectionForce &slab : *side)
        largest = std::max(largest, slab.force.norm());
    return worst(*this, &SectionForce::moment, largest * std::sqrt(section) / 6);
  }

  CutComparison compare_cuts(const ParticleField &field, const std::vector<MappedPoint> &points)
  {
    if (points.empty() || field.size() == 0)
      return {};
    Eigen::Vector3d              low = points.front().place, high = low;
    std::vector<Eigen::Vector3d> place;
    std::vector<double>          volume;
    std::vector<Eigen::Matrix3d> stress;
    double                       size = 0;
    for (const MappedPoint &p : points)
      {
        low  = low.cwiseMin(p.place);
        high = high.cwiseMax(p.place);
        size += p.size / static_cast<double>(points.size());
        place.push_back(p.place);
        volume.push_back(p.volume);
        stress.push_back(p.average.stress);
      }
    Sections sections;
    (high - low).maxCoeff(&sections.axis);
    for (const Eigen::Vector3d &x : field.place)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    sections.low            = low[sections.axis];
    sections.high           = high[sections.axis];
    sections.centre         = 0.5 * (low + high);
    const double length     = sections.high - sections.low;
    sections.count          = static_cast<int>(std::clamp(std::round(length / std::max(size, 1e-300)), 1.0, 20.0));
    const auto by_points    = section_forces(sections, place, volume, stress),
               by_particles = section_forces(sections, field.place, field.volume, field.stress);

    const auto sum = [](const std::vector<double> &volumes) {
      return std::accumulate(volumes.begin(), volumes.end(), 0.0);
    };
    const double  parts = static_cast<double>(field.size()), all = parts + static_cast<double>(field.left_out);
    CutComparison cuts;
    cuts.filled = sum(field.volume) * all / parts / sum(volume);
    for (std::size_t s = 0; s < by_points.size(); ++s)
      if (by_points[s].volume > 0 && by_particles[s].volume > 0) // particles in grips are left out
        {
          cuts.points.push_back(by_points[s]);
          cuts.particles.push_back(filled(by_particles[s], by_points[s].volume));
          cuts.section += by_points[s].volume * sections.count / length;
        }
    if (!cuts.points.empty())
      cuts.section /= static_cast<double>(cuts.points.size());
    return cuts;
  }
} // namespace coupling

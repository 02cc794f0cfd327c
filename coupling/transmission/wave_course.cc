#include "coupling/transmission/wave_course.h"

#include <cmath>

namespace coupling
{
  using Eigen::Vector3d;
  using Lattice = WaveMedium::Lattice;

  namespace
  {
    // Of the packet's centre from the overlap, over its width. Near the cut-off of a mesh packets are slow: they have to get away.
    constexpr double packet_start = 4.2, packet_end = 6;
    // What runs to the left comes back too late to matter. Steps in time make short waves faster, by a third at most.
    constexpr double faster = 4.0 / 3.0;

    /** As wide as it is long, in the middle of free edges that it does not reach. */
    WaveCourse narrow_course(const WaveCase &wave)
    {
      constexpr double away = 3.2; // over the width, where a packet has ended: 4e-5 of its amplitude
      const double     a = wave.medium.spacing, h = static_cast<double>(wave.element) * a;
      WaveCourse       course;
      course.width       = 1.5 * wave.wavelength;
      course.direction   = {std::cos(wave.angle), std::sin(wave.angle), 0};
      course.overlap_end = static_cast<double>(wave.overlap) * h;
      const double clear = away * course.width, way = (2 * clear + course.overlap_end) / course.direction.x(),
                   rise = way * course.direction.y();
      course.start      = {-clear, 0, 0};
      course.left       = -a * std::ceil((2 * clear + faster * 0.5 * way * course.direction.x()) / a);
      course.right      = h * std::ceil((course.overlap_end + 2 * clear) / h);
      course.bottom     = -h * std::ceil(clear / h);
      course.top        = h * std::ceil((rise + clear) / h);
      course.duration   = way / wave.medium.group_speed(wave.shear, 2 * M_PI / wave.wavelength);
      return course;
    }
  } // namespace

  WaveCourse course_of(const WaveCase &wave)
  {
    if (wave.medium.lattice == Lattice::plane)
      return narrow_course(wave);
    const double a = wave.medium.spacing, h = static_cast<double>(wave.element) * a, height = wave.medium.height();
    WaveCourse   course;
    course.width       = (wave.wavelength > 48 * a ? 2 : 3) * wave.wavelength;
    course.direction   = Vector3d::UnitX();
    course.overlap_end = static_cast<double>(wave.overlap) * h;
    course.start       = {-packet_start * course.width, 0, 0};
    course.left  = -a * std::ceil((packet_start + faster * (0.5 * (packet_start + packet_end) + 2)) * course.width / a);
    course.right = h * std::ceil((faster * (packet_end + 3.5) * course.width + 20 * h) / h);
    course.bottom = wave.medium.lattice == Lattice::chain ? -0.5 * height : 0.0;
    course.top    = course.bottom + height;
    course.duration =
      (packet_start + packet_end) * course.width / wave.medium.group_speed(wave.shear, 2 * M_PI / wave.wavelength);
    return course;
  }

  Vector3d packet_velocity(const WaveCase &wave, const WaveCourse &course, const Vector3d &place)
  {
    const Vector3d away = place - course.start, along = course.direction,
                   across(-course.direction.y(), course.direction.x(), 0);
    const double ahead  = away.dot(along) / course.width,
                 aside  = wave.medium.lattice == Lattice::plane ? away.dot(across) / course.width : 0.0,
                 phase  = 2 * M_PI / wave.wavelength * away.dot(along),
                 cycles = 2 * M_PI * course.width / wave.wavelength;
    const double value =
      std::exp(-ahead * ahead - aside * aside) * (std::cos(phase) - 2 * ahead / cycles * std::sin(phase));
    return value * (wave.shear ? across : along);
  }
} // namespace coupling

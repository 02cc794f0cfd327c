#include "dem/facets/glide_pushes.h"

#include <Eigen/Geometry>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    Vector3d part(const base::Column &column, const std::int32_t particle, const std::size_t from)
    {
      return Vector3d(&column[record_size * static_cast<std::size_t>(particle) + from]);
    }
  } // namespace

  void GlidePushes::add_impulses(const SurfaceContacts &surfaces,
                                 const double           kick,
                                 const double           glided,
                                 const base::Column    &velocity)
  {
    surfaces.each_push(
      [&](const std::int32_t surface, const std::int32_t i, const Vector3d &force, const Vector3d &moment) {
        Push &push = pushes[{surface, i}];
        push.impulse += kick * force;
        push.turn += kick * (moment + (glided * part(velocity, i, 0)).cross(force));
      });
  }

  void GlidePushes::enter_work(const SurfaceContacts &surfaces, const base::Column &motion, const std::size_t half)
  {
    surfaces.each_push(
      [&](const std::int32_t surface, const std::int32_t i, const Vector3d &force, const Vector3d &moment) {
        pushes[{surface, i}].work[half] += 0.5 * (force.dot(part(motion, i, 0)) + moment.dot(part(motion, i, 3)));
      });
  }

  void GlidePushes::add_work(const SurfaceContacts &surfaces, const base::Column &motion)
  {
    enter_work(surfaces, motion, 1);
  }

  void GlidePushes::add_work_before(const SurfaceContacts &surfaces, const base::Column &motion)
  {
    enter_work(surfaces, motion, 0);
  }

  base::Column GlidePushes::mean(const std::size_t particles, const double kick) const
  {
    base::Column records(record_size * particles, 0.0);
    for (const auto &[pair, push] : pushes)
      for (std::size_t c = 0; c < 3; ++c)
        {
          double *record = &records[record_size * static_cast<std::size_t>(pair.second)];
          record[c] += push.impulse[static_cast<Eigen::Index>(c)] / kick;
          record[3 + c] += push.turn[static_cast<Eigen::Index>(c)] / kick;
        }
    return records;
  }

  std::array<double, 2> GlidePushes::enter_difference(SurfaceContacts &surfaces, const GlideRates &rates) const
  {
    std::array<double, 2> sum  = {0, 0};
    const double          kick = rates.half_before + rates.half_after;
    for (const auto &[pair, push] : pushes)
      for (const std::size_t half : {std::size_t{0}, std::size_t{1}})
        {
          const base::Column &rate  = half == 0 ? *rates.before : *rates.after;
          const double        share = (half == 0 ? rates.half_before : rates.half_after) / kick,
                       more         = share * (push.impulse.dot(part(rate, pair.second, 0)) +
                                       push.turn.dot(part(rate, pair.second, 3))) -
                              push.work[half];
          surfaces.surface(static_cast<std::size_t>(pair.first)).work += more;
          sum[half] += more;
        }
    return sum;
  }
} // namespace dem

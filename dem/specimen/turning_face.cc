#include "dem/specimen/turning_face.h"

#include "dem/grips/grip_face.h"

#include <Eigen/LU>

namespace dem
{
  namespace
  {
    /** A turn w moves what is at r by w x r: along the normal by w_b r_c - w_c r_b, so that theta = (-w_c, w_b). */
    constexpr std::array<int, 2>    axis_of_turn = {1, 0}; // of the two across, by the component of theta
    constexpr std::array<double, 2> sense        = {-1, 1};
  } // namespace

  TurningFace::TurningFace(const Grip                      &grip,
                           const std::vector<std::int32_t> &members,
                           const Particles                 &particles,
                           const int                        dimension)
    : normal(*grip.turning_face)
  {
    std::vector<Eigen::Vector3d> places;
    for (const std::int32_t i : members)
      places.emplace_back(&particles.pose[record_size * static_cast<std::size_t>(i)]);
    arms                    = arms_in_face(places, normal, dimension);
    Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero();
    for (int c = 0; c < 2; ++c)
      spins[c] = grip.prescribed[3 + across(normal, axis_of_turn[c])];
    for (std::size_t k = 0; k < members.size(); ++k)
      {
        const auto i = static_cast<std::size_t>(members[k]);
        inertia += particles.mass[i] * arms[k] * arms[k].transpose();
        for (int c = 0; c < 2; ++c)
          inertia(c, c) += spins[c] ? particles.inertia[i] : 0.0;
      }
    for (int c = 0; c < 2; ++c)
      if (inertia(c, c) == 0) // out of the plane, where nothing pushes
        inertia(c, c) = 1;
    inverse_inertia = inertia.inverse();
  }

  void TurningFace::push(const std::vector<std::int32_t> &members, const Particles &particles, const double time)
  {
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < members.size(); ++k)
      {
        const double *force = &particles.force[record_size * static_cast<std::size_t>(members[k])];
        moment += force[normal] * arms[k];
        for (int c = 0; c < 2; ++c)
          moment[c] += spins[c] ? sense[c] * force[3 + across(normal, axis_of_turn[c])] : 0.0;
      }
    slope_rate += time * (inverse_inertia * moment);
  }

  std::array<double, 6> TurningFace::rates(const std::size_t member) const
  {
    std::array<double, 6> added{};
    added[normal] = slope_rate.dot(arms[member]);
    for (int c = 0; c < 2; ++c)
      added[3 + across(normal, axis_of_turn[c])] = spins[c] ? sense[c] * slope_rate[c] : 0.0;
    return added;
  }
} // namespace dem

#include "coupling/participants/participant.h"

#include <Eigen/Geometry>

namespace coupling
{
  Momentum momentum_of(const Participant &participant)
  {
    Momentum          sum;
    const std::size_t carriers = participant.carriers();
    for (std::size_t i = 0; i < carriers; ++i)
      {
        const Eigen::Vector3d carried = participant.mass(i) * participant.velocity(i);
        sum.linear += carried;
        sum.angular += participant.position(i).cross(carried);
      }
    return sum;
  }
} // namespace coupling

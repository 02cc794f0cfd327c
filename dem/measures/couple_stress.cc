#include "dem/measures/couple_stress.h"

#include "dem/measures/stress.h"

#include <Eigen/Geometry>

namespace dem
{
  namespace
  {
    /** x_0 (x) (1 x V sigma): takes the moment of the unsymmetric stress to the centroid. */
    template <typename Load>
    Eigen::Matrix3d centroid_part(const std::vector<Load> &loads, const Eigen::Vector3d &centroid)
    {
      return centroid * axial(stress_moment(loads)).transpose();
    }
  } // namespace

  Eigen::Matrix3d couple_stress_moment(const std::vector<LinkLoad> &links, const Eigen::Vector3d &centroid)
  {
    Eigen::Matrix3d sum = centroid_part(links, centroid);
    for (const LinkLoad &l : links)
      {
        const Eigen::Vector3d about_first  = (l.contact - l.first).cross(l.force),
                              about_second = (l.contact - l.second()).cross(l.force);
        sum +=
          l.branch * l.couple.transpose() + l.second() * about_second.transpose() - l.first * about_first.transpose();
      }
    return sum;
  }

  Eigen::Matrix3d couple_stress_moment(const std::vector<ExternalLoad> &loads, const Eigen::Vector3d &centroid)
  {
    Eigen::Matrix3d sum = centroid_part(loads, centroid);
    for (const ExternalLoad &load : loads)
      sum += load.place * load.couple.transpose();
    return sum;
  }

  Eigen::Matrix3d periodic_couple_stress_moment(const std::vector<LinkLoad>       &links,
                                                const std::vector<ParticleMoment> &particles,
                                                const Eigen::Vector3d             &centroid)
  {
    Eigen::Matrix3d sum = centroid_part(links, centroid);
    for (const LinkLoad &l : links)
      sum += l.branch * l.couple.transpose();
    for (const ParticleMoment &p : particles)
      sum -= p.place * p.moment.transpose();
    return sum;
  }
} // namespace dem

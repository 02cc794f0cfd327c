#include "dem/observation/path_output.h"

#include "dem/measures/bulk_volume.h"

#include <numeric>

namespace dem
{
  namespace
  {
    /** Shares of the volume, voids included, of the cell or of the body [m^3]. */
    std::vector<double>
    volumes(const ElasticNetwork &network, const std::vector<double> &radius, const ParticleShape &shape)
    {
      std::vector<double> solid;
      for (const double r : radius)
        solid.push_back(shape.volume(r));
      const double total = std::accumulate(solid.begin(), solid.end(), 0.0);
      const double bulk  = network.periodic() ?
                             network.volume / total :
                             bulk_over_solid(network.centre, radius, solid, shape.dimension, shape.thickness);
      for (double &v : solid)
        v *= bulk;
      return solid;
    }
  } // namespace

  std::vector<Eigen::Vector3d> displacements_of(const LoadedNetwork &loaded, const LoadedMotion &motion)
  {
    std::vector<Eigen::Vector3d> u(loaded.network.particles());
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] = motion.particles.col(static_cast<Eigen::Index>(i)).head<3>() + loaded.carried[i] * motion.loads;
    return u;
  }

  ParticleOutput particles_of(const LoadedNetwork       &loaded,
                              const QuasiStaticPath     &path,
                              const std::vector<double> &radius,
                              const ParticleShape       &shape)
  {
    const ElasticNetwork &network = loaded.network;
    const DamagingLinks  &links   = path.links();
    const std::size_t     n       = network.particles();
    ParticleOutput        out;
    out.displacement = displacements_of(loaded, path.motion());
    out.position     = network.centre;
    for (std::size_t i = 0; i < n; ++i)
      out.position[i] += out.displacement[i];
    out.velocity.assign(n, Eigen::Vector3d::Zero());
    out.angular_velocity = out.velocity;
    out.radius           = radius;
    out.material         = network.material;
    out.damage.assign(n, 0.0);
    out.broken_links.assign(n, 0);
    out.held.assign(n, 0);
    if (!network.periodic())
      for (std::size_t i = 0; i < n; ++i)
        out.held[i] = !loaded.carried[i].isZero(0);
    out.stress.assign(n, Eigen::Matrix3d::Zero());
    out.volume = volumes(network, radius, shape);
    std::vector<int> ends(n, 0);
    for (std::size_t l = 0; l < links.size(); ++l)
      {
        const ElasticLink    &link = network.links[l];
        const Eigen::Matrix3d moment =
          0.5 * (link.direction * links.forces()[l].transpose() + links.forces()[l] * link.direction.transpose());
        for (const auto &[i, arm] : {std::pair{link.first, link.arm_first}, std::pair{link.second, link.arm_second}})
          {
            ++ends[i];
            out.damage[i] += links.damage_of(l).stiffness;
            out.broken_links[i] += links.is_exhausted(l);
            out.stress[i] += arm * moment / out.volume[i];
          }
      }
    for (std::size_t i = 0; i < n; ++i)
      if (ends[i] > 0)
        out.damage[i] /= ends[i];
    return out;
  }

  LinkOutput links_of(const LoadedNetwork &loaded, const QuasiStaticPath &path)
  {
    const DamagingLinks               &links = path.links();
    const std::vector<Eigen::Vector3d> u     = displacements_of(loaded, path.motion());
    LinkOutput                         out;
    for (std::size_t l = 0; l < links.size(); ++l)
      {
        const ElasticLink    &link   = loaded.network.links[l];
        const Eigen::Vector3d f      = links.forces()[l];
        const double          normal = f.dot(link.direction), shear = (f - normal * link.direction).norm();
        out.ends.push_back({static_cast<std::size_t>(link.first), static_cast<std::size_t>(link.second)});
        if (!loaded.network.material.empty())
          out.pair.push_back(link.pair);
        out.kind.push_back(links.is_exhausted(l) ? LinkOutput::broken : LinkOutput::cohesive);
        out.normal_force.push_back(normal);
        out.shear_force.push_back(shear);
        out.normal_stress.push_back(normal / link.area);
        out.shear_stress.push_back(shear / link.area);
        out.normal_strain.push_back(links.normal_strain(l));
        out.damage.push_back(links.damage_of(l).stiffness);
        out.strength_damage.push_back(links.damage_of(l).strength);
        out.dissipated.push_back(links.damage_work_of(l));
        const Eigen::Vector3d first = loaded.network.centre[link.first] + u[link.first];
        const Eigen::Vector3d branch =
          link.branch + path.links().normal_strain(l) * link.branch.norm() * link.direction;
        out.load.push_back({first, branch, first + link.arm_first * link.direction, f,
                            links.moments().empty() ? Eigen::Vector3d(0, 0, 0) : links.moments()[l]});
      }
    return out;
  }
} // namespace dem

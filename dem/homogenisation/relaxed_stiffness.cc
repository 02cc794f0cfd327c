#include "dem/homogenisation/relaxed_stiffness.h"

#include "dem/homogenisation/resisted_strains.h"
#include "dem/model/strain_operator.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>

namespace dem
{
  namespace
  {
    /** One unit strain per load lane; in the plane only those in the plane. */
    LaneStrains unit_strains(const int dimension)
    {
      LaneStrains strain;
      for (int lane = 0; lane < load_lanes; ++lane)
        {
          strain[lane].setZero();
          const bool exists = lane < first_probe && (dimension == 3 || lane < 2 || lane == 5);
          if (exists)
            strain[lane][lane] = 1;
        }
      return strain;
    }

    std::vector<base::Matrix6> motions_of(const StiffnessOperator &stiffness, const Fields &x)
    {
      std::vector<base::Matrix6> motion(stiffness.particles());
      for (std::size_t i = 0; i < stiffness.particles(); ++i)
        for (int c = 0; c < motions; ++c)
          for (int lane = 0; lane < first_probe; ++lane)
            motion[stiffness.order()[i]](c, lane) =
              x[(motions * i + c) * load_lanes + lane] / (c < 3 ? 1.0 : stiffness.length_scale());
      return motion;
    }
  } // namespace

  RelaxedStiffness relaxed_stiffness(const ElasticNetwork   &network,
                                     const SolverParameters &parameters,
                                     const CellFormulation   formulation)
  {
    if (!network.periodic())
      throw std::invalid_argument("homogenisation: a free packing has no volume to refer a stiffness to.");
    const StiffnessOperator stiffness(network, {}, formulation);
    const LaneStrains       strain = unit_strains(network.dimension);
    Fields                  x(network.particles() * motions * load_lanes, 0.0);
    RelaxedStiffness        relaxed;
    relaxed.solver    = solve_linear(stiffness, {}, x, strain, true, parameters);
    relaxed.stiffness = stiffness.energy_product(x, strain) / network.volume;
    relaxed.resisted  = remove_unresisted(relaxed.stiffness, affine_stiffness(network), network.dimension);
    relaxed.motion    = motions_of(stiffness, x);
    return relaxed;
  }

  Eigen::Matrix<double, 3, 6> strain_localisation(const ElasticLink &link, const RelaxedStiffness &relaxed)
  {
    const auto                 &J = relaxed.motion[link.first], &K = relaxed.motion[link.second];
    Eigen::Matrix<double, 3, 6> M = strain_operator(link.branch) + K.topRows<3>() - J.topRows<3>();
    for (int c = 0; c < 6; ++c)
      {
        const Eigen::Vector3d spin = link.arm_first * J.col(c).tail<3>() + link.arm_second * K.col(c).tail<3>();
        M.col(c) += link.direction.cross(spin);
      }
    return M / link.branch.norm();
  }
} // namespace dem

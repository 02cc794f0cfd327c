#include "dem/homogenisation/macroscopic_stiffness.h"

#include "dem/model/strain_operator.h"

#include <stdexcept>

namespace dem
{
  namespace
  {
    void require_periodic(const ElasticNetwork &network)
    {
      if (!network.periodic())
        throw std::invalid_argument("homogenisation: a free packing has no volume to refer a stiffness to.");
    }

    struct Lame
    {
      double lambda, mu;
    };

    /** Mean of n n n n over the sphere is (1/15), over the circle (1/8) of the symmetric combination of identities. */
    Lame closed_form_lame(const LinkStatistics &s, const double normal, const double shear)
    {
      if (s.dimension == 3)
        return {s.length_area / 15 * (normal - shear), s.length_area / 30 * (2 * normal + 3 * shear)};
      return {s.length_area / 8 * (normal - shear), s.length_area / 8 * (normal + shear)};
    }
  } // namespace

  LinkStatistics link_statistics(const ElasticNetwork &network)
  {
    require_periodic(network);
    LinkStatistics statistics;
    statistics.dimension = network.dimension;
    for (const ElasticLink &link : network.links)
      statistics.length_area += link.branch.norm() * link.area;
    statistics.length_area /= network.volume;
    return statistics;
  }

  LinkModuli mean_moduli(const ElasticNetwork &network)
  {
    const double across      = network.dimension - 1;
    double       length_area = 0;
    LinkModuli   sum;
    for (const ElasticLink &link : network.links)
      {
        const double           square = link.branch.squaredNorm();
        const Eigen::Matrix3d &C      = link.stiffness;
        const double           along  = link.direction.dot(C * link.direction);
        const double           trace  = network.dimension == 3 ? C.trace() : C.topLeftCorner<2, 2>().trace();
        length_area += link.branch.norm() * link.area;
        sum.normal += square * along;
        sum.shear += square * (trace - along) / across;
      }
    return {sum.normal / length_area, sum.shear / length_area};
  }

  ElasticConstants closed_form(const LinkStatistics &s, const double normal_modulus, const double shear_ratio)
  {
    const double normal = normal_modulus, shear = shear_ratio * normal_modulus;
    if (s.dimension == 3)
      return {s.density() * normal * (2 * normal + 3 * shear) / (4 * normal + shear),
              (normal - shear) / (4 * normal + shear)};
    return {s.length_area * normal * (normal + shear) / (3 * normal + shear), (normal - shear) / (3 * normal + shear)};
  }

  MacroscopicStiffness
  closed_form_stiffness(const LinkStatistics &s, const double normal_modulus, const double shear_ratio)
  {
    const Lame           lame    = closed_form_lame(s, normal_modulus, shear_ratio * normal_modulus);
    const bool           space   = s.dimension == 3;
    const int            normals = space ? 3 : 2;
    MacroscopicStiffness D       = MacroscopicStiffness::Zero();
    for (int i = 0; i < normals; ++i)
      {
        D(i, i) = 2 * lame.mu;
        for (int j = 0; j < normals; ++j)
          D(i, j) += lame.lambda;
      }
    for (int i = space ? 3 : 5; i < 6; ++i)
      D(i, i) = lame.mu;
    return D;
  }

  MacroscopicStiffness affine_stiffness(const ElasticNetwork &network)
  {
    require_periodic(network);
    MacroscopicStiffness D = MacroscopicStiffness::Zero();
    for (const ElasticLink &link : network.links)
      {
        const Eigen::Matrix<double, 3, 6> H = strain_operator(link.branch);
        D.noalias() += H.transpose() * (link.stiffness * H);
      }
    if (network.dimension == 2) // shear links would resist strains out of the plane, but discs do not make them
      for (int i = 2; i < 5; ++i)
        {
          D.row(i).setZero();
          D.col(i).setZero();
        }
    return 0.5 / network.volume * (D + D.transpose());
  }
} // namespace dem

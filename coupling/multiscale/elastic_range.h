#pragma once

#include "base/voigt.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/model/materials.h"
#include "dem/network/elastic_network.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace coupling
{
  /**
   * How near the links of an elastic cell are to damage and sliding under a macroscopic strain: all of them at once, because their slips
   * are linear in it (doc/theory/multiscale.md, 2; the operators: doc/theory/homogenisation.md, 3).
   */
  class ElasticRange
  {
  public:
    /**
     * @param network with the stiffnesses of the materials' law @param relaxed of it, with CellFormulation::fluctuation
     * @param threshold exertion that is watched for, in (0, 1]
     * @throws base::InputError for a threshold out of range, and for a law whose links are not linear from their first step on
     */
    ElasticRange(const dem::ElasticNetwork   &network,
                 const dem::LinkMaterials    &materials,
                 const dem::RelaxedStiffness &relaxed,
                 double                       threshold);

    struct Nearest
    {
      double exertion  = 0; ///< of the link nearest to damage or sliding: 1 where elasticity ends (dem::LinkExertion)
      std::size_t link = 0;
    };

    /** @param strain engineering shears, order xx yy zz yz zx xy */
    Nearest nearest(const base::Voigt &strain) const;

    /**
     * Whether no link can have come to the threshold, without visiting any: a bound by the energy of the strain. It holds for laws
     * whose links are elastic in a convex set of slips; never true of links with moments.
     */
    bool surely_below(const base::Voigt &strain) const { return strain.dot(stiffness * strain) < safe_energy; }

    bool left_by(const base::Voigt &strain) const
    {
      return !surely_below(strain) && nearest(strain).exertion >= watched;
    }

  private:
    /** @param normal strain @param across shear strain @param turn relative rotation, all of the link under load */
    double exertion(std::size_t            link,
                    double                 normal,
                    const Eigen::Vector3d &across,
                    const Eigen::Vector3d &turn,
                    std::vector<double>   &after) const;
    double energy_to_threshold(std::size_t link, std::vector<double> &after) const;
    void   refuse_curved_links() const;

    std::shared_ptr<const dem::LinkLaw>      law;
    std::vector<dem::ElasticLink>            links;
    std::size_t                              columns;
    std::vector<double>                      history; ///< of new links, a row each
    Eigen::Matrix<double, Eigen::Dynamic, 6> slips,
      turns; ///< strain and relative rotation by macroscopic strain, three rows per link
    base::Stiffness stiffness;
    double          watched, safe_energy = 0; ///< [J/m^3], twice
  };
} // namespace coupling

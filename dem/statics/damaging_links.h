#pragma once

#include "dem/laws/cpm.h"
#include "dem/statics/elastic_network.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** Small motion of a periodic cell: the macroscopic strain, and what the particles do beyond following it. */
  struct CellMotion
  {
    Eigen::Matrix<double, 6, Eigen::Dynamic> particles; ///< displacement [m], rotation [-] of each
    Eigen::Matrix<double, 6, 1>              strain;    ///< engineering shears, order 11 22 33 23 31 12
  };

  /** Relative displacement of the two ends at the contact point of a link [m]; homogenisation specification 3.1. */
  Eigen::Vector3d slip_of(const ElasticLink &link, const CellMotion &motion);

  /**
   * The links of a network as CPM links at small strain: geometry stays, strains follow from the motion, damage and sliding
   * from the law. A trial is evaluated from the committed state as often as wanted, and becomes the state by commit().
   *
   * An exhausted link is not deleted: it carries nothing in tension and, at its original length, still resists compression.
   */
  class DamagingLinks
  {
  public:
    /** @param network with stiffnesses of the same normal modulus and shear ratio as the law; must outlive this object */
    DamagingLinks(const ElasticNetwork &network, const CpmParameters &law);

    void evaluate(const CellMotion &motion);
    void commit();

    /** Force of each link on its first end, of the trial [N]. */
    const std::vector<Eigen::Vector3d> &forces() const { return force; }
    /** Secant stiffness of the trial: damaged along open links, and as soft in shear as a sliding link has become. */
    const std::vector<Eigen::Matrix3d> &secants() const { return secant; }
    /** Normal strain of each link in the trial [-]. */
    double normal_strain(const std::size_t link) const { return trial_strain[link]; }
    /** How much the equivalent strain of a damaging link has grown past its largest so far, in the trial; 0 of others. */
    double growth(std::size_t link) const;

    double mean_damage() const; ///< committed
    /** Energy lost to damage and sliding in committed steps [J]. */
    double dissipated() const { return lost; }
    /** Energy stored in the links, committed [J]. */
    double stored() const;

  private:
    const ElasticNetwork               *network;
    CpmConstants                        law;
    std::vector<CpmState<double, 3>>    state, trial;
    std::vector<Eigen::Vector3d>        shear, trial_shear; ///< total shear strain
    std::vector<double>                 strain, trial_strain;
    std::vector<CpmResponse<double, 3>> response;
    std::vector<Eigen::Vector3d>        force;
    std::vector<Eigen::Matrix3d>        secant;
    double                              lost = 0;
  };
} // namespace dem

#pragma once

#include "dem/laws/cpm_table.h"
#include "dem/laws/cpm_tangent.h"
#include "dem/state.h"
#include "dem/statics/loaded_network.h"

#include <vector>

namespace dem
{
  /** Which linearisation steers an iteration. */
  enum class LinkStiffness
  {
    tangent, ///< consistent with the update
    onward,  ///< the same, where links that damaged or slid in the step before are taken to go on
    secant   ///< positive definite
  };

  /**
   * The links of a network as CPM links at small strain: geometry stays, strains follow from the motion, damage and sliding
   * from the law. A trial is evaluated from the committed state as often as wanted, and becomes the state by commit().
   *
   * An exhausted link is not deleted: it carries nothing in tension and, at its original length, still resists compression.
   */
  class DamagingLinks
  {
  public:
    /** @param loaded made with the same materials (or moduli, if there is one); must outlive this object */
    DamagingLinks(const LoadedNetwork &loaded, const CpmMaterials &materials);

    void evaluate(const LoadedMotion &motion);
    void commit();

    std::size_t size() const { return state.size(); }
    /** Force of each link on its first end, of the trial [N]. */
    const std::vector<Eigen::Vector3d> &forces() const { return force; }
    /** Force per slip of each link, of the trial [N/m]. */
    std::vector<Eigen::Matrix3d> stiffness(LinkStiffness kind) const;

    /** Normal strain of a link in the trial [-]. */
    double normal_strain(const std::size_t link) const { return trial_strain[link]; }
    /** Strain that a link must exceed to damage further: the largest of committed steps, not below the onset [-]. */
    double reached(const std::size_t link) const { return std::max(state[link].kappa, law_of(link).onset); }
    /** How much that strain has grown in the trial, over itself [-]. */
    double growth(const std::size_t link) const
    {
      return std::max(trial[link].kappa - reached(link), 0.0) / reached(link);
    }
    double largest_growth() const;
    /** Whether it damaged in the last committed step (or in those since forget_growth()). */
    bool grew(const std::size_t link) const { return grown[link] != 0; }
    void forget_growth();

    double damage_of(const std::size_t link) const { return state[link].damage; } ///< committed
    double strength_damage_of(std::size_t link) const;                            ///< committed
    double damage_work_of(std::size_t link) const; ///< energy lost to its damage, committed; 0 where shear damages [J]
    /** It has met the break test: a specimen in motion would have deleted it. */
    bool   is_exhausted(const std::size_t link) const { return state[link].kappa > law_of(link).kappa_broken; }
    double mean_damage() const;                             ///< committed
    double damage_work() const { return lost_by_damage; }   ///< energy lost to damage in committed steps [J]
    double sliding_work() const { return lost_by_sliding; } ///< energy lost to sliding in committed steps [J]
    double stored() const;                                  ///< energy stored in the links, committed [J]

    /** Committed state; call evaluate() after reading. */
    void visit_state(StateVisitor &visitor);

  private:
    CpmUpdate           update_of(std::size_t link) const;
    const CpmConstants &law_of(const std::size_t link) const { return laws[loaded->network.links[link].law]; }

    const LoadedNetwork                *loaded;
    CpmTable                            laws;
    std::vector<CpmState<double, 3>>    state, trial;
    std::vector<Eigen::Vector3d>        shear, trial_shear; ///< total shear strain
    std::vector<Eigen::Vector3d>        unreturned;         ///< elastic shear strain of the trial before it slides
    std::vector<double>                 strain, trial_strain;
    std::vector<CpmResponse<double, 3>> response;
    std::vector<Eigen::Vector3d>        force;
    std::vector<std::int32_t>           grown, slid; ///< in the last committed step, as yes or no
    double                              lost_by_damage = 0, lost_by_sliding = 0;
  };
} // namespace dem

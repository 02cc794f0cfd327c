#pragma once

#include "base/state.h"
#include "dem/model/materials.h"
#include "dem/network/loaded_network.h"

#include <optional>
#include <vector>

namespace dem
{
  /** Which linearisation steers an iteration. */
  enum class LinkStiffness
  {
    consistent, ///< with the update
    onward,     ///< the same, where links that damaged or slid in the step before are taken to go on
    secant      ///< positive definite
  };

  /** Energy that links have lost [J]. */
  struct LinkLosses
  {
    double damage = 0, sliding = 0;
  };

  /**
   * The links of a network at small strain: geometry stays, strains follow from the motion, damage and sliding from their law. A
   * trial is evaluated from the committed state as often as wanted, and becomes the state by commit().
   *
   * A link that is gone is not deleted: it answers as its law says, and may still resist compression.
   */
  class DamagingLinks
  {
  public:
    /** @param loaded made with the same materials (or moduli, if there is one); must outlive this object */
    DamagingLinks(const LoadedNetwork &loaded, const LinkMaterials &materials);

    void evaluate(const LoadedMotion &motion);
    void commit();

    std::size_t size() const { return strain.size(); }
    /** Force of each link on its first end, of the trial [N]. */
    const std::vector<Eigen::Vector3d> &forces() const { return force; }
    /** Moment of each link on its first end at the contact point, of the trial [N m]; empty for a law without. */
    const std::vector<Eigen::Vector3d> &moments() const { return moment; }
    /** Force and moment per slip and relative rotation of each link, of the trial [N/m], [N m]. */
    std::vector<base::Matrix6> stiffness(LinkStiffness kind) const;

    /** Normal strain of a link in the trial [-]. */
    double normal_strain(const std::size_t link) const { return trial_strain[link]; }
    /** Strain that a link must exceed to damage further [-]; see LinkLaw::damaging_strain() */
    double reached(const std::size_t link) const { return law->damaging_strain(pair_of(link), row(state, link)); }
    /** How much that strain has grown in the trial, over itself [-]. */
    double growth(std::size_t link) const;
    double largest_growth() const;
    /** How near a link is to damage or to sliding in the trial: 1 where either begins (LinkExertion). */
    double exertion(std::size_t link) const;
    /** Whether it damaged in the last committed step (or in those since forget_growth()). */
    bool grew(const std::size_t link) const { return grown[link] != 0; }
    void forget_growth();

    LinkLoss damage_of(std::size_t link) const;    ///< committed
    double damage_work_of(std::size_t link) const; ///< energy lost to its damage, committed, where the law knows it [J]
    /** A specimen in motion would have deleted it, or would have it as a contact. */
    bool   is_exhausted(std::size_t link) const;
    double mean_damage() const;                             ///< committed
    double damage_work() const { return lost_by_damage; }   ///< energy lost to damage in committed steps [J]
    double sliding_work() const { return lost_by_sliding; } ///< energy lost to sliding in committed steps [J]
    double stored() const;                                  ///< energy stored in the links, committed [J]
    double stored_in_trial() const;                         ///< the same of the trial [J]
    /** All that is lost if the trial is committed. */
    LinkLosses lost_with_trial() const;
    /** Whether in the trial every link answers to a further step with the stiffness that it was made with. */
    bool is_undamaged() const;

    /**
     * The committed state of links of another network, where they are the same; the others stay as they were made.
     * @param before the number there of each link
     */
    void take_over(const DamagingLinks &earlier, const std::vector<std::optional<std::size_t>> &before);

    /** Committed state; call evaluate() after reading. */
    void visit_state(base::StateVisitor &visitor);

  private:
    std::size_t   pair_of(const std::size_t link) const { return loaded->network.links[link].pair; }
    const double *row(const std::vector<double> &of, const std::size_t link) const
    {
      return of.data() + columns * link;
    }
    LinkGeometry geometry(std::size_t link, double normal_strain) const;
    LinkStep     step_of(std::size_t link) const; ///< from the committed state to the trial

    const LoadedNetwork           *loaded;
    std::shared_ptr<const LinkLaw> law;
    std::size_t                    columns;                              ///< numbers of a link's history
    std::vector<double>            state, trial;                         ///< histories, link by link
    std::vector<Eigen::Vector3d>   shear, trial_shear, turn, trial_turn; ///< total shear strain, relative rotation
    std::vector<double>            strain, trial_strain;
    std::vector<LinkAnswer>        answer;
    std::vector<Eigen::Vector3d>   force, moment;
    std::vector<std::int32_t>      grown, slid; ///< in the last committed step, as yes or no
    double                         lost_by_damage = 0, lost_by_sliding = 0;
  };
} // namespace dem

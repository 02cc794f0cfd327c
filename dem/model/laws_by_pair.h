#pragma once

#include "dem/model/link_law.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dem
{
  /**
   * Links of which each pair of materials obeys a law of its own kind: a bond law in mortar, another one at its interfaces. To all other code
   * it is one law, whose history holds the columns of all of them, one law after the other; a link uses its own law's, the others stay
   * zero. Its name is those of all, each once: "parallel-bond,contact-bond". Queries of a link are answered by its own law. In the link pass each law goes through its own blocks (LinkSet::first_block).
   */
  class LawsByPair final : public LinkLaw
  {
  public:
    /**
     * @param laws each with constants of every pair up to the last that obeys it; what those of pairs of other laws are does not matter
     * @param kinds of each pair, in the order of material_pair(), which of the laws it obeys; each law has a pair
     */
    LawsByPair(std::vector<std::shared_ptr<const LinkLaw>> laws, std::vector<std::int32_t> kinds);

    LinkPass pass(Mixture mixture) const override;

    std::vector<LinkQuantity> columns() const override;

    double reference_length(std::size_t pair, const NewLink &link) const override;
    void   begin(std::size_t pair, const NewLink &link, double *history) const override;

    LinkStiffnesses stiffness(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    LinkStiffnesses damaged_stiffness(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    LinkPhase       phase(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    std::vector<BrokenElement> broken_elements(std::size_t            pair,
                                               const LinkGeometry    &link,
                                               const Eigen::Vector3d &direction,
                                               const double          *history) const override;
    double                     stored(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    double        damage_dissipation(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    LinkLoss      damage(std::size_t pair, const LinkGeometry &link, const double *history) const override;
    double        damaging_strain(std::size_t pair, const double *history) const override;
    LinkExertion  exertion(std::size_t            pair,
                           const LinkGeometry    &link,
                           const Eigen::Vector3d &direction,
                           const Eigen::Vector3d &force,
                           const double          *history) const override;
    LinkAnswer    update(std::size_t pair, const LinkStep &step, const double *before, double *history) const override;
    base::Matrix6 tangent(
      std::size_t pair, const LinkStep &step, const double *before, const double *history, LinkTangent) const override;

  private:
    static void run_all(LinkSet &links, const Particles &particles, const LinkLaw &law, const LinkLines &lines);

    std::size_t    kind_of(const std::size_t pair) const { return static_cast<std::size_t>(kind[pair]); }
    const LinkLaw &law_of(const std::size_t pair) const { return *law[kind_of(pair)]; }
    /** The own law's part of a history. */
    template <typename Number>
    Number *own(const std::size_t pair, Number *history) const
    {
      return history + first_column[kind_of(pair)];
    }

    std::vector<std::shared_ptr<const LinkLaw>> law;
    std::vector<std::int32_t>                   kind;
    std::vector<std::size_t>                    first_column; ///< of each law
  };
} // namespace dem

#pragma once

#include "dem/network/loaded_network.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <functional>
#include <utility>
#include <vector>

namespace dem
{
  /**
   * Answers of a network some links of which have other stiffnesses than when its system was factorised, from that factor (Woodbury, 1950;
   * doc/theory/quasi-static-path.md, 3): each of these links costs solutions once, and then a row of a small dense system. They follow from
   * the stiffnesses alone, whatever was solved before.
   */
  class ChangedLinks
  {
  public:
    using Solution = std::function<Eigen::MatrixXd(const Eigen::MatrixXd &)>;

    /**
     * @param loaded must outlive this object
     * @param unknown of each motion of each carrier its number, -1 where held, `count` in all, rotations times `scale`
     * @param factorised stiffness of each link
     * @param solution motions of the unknowns under forces on them, with that stiffness
     * @param largest number of components of slip and relative rotation of all links that may differ at a time
     */
    ChangedLinks(const LoadedNetwork       &loaded,
                 const std::vector<int>    &unknown,
                 int                        count,
                 double                     scale,
                 std::vector<base::Matrix6> factorised,
                 Solution                   solution,
                 std::size_t                largest);

    /** Links whose stiffness is not what was factorised, by more than rounding. */
    std::size_t number(const std::vector<base::Matrix6> &stiffness) const;

    /**
     * Answers are from now on those with this stiffness.
     * @param most links that may differ @return false if more do, or in a way that cannot be followed: nothing has changed then
     */
    bool take(const std::vector<base::Matrix6> &stiffness, std::size_t most);

    /** Motions under forces that the factor answers so. @param answers columns; those with the taken stiffness out */
    void correct(Eigen::MatrixXd &answers) const;

    /** Motions with the factor under the forces by which the links that differ answer load parameters otherwise: a column each. */
    Eigen::MatrixXd under_loads(const std::vector<int> &parameters) const;

  private:
    /** What of slip and relative rotation there is, and the unknowns that each component of a link's moves with. */
    using Component = std::vector<std::pair<int, double>>;

    std::vector<Component> components_of(std::size_t link) const;
    void                   find_answers(); ///< of links that have changed for the first time
    void                   make_system();
    double                 along(std::size_t component, std::size_t column) const;

    const LoadedNetwork                 &loaded;
    const std::vector<int>              &unknown;
    int                                  count;
    double                               scale;
    std::vector<base::Matrix6>           before;
    Solution                             solution;
    std::size_t                          largest;
    std::vector<int>                     kept;         ///< components of slip and relative rotation
    std::vector<int>                     place;        ///< of each link its first column below, -1: none
    std::vector<Component>               component;    ///< of each column
    Eigen::MatrixXd                      answer;       ///< motions under a unit of each, columns in use first
    std::vector<std::size_t>             changed;      ///< links, in their order
    std::vector<base::Matrix6>           change;       ///< of their stiffness
    Eigen::MatrixXd                      by_component; ///< changes, one block per link
    Eigen::PartialPivLU<Eigen::MatrixXd> factor;       ///< of the system of the components of all of them
  };
} // namespace dem

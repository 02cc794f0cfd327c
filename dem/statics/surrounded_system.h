#pragma once

#include "dem/network/loaded_network.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace dem
{
  /**
   * What a body and ties make of the linear system of a network's links. Motions that depend on others are left out where that is possible;
   * otherwise multipliers of the ties are unknowns as well (doc/theory/static-handshake.md, 2). Without body and ties it is the system of the links.
   */
  class SurroundedSystem
  {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    /**
     * @param unknown of each motion of each carrier its number, -1 where held, rotations as lengths; `count` in all
     * @param size of stiffnesses [N/m]
     */
    SurroundedSystem(const LoadedNetwork &loaded, const std::vector<int> &unknown, int count, double size);

    /** @param links their system */
    const Sparse &whole(const Sparse &links);
    /** Forces on the unknowns of the links' system, as the whole system wants them. */
    Eigen::MatrixXd forces(const Eigen::MatrixXd &on_unknowns) const;
    /** And back: motions from a solution. */
    Eigen::MatrixXd motions_of(const Eigen::MatrixXd &solution) const;

    /** Whether its diagonal has zeros. */
    bool has_multipliers() const { return borne > 0; }
    /** Multipliers that the system of a network has. */
    static std::size_t multipliers(const LoadedNetwork &loaded);

    /** Motions by the unknowns of the whole system: motions_of() as a matrix; its transpose is forces(). */
    Sparse by_unknowns() const;
    /** The whole system's unknowns of motions that keep the ties, multipliers zero. @param of_links motions, a column each */
    Sparse unknowns_of(const Sparse &of_links) const;

  private:
    void add_body(const LoadedNetwork &loaded, const std::vector<int> &unknown);
    void add_leaders(const Sparse &by_leaders, const std::vector<int> &unknown);
    void add_multipliers(const Sparse &ties, const std::vector<int> &unknown, double size);

    int              count, borne = 0;        ///< unknowns of the links' system, multipliers
    std::vector<int> leading;                 ///< of each column of the leaders its unknown
    bool             surrounded, led = false; ///< whether some motions are left out
    Sparse           around, leaders, sum;    ///< body and ties; motions by the independent ones; with the links
  };
} // namespace dem

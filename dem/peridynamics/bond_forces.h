#pragma once

#include "dem/peridynamics/bonds.h"

#include <vector>

namespace dem::peridynamics
{
  /** What a pass over the bonds counts. */
  struct BondAccount
  {
    std::int64_t broken = 0; ///< bonds that broke in it
    double       released =
      0; ///< energy that these held, less the work that their pull would have had in the half step before [J]
  };

  /**
   * Forces of all bonds on their nodes, each bond once (doc/theory/peridynamics.md, 1).
   *
   * Layers of the grid (rows of a plate, planes of a block) are handed to threads in groups of a size that depends on the grid alone; what a
   * group gives to the nodes beyond it is added afterwards. So no thread writes where another does, and sums have one order: the same
   * bits for any number of threads.
   */
  class BondForces
  {
  public:
    BondForces(const Bonds &bonds, Kinematics kinematics);

    /**
     * @param u displacement [m]
     * @param f forces of the bonds [N], overwritten
     */
    void add_up(const Bonds &bonds, const Field &u, Field &f);

    /**
     * The same, and a bond whose stretch has reached its limit is gone before it pulls.
     * @param last_step change of u over the step that has led here [m], for the half step of BondAccount; nullptr: there was none
     */
    BondAccount add_up_and_break(Bonds &bonds, const Field &u, const Field *last_step, Field &f);

    /** Energy of all bonds [J], 1/2 k |xi| s^2 each. */
    double energy(const Bonds &bonds, const Field &u);

    /** Stretch of one bond [-]. */
    double stretch(const Bonds &bonds, std::size_t offset, std::size_t first, std::size_t second, const Field &u) const;

  private:
    struct Pass;
    /** Rows of the grid from the first to before the last. */
    struct Rows
    {
      std::size_t first, last;
    };

    /** Calls a function of a group's number and rows for each group, in threads. */
    template <typename Function>
    void each_group(Function &&f) const;
    /** Of a group, its forces set to zero. */
    Pass forces_pass(const Bonds &bonds, const Field &u, Field &f, std::size_t group, const Rows &rows);
    void collect(Field &f) const;

    Kinematics               kinematics;
    std::size_t              row = 0, layer = 0, layers = 0, groups = 0, beyond = 0; ///< places, but of counts
    std::vector<std::size_t> first_layer; ///< of each group, and the end of the last
    std::vector<Field>
      given; ///< of each group: by place from the group's first on, to the nodes of the group and beyond
    std::vector<BondAccount> accounts;
    base::Column             energies;
  };
} // namespace dem::peridynamics

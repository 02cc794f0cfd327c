#pragma once

#include "dem/neighbours/cell_list.h"
#include "dem/peridynamics/bonds.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace dem::peridynamics
{
  /**
   * Short-range repulsion of nodes that no bond joins (any more), so that fragments do not pass through each other: k (d - r) below the
   * distance d, the lesser of a spacing and nine tenths of their distance at rest, with k = a c V V' / delta. Silling, Askari (2005), a = 15
   * (doc/theory/peridynamics.md, 7).
   */
  class Repulsion
  {
  public:
    /** @param stiffness a, in bond constants of the prototype [-] */
    Repulsion(const Bonds &bonds, double stiffness);

    /** Add the forces [N] at a displacement. Each node adds up its own in one order: threads do not decide the bits. */
    void add_up(const Bonds &bonds, const Field &u, Field &f);
    /** Stored at the displacement of the last add_up() [J]. */
    double energy() const { return stored; }
    /** Pairs that repelled each other there. */
    std::int64_t contacts() const { return touching; }

    void visit_state(base::StateVisitor &visitor)
    {
      visitor.scalar("repulsion", stored);
      visitor.scalar("contacts", touching);
    }

    /** Bound of what contacts add to the stiffness of a node [N/m]: as many equal nodes as can touch one. */
    static double bound_of_stiffness(const Bonds &bonds, double stiffness);

  private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /** Another node that may come near. */
    struct Neighbour
    {
      std::size_t node, bond; ///< place; of the bond between them in Bonds::stiffness(), or none
      double      distance;   ///< d [m]
    };

    bool                      is_stale(const Field &u) const;
    void                      find_neighbours(const Bonds &bonds, const Field &u);
    std::vector<std::int32_t> offsets_by_steps(const Bonds &bonds) const;
    Neighbour
    neighbour(const Bonds &bonds, const std::vector<std::int32_t> &offsets, std::size_t i, std::size_t j) const;
    std::size_t cube_place(const std::array<int, 3> &steps) const;

    double                   spacing, skin;
    int                      reach;
    std::vector<double>      per_volumes; ///< k / (V V') of each pair of materials [N/m^7]
    Field                    found_at;    ///< displacement at which neighbours were found
    bool                     found = false;
    std::vector<std::size_t> begin;
    std::vector<Neighbour>   near;                     ///< of each node, by ascending place
    base::Column             energies, contact_counts; ///< of each node
    double                   stored   = 0;
    std::int64_t             touching = 0;
  };
} // namespace dem::peridynamics

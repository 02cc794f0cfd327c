#pragma once

#include "base/state.h"
#include "dem/peridynamics/grid.h"
#include "dem/peridynamics/lattice_constants.h"
#include "dem/peridynamics/mixture.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace dem::peridynamics
{
  /** A straight crack through a plate, or a parallelogram in space: bonds that cross it are broken from the start. */
  struct Precrack
  {
    Eigen::Vector3d from  = Eigen::Vector3d::Zero(),
                    to    = Eigen::Vector3d::Zero(); ///< ends of the segment, of an edge in space [m]
    Eigen::Vector3d depth = Eigen::Vector3d::Zero(); ///< the other edge, from `from` on [m]; ignored in the plane

    /** Whether a straight line between two points crosses it. */
    bool crosses(const Eigen::Vector3d &a, const Eigen::Vector3d &b, int dimension) const;
  };

  /**
   * All bonds of a body, each once: by row of the grid, offset and place in the row. A bond is its stiffness k [N]: the force along it per
   * stretch, f w V V' with the bond constant, the part of the volume that counts and the corrections; of the general model times
   * the length as well. A bond that is broken, or has no node at an end, has none.
   */
  class Bonds
  {
  public:
    Bonds(const Grid &grid, const Horizon &horizon, const Material &material);
    /** Of several materials; bonds of a pair that is not bonded are broken from the start. */
    Bonds(const Grid &grid, const Horizon &horizon, const Mixture &mixture);

    const Grid                &grid() const { return of; }
    const std::vector<Offset> &offsets() const { return family; }
    double                     horizon() const { return length_of_horizon; } ///< [m]
    const LatticeConstants    &lattice() const { return constants; }         ///< as calibrated
    const Mixture             &mixture() const { return made_of; }
    BondModel                  model() const { return made_of.materials.front().model; }
    base::Column               masses() const; ///< of the nodes [kg], by place

    std::ptrdiff_t jump(const std::size_t offset) const { return jumps[offset]; } ///< to the place of the other end
    /** Where the stiffness of a row's bonds of an offset begins: row_stride() numbers. */
    std::size_t begin(const std::size_t grid_row, const std::size_t offset) const
    {
      return (grid_row * family.size() + offset) * of.row_stride();
    }
    base::Column       &stiffness() { return k; }
    const base::Column &stiffness() const { return k; }

    /** Stretch at which each bond breaks [-], laid out as the stiffness; empty: critical_stretch() everywhere. */
    const base::Column &limits() const { return limit; }
    double              critical_stretch() const { return made_of.pairs.front().critical_stretch; }
    bool   breaks() const { return !limit.empty() || critical_stretch() < std::numeric_limits<double>::infinity(); }
    double limit_of(const std::size_t bond) const { return limit.empty() ? critical_stretch() : limit[bond]; }

    /** Do it for every bond that there is or was: f(bond, offset, first place, second place). */
    template <typename Function>
    void each(Function &&f) const
    {
      for (std::size_t r = 0; r < of.rows(); ++r)
        for (std::size_t o = 0; o < family.size(); ++o)
          if (leads_to_row(r, o))
            for (std::size_t x = 0; x < static_cast<std::size_t>(of.counts()[0]); ++x)
              {
                const std::size_t i = r * of.row_stride() + x, j = i + static_cast<std::size_t>(jumps[o]);
                if (of.number(i) >= 0 && of.number(j) >= 0)
                  f(begin(r, o) + x, o, i, j);
              }
    }

    std::size_t count() const;  ///< that there are or were
    std::size_t broken() const; ///< of these

    void break_bond(const std::size_t bond) { k[bond] = 0; }
    /** @return how many bonds it broke */
    std::size_t cut(const Precrack &crack);
    /**
     * Leave the rest of stiffness and mass to another body that fills the same space: bonds keep the mean of their ends' parts.
     * @param part that stays, by place, > 0 where there is a node [-]
     */
    void share(const base::Column &part);
    /** Bonds with an end at such a place never break. @param safe by place */
    void protect(const std::vector<bool> &safe);

    /** Damage of every node, in the order of Grid::nodes(): the part of its family's volume to which bonds are gone. */
    std::vector<double> damage() const;
    /** Volume of each node's whole family [m^3], by place. */
    base::Column family_volumes() const;

    /** @throws base::InputError naming a node that no bond holds */
    void refuse_isolated_nodes() const;

    void visit_state(base::StateVisitor &visitor) { visitor.column("stiffness", k); }

  private:
    void set_limits();
    void correct_surface();
    /** Whether the row that an offset leads to from a row is one of the body: columns go on with the next plane where it ends. */
    bool leads_to_row(const std::size_t grid_row, const std::size_t offset) const
    {
      const auto y = static_cast<int>(grid_row % static_cast<std::size_t>(of.counts()[1])) + family[offset].steps[1];
      const auto z = static_cast<int>(grid_row / static_cast<std::size_t>(of.counts()[1])) + family[offset].steps[2];
      return y >= 0 && y < of.counts()[1] && z < of.counts()[2];
    }

    Grid                        of;
    Mixture                     made_of;
    std::vector<Offset>         family;
    std::vector<std::ptrdiff_t> jumps;
    double                      length_of_horizon;
    LatticeConstants            constants;
    base::Column                k, limit, own_part; ///< part of the mass of each place; empty: all
  };
} // namespace dem::peridynamics

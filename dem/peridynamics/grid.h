#pragma once

#include "base/column.h"
#include "dem/core/simd.h"
#include "dem/peridynamics/model.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dem::peridynamics
{
  /** Where the nodes of a grid lie. */
  enum class Layout
  {
    cell_centred, ///< in the middle of cells; tractions act at points of the boundary without volume
    boundary_nodes ///< on the boundary too, with a half, a quarter or an eighth of a cell there; tractions act at these nodes
  };

  /** A round hole: a circle in the plane, a cylinder along z in space. */
  struct Hole
  {
    std::string     name;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m]
    double          radius = 0;                       ///< [m]
  };

  /** A rod, plate or block, centred at the origin. */
  struct Body
  {
    Space             space     = Space::plane_stress;
    Eigen::Vector3d   size      = Eigen::Vector3d::Zero(); ///< [m]; of a plate x and y, of a rod x
    double            thickness = 0;                       ///< of a plate, and width and height of a rod [m]
    double            spacing   = 0;                       ///< of nodes [m]
    Layout            layout    = Layout::cell_centred;
    std::vector<Hole> holes;

    int dimension() const { return dimension_of(space); }
    /** What a volume has besides the lengths of its cell: thickness [m] of a plate, section [m^2] of a rod, 1 in space. */
    double section() const;
  };

  /** A vector per place of a grid, as columns of components. Places without a node hold zeros. */
  struct Field
  {
    std::array<base::Column, 3> c;

    Field() = default;
    Field(const int dimension, const std::size_t places)
    {
      for (int a = 0; a < dimension; ++a)
        c[static_cast<std::size_t>(a)].assign(places, 0.0);
    }
    Eigen::Vector3d at(const std::size_t place) const
    {
      Eigen::Vector3d v = Eigen::Vector3d::Zero();
      for (std::size_t a = 0; a < 3 && !c[a].empty(); ++a)
        v[static_cast<Eigen::Index>(a)] = c[a][place];
      return v;
    }
    void add(const std::size_t place, const Eigen::Vector3d &v)
    {
      for (std::size_t a = 0; a < 3 && !c[a].empty(); ++a)
        c[a][place] += v[static_cast<Eigen::Index>(a)];
    }
  };

  /**
   * The nodes of a body on a uniform grid.
   *
   * Columns have a place for every node of the grid and more: rows along x are followed by as many empty places as the horizon reaches,
   * so that two nodes of a bond are the same number of places apart wherever the bond lies, and eight bonds side by side are eight
   * contiguous numbers. Nodes in holes are empty places, too; an empty place has no volume, and no bond has a stiffness there.
   */
  class Grid
  {
  public:
    /**
     * @param reach of a bond in spacings, at most
     * @throws base::InputError where the spacing does not divide the body, or nothing is left of it
     */
    Grid(const Body &body, int reach);

    const Body &body() const { return of; }
    int         dimension() const { return of.dimension(); }
    double      spacing() const { return of.spacing; }
    int         reach() const { return far; }

    std::array<int, 3> counts() const { return count; } ///< nodes along each axis
    std::size_t        row_stride() const { return row; }
    std::size_t        rows() const { return static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]); }
    std::size_t        places() const { return volumes.size(); } ///< of a column
    /** Place of a node by its numbers along the axes. */
    std::size_t place(const std::array<int, 3> &i) const
    {
      return static_cast<std::size_t>(i[0]) +
             row *
               (static_cast<std::size_t>(i[1]) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(i[2]));
    }
    /** Numbers of a place along the axes; the first is beyond counts()[0] in the empty part of a row. */
    std::array<int, 3> numbers(std::size_t place) const;
    bool               has_node(const std::array<int, 3> &i) const;

    /** Places of all nodes, ascending. */
    const std::vector<std::size_t> &nodes() const { return node; }
    /** Number of the node at a place among nodes(); -1: there is none. */
    std::int32_t        number(const std::size_t place) const { return number_of[place]; }
    Eigen::Vector3d     position(std::size_t place) const; ///< [m]
    const base::Column &volume() const { return volumes; } ///< [m^3], by place

    Field field() const { return Field(dimension(), places()); }

  private:
    /** Length of a node's cell along an axis [m]. */
    double cell_length(int axis, int i) const;

    Body                      of;
    int                       far;
    std::array<int, 3>        count{1, 1, 1};
    Eigen::Vector3d           first = Eigen::Vector3d::Zero();
    std::size_t               row   = 0;
    base::Column              volumes;
    std::vector<std::size_t>  node;
    std::vector<std::int32_t> number_of;
  };
} // namespace dem::peridynamics

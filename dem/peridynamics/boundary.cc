#include "dem/peridynamics/boundary.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dem::peridynamics
{
  namespace
  {
    const char *const names[6]   = {"left", "right", "bottom", "top", "back", "front"};
    const char *const by_axis[6] = {"x min", "x max", "y min", "y max", "z min", "z max"};

    struct Side
    {
      int axis, sign; ///< axis -1: none of that name
    };

    Side side_of(const std::string &name, const int dimension)
    {
      for (int s = 0; s < 2 * dimension; ++s)
        if (name == names[s] || name == by_axis[s])
          return {s / 2, s % 2 == 0 ? -1 : 1};
      return {-1, 0};
    }

    [[noreturn]] void refuse(const Grid &grid, const std::string &boundary, const std::string &why)
    {
      std::string known;
      for (const std::string &name : side_names(grid.dimension()))
        known += (known.empty() ? "" : ", ") + name;
      for (const Hole &hole : grid.body().holes)
        known += ", " + hole.name;
      throw base::InputError("Boundary = " + boundary + ": " + why + " There are " + known + ".");
    }

    /** Of a face of a side that belongs to a node [m^2]. */
    double face_area(const Grid &grid, const Side &side, const std::array<int, 3> &i)
    {
      double area = grid.body().section();
      for (int a = 0; a < grid.dimension(); ++a)
        {
          const int  n    = i[static_cast<std::size_t>(a)];
          const bool half = grid.body().layout == Layout::boundary_nodes &&
                            (n == 0 || n == grid.counts()[static_cast<std::size_t>(a)] - 1);
          if (a != side.axis)
            area *= half ? 0.5 * grid.spacing() : grid.spacing();
        }
      return area;
    }

    std::vector<BoundaryPoint> points_of_side(const Grid &grid, const Side &side)
    {
      std::vector<BoundaryPoint> found;
      const auto                 axis = static_cast<std::size_t>(side.axis);
      const int                  last = grid.counts()[axis] - 1;
      for (const std::size_t at : grid.nodes())
        {
          std::array<int, 3> i = grid.numbers(at);
          if (i[axis] != (side.sign < 0 ? 0 : last))
            continue;
          BoundaryPoint p;
          p.place             = grid.position(at);
          p.place[side.axis]  = side.sign * 0.5 * grid.body().size[side.axis];
          p.normal[side.axis] = side.sign;
          p.area              = face_area(grid, side, i);
          p.outer = p.inner = at;
          i[axis] -= side.sign;
          if (grid.has_node(i))
            p.inner = grid.place(i);
          found.push_back(p);
        }
      return found;
    }

    std::size_t nearest_node(const Grid &grid, const Eigen::Vector3d &x)
    {
      std::size_t best     = grid.nodes().front();
      double      distance = (grid.position(best) - x).squaredNorm();
      for (const std::size_t at : grid.nodes())
        if (const double d = (grid.position(at) - x).squaredNorm(); d < distance)
          {
            distance = d;
            best     = at;
          }
      return best;
    }

    std::vector<BoundaryPoint> points_of_hole(const Grid &grid, const Hole &hole)
    {
      const double               around = 2 * std::acos(-1.0);
      const int                  n = std::max(8, static_cast<int>(std::lround(around * hole.radius / grid.spacing())));
      const bool                 space  = grid.dimension() == 3;
      const int                  planes = space ? grid.counts()[2] : 1;
      std::vector<BoundaryPoint> found;
      for (int plane = 0; plane < planes; ++plane)
        for (int k = 0; k < n; ++k)
          {
            const double          angle = around * (k + 0.5) / n;
            const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0);
            BoundaryPoint         p;
            p.normal    = -direction;
            p.place     = hole.centre + hole.radius * direction;
            p.place.z() = space ? grid.position(grid.place({0, 0, plane})).z() : 0.0;
            if ((p.place.head<2>().cwiseAbs() - 0.5 * grid.body().size.head<2>()).maxCoeff() > 0)
              continue;
            const bool half = grid.body().layout == Layout::boundary_nodes && (plane == 0 || plane == planes - 1);
            p.area  = around * hole.radius / n * (space ? (half ? 0.5 : 1.0) * grid.spacing() : grid.body().section());
            p.outer = nearest_node(grid, p.place);
            p.inner = p.outer;
            found.push_back(p);
          }
      return found;
    }
  } // namespace

  std::vector<std::string> side_names(const int dimension) { return {names, names + 2 * dimension}; }

  std::vector<BoundaryPoint> boundary_points(const Grid &grid, const std::string &boundary)
  {
    std::vector<BoundaryPoint> found;
    if (const Side side = side_of(boundary, grid.dimension()); side.axis >= 0)
      found = points_of_side(grid, side);
    else
      {
        const auto hole = std::find_if(grid.body().holes.begin(), grid.body().holes.end(),
                                       [&](const Hole &h) { return h.name == boundary; });
        if (hole == grid.body().holes.end() || grid.dimension() == 1)
          refuse(grid, boundary, "is neither a side of the body nor a hole.");
        found = points_of_hole(grid, *hole);
      }
    if (found.empty())
      refuse(grid, boundary, "no node is left there.");
    return found;
  }

  std::vector<std::size_t> outer_nodes(const Grid &grid, const std::string &side)
  {
    std::set<std::size_t> found;
    for (const BoundaryPoint &p : boundary_points(grid, side))
      found.insert(p.outer);
    return {found.begin(), found.end()};
  }
} // namespace dem::peridynamics

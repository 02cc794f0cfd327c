#include "dem/peridynamics/grid.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <cmath>

namespace dem::peridynamics
{
  double Body::section() const
  {
    switch (space)
      {
      case Space::rod:
        return thickness * thickness;
      case Space::space:
        return 1;
      default:
        return thickness;
      }
  }

  namespace
  {
    int cells_along(const Body &body, const int axis)
    {
      const double cells = body.size[axis] / body.spacing, whole = std::round(cells);
      if (whole < 1 || std::abs(cells - whole) > 1e-6 * whole)
        throw base::InputError("Grid/Spacing = " + base::number_text(body.spacing) +
                               ": must divide every length of the body without a rest, but Body/Size has " +
                               base::number_text(body.size[axis]) + " m along " + "xyz"[axis] + ", " +
                               base::number_text(cells) + " spacings.");
      if (whole > 1e6)
        throw base::InputError("Grid/Spacing = " + base::number_text(body.spacing) +
                               ": there would be more than a million nodes along " + std::string(1, "xyz"[axis]) + ".");
      return static_cast<int>(whole);
    }

    bool is_in_hole(const Body &body, const Eigen::Vector3d &place)
    {
      for (const Hole &hole : body.holes)
        if ((place - hole.centre).head<2>().norm() < hole.radius * (1 - 1e-9))
          return true;
      return false;
    }
  } // namespace

  Grid::Grid(const Body &body, const int reach)
    : of(body)
    , far(reach)
  {
    for (int axis = 0; axis < dimension(); ++axis)
      {
        const bool between                    = of.layout == Layout::cell_centred;
        count[static_cast<std::size_t>(axis)] = cells_along(of, axis) + (between ? 0 : 1);
        first[axis]                           = -0.5 * of.size[axis] + (between ? 0.5 * of.spacing : 0.0);
      }
    const auto packs = static_cast<std::size_t>(count[0] + reach + pack_size - 1) / pack_size;
    row              = packs * pack_size;
    // Behind the last row: what bonds of its last places would reach, were there any.
    const std::size_t beyond =
      static_cast<std::size_t>(reach) * row * (dimension() == 3 ? static_cast<std::size_t>(count[1]) + 1 : 1) + row;
    volumes.assign(rows() * row + beyond, 0.0);
    number_of.assign(volumes.size(), -1);
    std::array<int, 3> i;
    for (i[2] = 0; i[2] < count[2]; ++i[2])
      for (i[1] = 0; i[1] < count[1]; ++i[1])
        for (i[0] = 0; i[0] < count[0]; ++i[0])
          {
            const std::size_t at = place(i);
            if (is_in_hole(of, position(at)))
              continue;
            volumes[at] = of.section();
            for (int axis = 0; axis < dimension(); ++axis)
              volumes[at] *= cell_length(axis, i[static_cast<std::size_t>(axis)]);
            number_of[at] = static_cast<std::int32_t>(node.size());
            node.push_back(at);
          }
    if (node.empty())
      throw base::InputError("Holes: nothing is left of the body.");
  }

  double Grid::cell_length(const int axis, const int i) const
  {
    const bool at_end = i == 0 || i == count[static_cast<std::size_t>(axis)] - 1;
    return of.layout == Layout::boundary_nodes && at_end ? 0.5 * of.spacing : of.spacing;
  }

  std::array<int, 3> Grid::numbers(const std::size_t at) const
  {
    const std::size_t line = at / row, rows_of_plane = static_cast<std::size_t>(count[1]);
    return {static_cast<int>(at % row), static_cast<int>(line % rows_of_plane), static_cast<int>(line / rows_of_plane)};
  }

  bool Grid::has_node(const std::array<int, 3> &i) const
  {
    for (std::size_t a = 0; a < 3; ++a)
      if (i[a] < 0 || i[a] >= count[a])
        return false;
    return number_of[place(i)] >= 0;
  }

  Eigen::Vector3d Grid::position(const std::size_t at) const
  {
    const std::array<int, 3> i = numbers(at);
    Eigen::Vector3d          x = first;
    for (int a = 0; a < dimension(); ++a)
      x[a] += of.spacing * i[static_cast<std::size_t>(a)];
    return x;
  }
} // namespace dem::peridynamics

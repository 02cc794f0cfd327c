#include "dem/packing/lattice.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    /** One lattice cell: its edges, in radii, and the places of its particles as parts of the edges. */
    struct UnitCell
    {
      Eigen::Vector3d              edge;
      std::vector<Eigen::Vector3d> place;
    };

    UnitCell unit_cell(const Lattice lattice)
    {
      const auto cubic = [](const double edge) { return Eigen::Vector3d::Constant(edge); };
      switch (lattice)
        {
        case Lattice::simple_cubic:
          return {cubic(2), {{0, 0, 0}}};
        case Lattice::body_centred_cubic:
          return {cubic(4 / std::sqrt(3.0)), {{0, 0, 0}, {0.5, 0.5, 0.5}}};
        case Lattice::face_centred_cubic:
          return {cubic(2 * std::sqrt(2.0)), {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}};
        case Lattice::square:
          return {{2, 2, 0}, {{0, 0, 0}}};
        case Lattice::hexagonal:
          return {{2, 2 * std::sqrt(3.0), 0}, {{0, 0, 0}, {0.5, 0.5, 0}}};
        }
      throw base::InputError("lattice: unknown kind " + std::to_string(static_cast<int>(lattice)) + ".");
    }
  } // namespace

  Packing make_lattice(const Lattice lattice, const double radius, const std::array<int, 3> &cells)
  {
    const UnitCell unit   = unit_cell(lattice);
    const bool     planar = unit.edge[2] == 0;
    if (!std::isfinite(radius) || radius <= 0)
      throw base::InputError("lattice: radius = " + base::number_text(radius) +
                             ": must be a finite length above zero [m].");
    for (int d = 0; d < 3; ++d)
      if (cells[d] < 1 || (d == 2 && planar && cells[d] != 1))
        throw base::InputError("lattice: cells = " + std::to_string(cells[0]) + " x " + std::to_string(cells[1]) +
                               " x " + std::to_string(cells[2]) +
                               ": must be at least 1 each, and the third exactly 1 for discs.");
    const Eigen::Vector3d first(1, 1, planar ? 0 : 1);
    Packing               packing;
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i)
          for (const Eigen::Vector3d &place : unit.place)
            {
              const Eigen::Vector3d where = Eigen::Vector3d(i, j, k) + place;
              packing.centre.emplace_back(radius * (first + unit.edge.cwiseProduct(where)));
              packing.radius.push_back(radius);
            }
    packing.periodic_cell = radius * unit.edge.cwiseProduct(Eigen::Vector3d(cells[0], cells[1], cells[2]));
    if (planar)
      (*packing.periodic_cell)[2] = std::numeric_limits<double>::infinity();
    return packing;
  }
} // namespace dem

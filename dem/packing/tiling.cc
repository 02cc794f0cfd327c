#include "dem/packing/tiling.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    /// Below nine diameters a period shows in the fracture pattern (doc/theory/packing.md, 2).
    constexpr double shortest_period = 9;

    std::string text_of(const Eigen::Vector3d &box)
    {
      std::ostringstream text;
      text << "box = " << box[0] << " x " << box[1] << " x " << box[2] << " m";
      return text.str();
    }

    bool repeats_along(const Packing &packing, const int d)
    {
      return packing.periodic_cell && std::isfinite((*packing.periodic_cell)[d]);
    }

    std::array<std::int64_t, 3> count_repeats(const Packing &packing, const Eigen::Vector3d &box)
    {
      std::array<std::int64_t, 3> repeats = {{1, 1, 1}};
      double                      total   = static_cast<double>(packing.size());
      for (int d = 0; d < 3; ++d)
        if (repeats_along(packing, d))
          {
            const double cells = std::ceil(box[d] / (*packing.periodic_cell)[d]);
            total *= cells;
            if (!(total <= std::numeric_limits<std::int32_t>::max()))
              throw base::InputError(
                text_of(box) + ": " + std::to_string(packing.size()) +
                " spheres repeated to cover it would be more than 2^31 - 1. Shrink the box (are its "
                "edges in metres?) or take larger spheres.");
            repeats[d] = static_cast<std::int64_t>(cells);
          }
      return repeats;
    }

    std::string note_on_period(const Packing &packing, const std::array<std::int64_t, 3> &repeats)
    {
      const double diameter = 2 * *std::max_element(packing.radius.begin(), packing.radius.end());
      for (int d = 0; d < 3; ++d)
        if (repeats[d] > 1 && (*packing.periodic_cell)[d] < shortest_period * diameter)
          {
            std::ostringstream note;
            note << "The packing repeats every " << (*packing.periodic_cell)[d] << " m, "
                 << (*packing.periodic_cell)[d] / diameter << " diameters of its largest sphere: fewer than "
                 << shortest_period << ", the specimen may break along the period. Generate more spheres per cell.";
            return note.str();
          }
      return "";
    }

    bool fits(const Eigen::Vector3d &x, const double r, const Eigen::Vector3d &box)
    {
      const double room = r * (1 - 1e-9);
      for (int d = 0; d < 3; ++d)
        if (std::isfinite(box[d]) && (x[d] < room || x[d] > box[d] - room))
          return false;
      return true;
    }

    /** The packing with its centres brought into the periodic cell. */
    Packing wrapped(Packing packing)
    {
      for (Eigen::Vector3d &x : packing.centre)
        for (int d = 0; d < 3; ++d)
          if (repeats_along(packing, d))
            {
              const double edge = (*packing.periodic_cell)[d];
              x[d] -= edge * std::floor(x[d] / edge);
            }
      return packing;
    }
  } // namespace

  Tiling tile_and_crop(const Packing &packing, const Eigen::Vector3d &box)
  {
    for (int d = 0; d < 3; ++d)
      if (std::isnan(box[d]) || box[d] <= 0)
        throw base::InputError(text_of(box) + ": its edges must be above zero.");
    if (!packing.bodies.empty())
      throw base::InputError(text_of(box) +
                             ": the packing has rigid bodies, which cannot be cut. Take it as it is, without a box.");
    if (packing.size() == 0)
      throw base::InputError(text_of(box) + ": there is no sphere to fill it with.");
    Tiling        tiling;
    const Packing cell            = wrapped(packing);
    tiling.repeats                = count_repeats(packing, box);
    tiling.note                   = note_on_period(packing, tiling.repeats);
    tiling.packing.material_names = packing.material_names;
    for (std::int64_t k = 0; k < tiling.repeats[2]; ++k)
      for (std::int64_t j = 0; j < tiling.repeats[1]; ++j)
        for (std::int64_t i = 0; i < tiling.repeats[0]; ++i)
          for (std::size_t p = 0; p < cell.size(); ++p)
            {
              Eigen::Vector3d                   x     = cell.centre[p];
              const std::array<std::int64_t, 3> shift = {{i, j, k}};
              for (int d = 0; d < 3; ++d)
                if (shift[d] > 0)
                  x[d] += static_cast<double>(shift[d]) * (*cell.periodic_cell)[d];
              if (!fits(x, cell.radius[p], box))
                continue;
              tiling.packing.centre.push_back(x);
              tiling.packing.radius.push_back(cell.radius[p]);
              if (!cell.material.empty())
                tiling.packing.material.push_back(cell.material[p]);
            }
    if (tiling.packing.size() == 0)
      {
        std::ostringstream text;
        text
          << text_of(box) << ": no sphere lies fully inside (the smallest diameter is "
          << 2 * *std::min_element(cell.radius.begin(), cell.radius.end())
          << " m). Enlarge the box, check its units (metres) or the place of the packing (the box begins at 0, 0, 0).";
        throw base::InputError(text.str());
      }
    return tiling;
  }
} // namespace dem

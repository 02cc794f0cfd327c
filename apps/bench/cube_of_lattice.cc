#include "apps/bench/cube_of_lattice.h"

#include "apps/bench/concrete_links.h"
#include "dem/laws/cpm.h"
#include "dem/model/particles.h"
#include "dem/packing/lattice.h"

#include <array>
#include <cstdint>
#include <vector>

namespace apps
{
  namespace
  {
    /** Places of a face-centred cubic lattice on a grid of half a cell: those whose numbers add up to an even one. */
    struct HalfCells
    {
      explicit HalfCells(const int cells)
        : edge(2 * cells)
      {
        for (int k = 0; k < edge; ++k)
          for (int j = 0; j < edge; ++j)
            for (int i = (j + k) % 2; i < edge; i += 2)
              places.push_back({i, j, k});
      }

      std::size_t at(const std::array<int, 3> &place) const
      {
        return (static_cast<std::size_t>(place[2]) * static_cast<std::size_t>(edge) +
                static_cast<std::size_t>(place[1])) *
                 static_cast<std::size_t>(edge) +
               static_cast<std::size_t>(place[0]);
      }

      bool inside(const std::array<int, 3> &place) const
      {
        return place[0] >= 0 && place[0] < edge && place[1] >= 0 && place[1] < edge && place[2] >= 0 && place[2] < edge;
      }

      int                             edge;
      std::vector<std::array<int, 3>> places;
    };

    std::vector<std::array<int, 3>> to_neighbours()
    {
      std::vector<std::array<int, 3>> offsets;
      for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i)
            if (i * i + j * j + k * k == 2)
              offsets.push_back({i, j, k});
      return offsets;
    }
  } // namespace

  dem::Specimen cube_of_lattice(const int cells, dem::Ranks *const found_by)
  {
    dem::SpecimenParameters parameters;
    parameters.density           = 4800;
    parameters.interaction_ratio = 1.1;
    parameters.damping           = 0.3;
    dem::Packing packing         = dem::make_lattice(dem::Lattice::face_centred_cubic, 1e-3, {cells, cells, cells});
    packing.periodic_cell.reset();
    return dem::Specimen(packing, parameters, dem::CpmMaterials(concrete_links()), found_by);
  }

  dem::LinkEnds links_of_cube(const int cells)
  {
    const HalfCells              grid(cells);
    std::vector<Eigen::Vector3d> points;
    points.reserve(grid.places.size());
    for (const auto &[i, j, k] : grid.places)
      points.emplace_back(i, j, k);
    const std::vector<std::int32_t> order = dem::hilbert_order(points);
    const auto                      edge  = static_cast<std::size_t>(grid.edge);
    std::vector<std::int32_t>       number(edge * edge * edge, -1);
    for (std::size_t row = 0; row < order.size(); ++row)
      number[grid.at(grid.places[static_cast<std::size_t>(order[row])])] = static_cast<std::int32_t>(row);
    dem::LinkEnds links;
    for (auto *ends : {&links.first, &links.second})
      ends->reserve(6 * order.size());
    const std::vector<std::array<int, 3>> offsets = to_neighbours();
    for (std::size_t row = 0; row < order.size(); ++row)
      for (const std::array<int, 3> &by : offsets)
        {
          std::array<int, 3> other = grid.places[static_cast<std::size_t>(order[row])];
          for (std::size_t c = 0; c < 3; ++c)
            other[c] += by[c];
          if (const auto first = static_cast<std::int32_t>(row); grid.inside(other) && number[grid.at(other)] > first)
            {
              links.first.push_back(first);
              links.second.push_back(number[grid.at(other)]);
            }
        }
    return links;
  }
} // namespace apps

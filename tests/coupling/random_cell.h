#pragma once

#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/elastic_links.h"
#include "dem/packing/compaction.h"
#include "dem/packing/lattice.h"
#include "dem/packing/tiling.h"

#include <cmath>
#include <limits>

/** Periodic packings without any order, for tests of the volume coupling. */
namespace random_cell
{
  using Eigen::Vector3d;

  constexpr double interaction_ratio = 1.5;

  /** Compacted spheres; or discs that have been moved out of a lattice. @param spacing of particles [m] */
  template <int dim>
  dem::Packing make(const double spacing)
  {
    if (dim == 3)
      {
        dem::CompactionParameters p;
        p.radius = spacing / 2;
        p.count  = 500;
        return dem::compact(p).packing;
      }
    dem::Packing cell = dem::make_lattice(dem::Lattice::hexagonal, spacing / 2, {16, 9, 1});
    for (std::size_t i = 0; i < cell.size(); ++i)
      {
        const double k = static_cast<double>(i + 1);
        cell.centre[i] +=
          0.3 * spacing * Vector3d(std::fmod(0.754877666 * k, 1.0) - 0.5, std::fmod(0.569840291 * k, 1.0) - 0.5, 0);
        cell.radius[i] *= 0.9;
      }
    return cell;
  }

  /** What elements have to be as stiff as. */
  template <int dim>
  base::Stiffness stiffness(const dem::Packing &cell, const dem::LinkMaterials &material, const double thickness)
  {
    dem::NetworkParameters links;
    links.dimension                 = dim;
    links.interaction_ratio         = interaction_ratio;
    links.thickness                 = thickness;
    const base::Stiffness D         = dem::relaxed_stiffness(dem::make_network(cell, links, material)).stiffness;
    base::Stiffness       symmetric = 0.5 * (D + D.transpose());
    for (int i = 0; i < 6; ++i)
      if (symmetric(i, i) == 0) // out of the plane
        symmetric(i, i) = symmetric.maxCoeff();
    return symmetric;
  }

  /** Those of the repeated cell that lie wholly in a bar from the origin on. */
  template <int dim>
  dem::Packing fill(const dem::Packing &cell, const double length, const double width)
  {
    const double out_of_plane = dim == 3 ? width : std::numeric_limits<double>::infinity();
    return dem::tile_and_crop(cell, {length, width, out_of_plane}).packing;
  }
} // namespace random_cell

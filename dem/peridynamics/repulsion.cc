#include "dem/peridynamics/repulsion.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  namespace
  {
    /** k / (V V') of each pair of materials, also of those that are not bonded [N/m^7]. */
    std::vector<double> stiffness_per_volumes(const Bonds &bonds, const double stiffness)
    {
      const Body                  &body      = bonds.grid().body();
      const std::vector<Material> &materials = bonds.mixture().materials;
      std::vector<double>          all;
      for (std::size_t one = 0; one < materials.size(); ++one)
        for (std::size_t other = 0; other <= one; ++other)
          all.push_back(stiffness / bonds.horizon() *
                        bond_constant(body.space, BondModel::prototype,
                                      in_series(materials[one], materials[other]).young_modulus, bonds.horizon(),
                                      body.section()));
      return all;
    }

    double largest_volume(const Grid &grid) { return *std::max_element(grid.volume().begin(), grid.volume().end()); }
  } // namespace

  Repulsion::Repulsion(const Bonds &bonds, const double stiffness)
    : spacing(bonds.grid().spacing())
    , skin(0.5 * spacing)
    , reach(bonds.grid().reach())
    , per_volumes(stiffness_per_volumes(bonds, stiffness))
    , energies(bonds.grid().nodes().size(), 0.0)
    , contact_counts(bonds.grid().nodes().size(), 0.0)
  {
  }

  double Repulsion::bound_of_stiffness(const Bonds &bonds, const double stiffness)
  {
    const std::vector<double> all    = stiffness_per_volumes(bonds, stiffness);
    const double              volume = largest_volume(bonds.grid());
    const int                 most   = bonds.grid().dimension() == 1 ? 2 : bonds.grid().dimension() == 2 ? 6 : 12;
    return 2 * most * *std::max_element(all.begin(), all.end()) * volume * volume;
  }

  bool Repulsion::is_stale(const Field &u) const
  {
    const double most = 0.25 * skin * skin; // both nodes may have moved
    for (std::size_t i = 0; i < u.c[0].size(); ++i)
      if (!((u.at(i) - found_at.at(i)).squaredNorm() <= most))
        return true;
    return false;
  }

  std::size_t Repulsion::cube_place(const std::array<int, 3> &steps) const
  {
    const int width = 2 * reach + 1;
    return static_cast<std::size_t>(steps[0] + reach + width * (steps[1] + reach + width * (steps[2] + reach)));
  }

  std::vector<std::int32_t> Repulsion::offsets_by_steps(const Bonds &bonds) const
  {
    std::vector<std::int32_t> numbers(cube_place({reach, reach, reach}) + 1, -1);
    for (std::size_t o = 0; o < bonds.offsets().size(); ++o)
      numbers[cube_place(bonds.offsets()[o].steps)] = static_cast<std::int32_t>(o);
    return numbers;
  }

  Repulsion::Neighbour Repulsion::neighbour(const Bonds                     &bonds,
                                            const std::vector<std::int32_t> &offsets,
                                            const std::size_t                i,
                                            const std::size_t                j) const
  {
    const Grid              &grid = bonds.grid();
    const std::array<int, 3> at_i = grid.numbers(i), at_j = grid.numbers(j);
    std::array<int, 3>       ahead, back;
    bool                     within = true;
    double                   square = 0;
    for (std::size_t a = 0; a < 3; ++a)
      {
        ahead[a] = at_j[a] - at_i[a];
        back[a]  = -ahead[a];
        within   = within && std::abs(ahead[a]) <= reach;
        square += static_cast<double>(ahead[a]) * ahead[a];
      }
    std::size_t bond = none;
    if (within)
      for (const auto &[first, steps] : {std::pair{i, ahead}, std::pair{j, back}})
        if (const std::int32_t o = offsets[cube_place(steps)]; o >= 0)
          bond = bonds.begin(first / grid.row_stride(), static_cast<std::size_t>(o)) + first % grid.row_stride();
    return {j, bond, spacing * std::min(0.9 * std::sqrt(square), 1.0)};
  }

  void Repulsion::find_neighbours(const Bonds &bonds, const Field &u)
  {
    const Grid                  &grid = bonds.grid();
    std::vector<Eigen::Vector3d> places;
    for (const std::size_t i : grid.nodes())
      places.push_back(grid.position(i) + u.at(i));
    const std::vector<double>             radius(places.size(), 0.5 * spacing);
    const std::vector<std::int32_t>       offsets = offsets_by_steps(bonds);
    std::vector<std::vector<std::size_t>> of_nodes(places.size());
    for (const NeighbourPair &pair : find_pairs(places, radius, 1.0, skin, {}))
      {
        const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
        of_nodes[first].push_back(second);
        of_nodes[second].push_back(first);
      }
    begin = {0};
    near.clear();
    for (std::size_t n = 0; n < of_nodes.size(); ++n)
      {
        std::sort(of_nodes[n].begin(), of_nodes[n].end());
        for (const std::size_t other : of_nodes[n])
          near.push_back(neighbour(bonds, offsets, grid.nodes()[n], grid.nodes()[other]));
        begin.push_back(near.size());
      }
    found_at = u;
    found    = true;
  }

  void Repulsion::add_up(const Bonds &bonds, const Field &u, Field &f)
  {
    const Grid &grid = bonds.grid();
    if (!found || is_stale(u))
      find_neighbours(bonds, u);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t m = 0; m < static_cast<std::ptrdiff_t>(energies.size()); ++m)
      {
        const auto            n = static_cast<std::size_t>(m);
        const std::size_t     i = grid.nodes()[n];
        const Eigen::Vector3d x = grid.position(i) + u.at(i);
        energies[n]             = 0;
        contact_counts[n]       = 0;
        for (std::size_t c = begin[n]; c < begin[n + 1]; ++c)
          {
            const Neighbour &other = near[c];
            if (other.bond != none && bonds.stiffness()[other.bond] != 0)
              continue;
            const std::size_t     j    = other.node;
            const Eigen::Vector3d away = x - (grid.position(j) + u.at(j));
            const double          r    = away.norm();
            if (!(r < other.distance) || r == 0)
              continue;
            const double k = per_volumes[bonds.mixture().pair_at(i, j)] * grid.volume()[i] * grid.volume()[j];
            f.add(i, k * (other.distance - r) / r * away);
            energies[n] += 0.25 * k * (other.distance - r) * (other.distance - r); // half of the pair's
            contact_counts[n] += 1;
          }
      }
    stored         = 0;
    double counted = 0;
    for (std::size_t n = 0; n < energies.size(); ++n)
      {
        stored += energies[n];
        counted += contact_counts[n];
      }
    touching = static_cast<std::int64_t>(counted) / 2;
  }
} // namespace dem::peridynamics

#include "dem/neighbours/cell_list.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/neighbours/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace dem
{
  using namespace neighbours;

  namespace
  {
    /// Particles searched in a row by one thread: small enough for an even share, large enough to be worth waking threads.
    constexpr std::size_t chunk_size = 4096;

    /** What lies in the cells of a range of particles and beside them, which are as wide as the longest reach of a pair. */
    class BesideRange
    {
    public:
      BesideRange(const Frame &box, const Query &query, const double largest)
        : frame(box)
        , all(query.of.begin <= 0 && static_cast<std::size_t>(query.of.end) >= query.centre.size())
        , cells(frame, 2 * largest + frame.slack, all ? 0 : query.centre.size())
        , beside(all ? 0 : cells.cells(), false)
      {
        const auto end =
          static_cast<std::int32_t>(std::min(static_cast<std::size_t>(std::max(query.of.end, 0)), query.centre.size()));
        for (std::int32_t i = std::max(query.of.begin, 0); !all && i < end; ++i)
          mark(cells.cell_of(entry_of(frame, query, i)));
      }

      bool has(const Entry &e) const { return all || beside[cells.number(cells.cell_of(e))]; }

    private:
      void mark(const Index &middle)
      {
        Index at;
        for (at[2] = middle[2] - 1; at[2] <= middle[2] + 1; ++at[2])
          for (at[1] = middle[1] - 1; at[1] <= middle[1] + 1; ++at[1])
            for (at[0] = middle[0] - 1; at[0] <= middle[0] + 1; ++at[0])
              {
                Index inside = at;
                for (int d = 0; d < 3; ++d)
                  inside[d] -= floor_division(at[d], cells.count[d]) * cells.count[d];
                bool within = true;
                for (int d = 0; d < 3; ++d)
                  within = within && (frame.repeats[d] || inside[d] == at[d]);
                if (within)
                  beside[cells.number(inside)] = true;
              }
      }

      const Frame      &frame;
      bool              all;
      CellCounts        cells;
      std::vector<bool> beside;
    };

    /** One grid per factor of two in reach, largest first; classes without a member are left out. */
    std::vector<CellGrid> sort_into_grids(const Frame &frame, const Query &query)
    {
      const std::size_t n       = query.centre.size();
      double            largest = 0;
      for (std::size_t i = 0; i < n; ++i)
        largest = std::max(largest, query.reach(i));
      const BesideRange               wanted(frame, query, largest);
      std::vector<std::vector<Entry>> classes;
      for (std::size_t i = 0; i < n; ++i)
        {
          const double      reach = query.reach(i);
          const std::size_t level = reach > 0 ? static_cast<std::size_t>(std::ilogb(largest / reach)) : 0;
          if (level >= classes.size())
            classes.resize(level + 1);
          if (const Entry entry = entry_of(frame, query, static_cast<std::int32_t>(i)); wanted.has(entry))
            classes[level].push_back(entry);
        }
      std::vector<CellGrid> grids;
      for (std::vector<Entry> &members : classes)
        if (!members.empty())
          grids.emplace_back(frame, std::move(members));
      return grids;
    }

    /** Lower number first; of a particle and its own image, the image on the positive side. */
    NeighbourPair ordered(const Entry &a, const Entry &b, const Index &image)
    {
      Index shift;
      for (int d = 0; d < 3; ++d)
        shift[d] = image[d] - b.wraps[d] + a.wraps[d];
      const bool swap = a.particle != b.particle ? a.particle > b.particle : shift < Index{{0, 0, 0}};

      NeighbourPair pair{swap ? b.particle : a.particle, swap ? a.particle : b.particle, {}};
      for (int d = 0; d < 3; ++d)
        {
          if (std::abs(shift[d]) > std::numeric_limits<std::int8_t>::max())
            throw std::range_error("particles " + std::to_string(pair.first + 1) + " and " +
                                   std::to_string(pair.second + 1) + " are neighbours across " +
                                   std::to_string(std::abs(shift[d])) +
                                   " periodic cells: more than 127. Bring the centres back into the cell.");
          pair.shift[d] = static_cast<std::int8_t>(swap ? -shift[d] : shift[d]);
        }
      return pair;
    }

    /** Pairs of the particles [begin, end) of one grid with their own and all coarser grids. */
    void search(const std::vector<CellGrid> &grids,
                const std::size_t            level,
                const std::size_t            begin,
                const std::size_t            end,
                const Query                 &query,
                const Frame                 &frame,
                std::vector<NeighbourPair>  &pairs)
    {
      for (std::size_t slot = begin; slot < end; ++slot)
        {
          const Entry &seeker = grids[level][slot];
          const auto   keep   = [&](const Entry &other, const Index &image) {
            const NeighbourPair pair = ordered(seeker, other, image);
            if (query.of.has(pair) && query.near(pair, frame.base))
              pairs.push_back(pair);
          };
          for (std::size_t coarser = 0; coarser < level; ++coarser)
            grids[coarser].for_each_near(seeker, -1, keep);
          grids[level].for_each_near(seeker, static_cast<std::ptrdiff_t>(slot), keep);
        }
    }

    /** The total order: distribute by first particle, then sort the few pairs of each. */
    std::vector<NeighbourPair> sorted(const std::vector<std::vector<NeighbourPair>> &parts, const std::size_t particles)
    {
      std::vector<std::size_t> start(particles + 1, 0);
      for (const auto &part : parts)
        for (const NeighbourPair &pair : part)
          ++start[pair.first + 1];
      for (std::size_t i = 0; i < particles; ++i)
        start[i + 1] += start[i];
      std::vector<NeighbourPair> pairs(start[particles]);
      std::vector<std::size_t>   next(start.begin(), start.end() - 1);
      for (const auto &part : parts)
        for (const NeighbourPair &pair : part)
          pairs[next[pair.first]++] = pair;
#pragma omp parallel for schedule(static) if (particles > chunk_size)
      for (std::size_t i = 0; i < particles; ++i)
        std::sort(pairs.begin() + start[i], pairs.begin() + start[i + 1]);
      return pairs;
    }

    std::vector<NeighbourPair> search_all(const Frame &frame, const Query &query)
    {
      const std::vector<CellGrid> grids = sort_into_grids(frame, query);

      struct Chunk
      {
        std::size_t level, begin, end;
      };
      std::vector<Chunk> chunks;
      for (std::size_t level = 0; level < grids.size(); ++level)
        for (std::size_t begin = 0; begin < grids[level].size(); begin += chunk_size)
          chunks.push_back({level, begin, std::min(begin + chunk_size, grids[level].size())});

      std::vector<std::vector<NeighbourPair>> parts(chunks.size());
      std::string                             failure; // exceptions must not leave a parallel region
#pragma omp parallel for schedule(dynamic) if (chunks.size() > 1)
      for (std::size_t c = 0; c < chunks.size(); ++c)
        try
          {
            search(grids, chunks[c].level, chunks[c].begin, chunks[c].end, query, frame, parts[c]);
          }
        catch (const std::range_error &error)
          {
#pragma omp critical(dem_find_pairs)
            failure = error.what();
          }
      if (!failure.empty())
        throw std::range_error(failure);
      return sorted(parts, query.centre.size());
    }

    // Eigen's allFinite() subtracts infinity from infinity, which the audit build takes for the mistake itself.
    bool finite(const Eigen::Vector3d &x) { return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]); }

    void check(const Query &query)
    {
      if (query.centre.size() != query.radius.size())
        throw std::invalid_argument("find_pairs: " + std::to_string(query.centre.size()) + " centres but " +
                                    std::to_string(query.radius.size()) + " radii.");
      if (query.centre.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw std::invalid_argument("find_pairs: more than 2^31 - 1 particles.");
      if (!std::isfinite(query.factor) || query.factor < 0 || !std::isfinite(query.skin) || query.skin < 0)
        throw std::invalid_argument("find_pairs: factor = " + base::number_text(query.factor) + ", skin = " +
                                    base::number_text(query.skin) + ": both must be finite and not negative.");
      for (std::size_t i = 0; i < query.centre.size(); ++i)
        if (!finite(query.centre[i]) || !std::isfinite(query.radius[i]) || query.radius[i] <= 0)
          throw base::NumericalError("neighbour search: the centre or radius of particle " + std::to_string(i + 1) +
                                     " is not a number (or the radius not above zero).");
    }
  } // namespace

  bool operator==(const NeighbourPair &a, const NeighbourPair &b)
  {
    return a.first == b.first && a.second == b.second && a.shift == b.shift;
  }

  bool operator<(const NeighbourPair &a, const NeighbourPair &b)
  {
    if (a.first != b.first)
      return a.first < b.first;
    return a.second != b.second ? a.second < b.second : a.shift < b.shift;
  }

  std::vector<NeighbourPair> find_pairs(const std::vector<Eigen::Vector3d>   &centre,
                                        const std::vector<double>            &radius,
                                        const double                          factor,
                                        const double                          skin,
                                        const std::optional<Eigen::Vector3d> &cell,
                                        const PairsOf                        &of)
  {
    const Query query{centre, radius, factor, skin, of};
    check(query);
    Frame frame;
    for (int d = 0; d < 3 && cell; ++d)
      {
        if (std::isnan((*cell)[d]) || (*cell)[d] <= 0)
          throw std::invalid_argument("find_pairs: cell edge " + base::number_text((*cell)[d]) + " is not above zero.");
        frame.repeats[d] = std::isfinite((*cell)[d]);
        if (frame.repeats[d])
          frame.base(d, d) = (*cell)[d];
      }
    enclose(frame, centre);
    frame.complete(centre);
    return search_all(frame, query);
  }

  std::vector<NeighbourPair> find_pairs_sheared(const std::vector<Eigen::Vector3d> &centre,
                                                const std::vector<double>          &radius,
                                                const double                        factor,
                                                const double                        skin,
                                                const Eigen::Matrix3d              &cell,
                                                const PairsOf                      &of)
  {
    const Query query{centre, radius, factor, skin, of};
    check(query);
    if (!finite(cell.col(0)) || !finite(cell.col(1)) || !finite(cell.col(2)) || !(cell.determinant() > 0))
      throw std::invalid_argument("find_pairs: the cell matrix must be finite with a positive determinant.");
    Frame frame;
    frame.base    = cell;
    frame.repeats = {{true, true, true}};
    frame.complete(centre);
    return search_all(frame, query);
  }
} // namespace dem

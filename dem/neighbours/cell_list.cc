#include "dem/neighbours/cell_list.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/neighbours/tie.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace dem
{
  namespace
  {
    using Index = std::array<std::int64_t, 3>;

    /// Particles searched in a row by one thread: small enough for an even share, large enough to be worth waking threads.
    constexpr std::size_t chunk_size = 4096;

    std::int64_t floor_division(const std::int64_t a, const std::int64_t b)
    {
      if (a >= 0 && a < b) // nearly always: spares the division
        return 0;
      return a >= 0 ? a / b : -((-a + b - 1) / b);
    }

    /** The request; pair reach = sum of the two particles' own reaches. */
    struct Query
    {
      const std::vector<Eigen::Vector3d> &centre;
      const std::vector<double>          &radius;
      double                              factor, skin;

      double reach(const std::size_t i) const { return factor * radius[i] + 0.5 * skin; }

      /** The definition of a pair, in the given coordinates. */
      bool near(const NeighbourPair &pair, const Eigen::Matrix3d &base) const
      {
        const Eigen::Vector3d shift(pair.shift[0], pair.shift[1], pair.shift[2]);
        const double          limit  = (1 - tie) * (factor * (radius[pair.first] + radius[pair.second]) + skin);
        Eigen::Vector3d       branch = base * shift;
        if (pair.first != pair.second) // a particle is as far from its image wherever it is: no rounding of its place
          branch += centre[pair.second] - centre[pair.first];
        return branch.squaredNorm() < limit * limit;
      }
    };

    /** Divided box: fraction = inverse (x - origin) lies in [0, 1) inside; along a repeating direction it is brought there. */
    struct Frame
    {
      Eigen::Vector3d     origin = Eigen::Vector3d::Zero();
      Eigen::Matrix3d     base   = Eigen::Matrix3d::Identity(); ///< columns: edges [m]
      Eigen::Matrix3d     inverse;
      std::array<bool, 3> repeats = {{false, false, false}};
      std::array<bool, 3> flat    = {{false, false, false}}; ///< all centres lie at one place along it
      Eigen::Vector3d     height;                            ///< between opposite faces [m]
      double              slack;                             ///< bounds the rounding of positions brought inside [m]

      /** To be called when the four above are set. */
      void complete(const std::vector<Eigen::Vector3d> &centre)
      {
        inverse        = base.inverse();
        height         = inverse.rowwise().norm().cwiseInverse();
        double largest = base.cwiseAbs().maxCoeff();
        for (const Eigen::Vector3d &x : centre)
          largest = std::max(largest, x.cwiseAbs().maxCoeff());
        slack = 64 * std::numeric_limits<double>::epsilon() * largest;
      }
    };

    /** A box around all centres along the directions that do not repeat. */
    void enclose(Frame &frame, const std::vector<Eigen::Vector3d> &centre)
    {
      for (int d = 0; d < 3; ++d)
        if (!frame.repeats[d] && !centre.empty())
          {
            double low = centre[0][d], high = low;
            for (const Eigen::Vector3d &x : centre)
              {
                low  = std::min(low, x[d]);
                high = std::max(high, x[d]);
              }
            frame.origin[d]  = low;
            frame.flat[d]    = !(high > low);
            frame.base(d, d) = frame.flat[d] ? 1.0 : high - low;
          }
    }

    struct Entry
    {
      Eigen::Vector3d             position; ///< inside the box [m]
      Eigen::Vector3d             fraction;
      std::array<std::int32_t, 3> wraps; ///< whole cells taken off
      std::int32_t                particle;
      double                      reach; ///< [m]
    };

    Entry entry_of(const Frame &frame, const Query &query, const std::int32_t particle)
    {
      Entry e;
      e.particle = particle;
      e.reach    = query.reach(particle);
      e.fraction = frame.inverse * (query.centre[particle] - frame.origin);
      for (int d = 0; d < 3; ++d)
        {
          const double whole = frame.repeats[d] ? std::floor(e.fraction[d]) : 0.0;
          if (std::abs(whole) > 1e9)
            throw std::range_error("particle " + std::to_string(particle + 1) + " has strayed more than 1e9 cells.");
          e.wraps[d] = static_cast<std::int32_t>(whole);
          e.fraction[d] -= whole;
        }
      e.position = frame.origin + frame.base * e.fraction;
      return e;
    }

    /** The particles of one size class, sorted by cell. */
    class CellGrid
    {
    public:
      CellGrid(const Frame &box, std::vector<Entry> members)
        : frame(box)
      {
        for (const Entry &e : members)
          largest = std::max(largest, e.reach);
        choose_cells(members.size());
        sort(members);
      }

      std::size_t  size() const { return entries.size(); }
      const Entry &operator[](const std::size_t slot) const { return entries[slot]; }

      /**
       * Call found(other entry, image) for each member, and each of its images apart, within the sum of the two reaches
       * of `seeker`; `image` counts the whole cells by which the other's position is moved.
       *
       * @param own_slot where the seeker stands in this grid: visits only what comes after it (cells in z, y, x order,
       *        all images in one sequence), so that of a pair and its mirror exactly one is found; -1: stands elsewhere.
       */
      template <typename Found>
      void for_each_near(const Entry &seeker, const std::ptrdiff_t own_slot, Found &&found) const
      {
        const bool  half = own_slot >= 0;
        const Index own  = cell_of(seeker);
        Index       low, high;
        window(seeker, low, high);
        for (std::int64_t z = half ? own[2] : low[2]; z <= high[2]; ++z)
          for (std::int64_t y = half && z == own[2] ? own[1] : low[1]; y <= high[1]; ++y)
            if (half && z == own[2] && y == own[1])
              search_row({{own[0], y, z}}, high[0], seeker, own_slot + 1, found);
            else
              search_row({{low[0], y, z}}, high[0], seeker, 0, found);
      }

    private:
      /**
       * Cells as wide as the longest pair reach of the class; wider where that would give many more cells than members. One where all
       * lie side by side: discs would otherwise share few wide cells of their plane with many empty layers above it.
       */
      void choose_cells(const std::size_t members)
      {
        const std::int64_t most  = 64 + 2 * static_cast<std::int64_t>(members);
        double             width = 2 * largest + frame.slack;
        do
          {
            for (int d = 0; d < 3; ++d)
              count[d] =
                frame.flat[d] ?
                  1 :
                  static_cast<std::int64_t>(std::clamp(frame.height[d] / width, 1.0, static_cast<double>(most)));
            width *= 1.25;
          }
        while (static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]) >
               static_cast<double>(most));
      }

      void sort(const std::vector<Entry> &members)
      {
        start.assign(count[0] * count[1] * count[2] + 1, 0);
        for (const Entry &e : members)
          ++start[number(cell_of(e)) + 1];
        for (std::size_t c = 1; c < start.size(); ++c)
          start[c] += start[c - 1];
        std::vector<std::int32_t> next(start.begin(), start.end() - 1);
        entries.resize(members.size());
        for (const Entry &e : members)
          entries[next[number(cell_of(e))]++] = e;
      }

      Index cell_of(const Entry &e) const
      {
        Index cell;
        for (int d = 0; d < 3; ++d)
          cell[d] = std::clamp<std::int64_t>(static_cast<std::int64_t>(e.fraction[d] * count[d]), 0, count[d] - 1);
        return cell;
      }

      std::size_t number(const Index &cell) const { return (cell[2] * count[1] + cell[1]) * count[0] + cell[0]; }

      /** The cells, of all images, that the seeker's ball meets. */
      void window(const Entry &seeker, Index &low, Index &high) const
      {
        const double radius = seeker.reach + largest + frame.slack;
        for (int d = 0; d < 3; ++d)
          {
            const double half = radius / frame.height[d];
            low[d]            = static_cast<std::int64_t>(std::floor((seeker.fraction[d] - half) * count[d]));
            high[d]           = static_cast<std::int64_t>(std::floor((seeker.fraction[d] + half) * count[d]));
            if (!frame.repeats[d])
              {
                low[d]  = std::clamp<std::int64_t>(low[d], 0, count[d] - 1);
                high[d] = std::clamp<std::int64_t>(high[d], 0, count[d] - 1);
              }
          }
      }

      /** Cells from `from` to column `last` of its row, image by image: within one image their members lie side by side. */
      template <typename Found>
      void search_row(
        const Index &from, const std::int64_t last, const Entry &seeker, const std::ptrdiff_t after, Found &found) const
      {
        std::array<std::int64_t, 3> image = {{0, floor_division(from[1], count[1]), floor_division(from[2], count[2])}};
        const Index                 row_start = {{0, from[1] - image[1] * count[1], from[2] - image[2] * count[2]}};
        const std::size_t           row       = number(row_start);
        for (std::int64_t column = from[0]; column <= last;)
          {
            image[0]                  = floor_division(column, count[0]);
            const std::int64_t offset = image[0] * count[0];
            const std::int64_t end    = std::min(last, offset + count[0] - 1);
            std::ptrdiff_t     slot   = start[row + column - offset];
            if (column == from[0])
              slot = std::max(slot, after);
            Eigen::Vector3d moved = seeker.position;
            if (image != Index{{0, 0, 0}})
              moved -= frame.base * Eigen::Vector3d(image[0], image[1], image[2]);
            for (; slot < start[row + end - offset + 1]; ++slot)
              {
                const double limit = seeker.reach + entries[slot].reach + frame.slack;
                if ((entries[slot].position - moved).squaredNorm() < limit * limit)
                  found(entries[slot], image);
              }
            column = end + 1;
          }
      }

      const Frame              &frame;
      Index                     count;
      std::vector<std::int32_t> start; ///< first slot of each cell, and the end
      std::vector<Entry>        entries;
      double                    largest = 0;
    };

    /** One grid per factor of two in reach, largest first; classes without a member are left out. */
    std::vector<CellGrid> sort_into_grids(const Frame &frame, const Query &query)
    {
      const std::size_t n       = query.centre.size();
      double            largest = 0;
      for (std::size_t i = 0; i < n; ++i)
        largest = std::max(largest, query.reach(i));
      std::vector<std::vector<Entry>> classes;
      for (std::size_t i = 0; i < n; ++i)
        {
          const double      reach = query.reach(i);
          const std::size_t level = reach > 0 ? static_cast<std::size_t>(std::ilogb(largest / reach)) : 0;
          if (level >= classes.size())
            classes.resize(level + 1);
          classes[level].push_back(entry_of(frame, query, static_cast<std::int32_t>(i)));
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
            if (query.near(pair, frame.base))
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
                                        const std::optional<Eigen::Vector3d> &cell)
  {
    const Query query{centre, radius, factor, skin};
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
                                                const Eigen::Matrix3d              &cell)
  {
    const Query query{centre, radius, factor, skin};
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

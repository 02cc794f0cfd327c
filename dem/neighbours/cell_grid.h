#pragma once

#include "dem/neighbours/cell_list.h"
#include "dem/neighbours/tie.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

/** What the search for neighbours is made of; nothing else includes it. */
namespace dem::neighbours
{
  using Index = std::array<std::int64_t, 3>;

  inline std::int64_t floor_division(const std::int64_t a, const std::int64_t b)
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
    PairsOf                             of;

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
  inline void enclose(Frame &frame, const std::vector<Eigen::Vector3d> &centre)
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

  inline Entry entry_of(const Frame &frame, const Query &query, const std::int32_t particle)
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

  /** The frame cut into equal cells. */
  struct CellCounts
  {
    Index count;

    /**
   * As wide as requested; wider where that would give many more cells than members. One where all lie side by side: discs would
   * otherwise share few wide cells of their plane with many empty layers above it.
   */
    CellCounts(const Frame &frame, double width, const std::size_t members)
    {
      const std::int64_t most = 64 + 2 * static_cast<std::int64_t>(members);
      do
        {
          for (int d = 0; d < 3; ++d)
            count[d] = frame.flat[d] ?
                         1 :
                         static_cast<std::int64_t>(std::clamp(frame.height[d] / width, 1.0, static_cast<double>(most)));
          width *= 1.25;
        }
      while (static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]) >
             static_cast<double>(most));
    }

    std::size_t cells() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }
    std::size_t number(const Index &cell) const { return (cell[2] * count[1] + cell[1]) * count[0] + cell[0]; }

    Index cell_of(const Entry &e) const
    {
      Index cell;
      for (int d = 0; d < 3; ++d)
        cell[d] = std::clamp<std::int64_t>(static_cast<std::int64_t>(e.fraction[d] * count[d]), 0, count[d] - 1);
      return cell;
    }
  };

  /** The particles of one size class, sorted by cell. */
  class CellGrid
  {
  public:
    CellGrid(const Frame &box, std::vector<Entry> members)
      : frame(box)
      , largest(largest_reach(members))
      , cells(frame, 2 * largest + frame.slack, members.size())
      , count(cells.count)
    {
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
      const Index own  = cells.cell_of(seeker);
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
    static double largest_reach(const std::vector<Entry> &members)
    {
      double largest = 0;
      for (const Entry &e : members)
        largest = std::max(largest, e.reach);
      return largest;
    }

    void sort(const std::vector<Entry> &members)
    {
      start.assign(cells.cells() + 1, 0);
      for (const Entry &e : members)
        ++start[cells.number(cells.cell_of(e)) + 1];
      for (std::size_t c = 1; c < start.size(); ++c)
        start[c] += start[c - 1];
      std::vector<std::int32_t> next(start.begin(), start.end() - 1);
      entries.resize(members.size());
      for (const Entry &e : members)
        entries[next[cells.number(cells.cell_of(e))]++] = e;
    }

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
      const std::size_t           row       = cells.number(row_start);
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
    double                    largest; ///< reach of a member [m]
    CellCounts                cells;
    Index                     count;
    std::vector<std::int32_t> start; ///< first slot of each cell, and the end
    std::vector<Entry>        entries;
  };
} // namespace dem::neighbours

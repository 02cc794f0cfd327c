#include "fem/mesh/gmsh_body.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace fem
{
  namespace
  {
    constexpr unsigned int nothing = std::numeric_limits<unsigned int>::max();

    using Side = std::array<unsigned int, 4>; // local nodes, anticlockwise as seen from outside

    struct Sides
    {
      unsigned int      nodes; // of each
      std::vector<Side> of;
    };

    const Sides &sides_of(const GmshShape shape)
    {
      static const Sides triangle      = {2, {{0, 1}, {1, 2}, {2, 0}}};
      static const Sides quadrilateral = {2, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
      static const Sides tetrahedron   = {3, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
      static const Sides hexahedron    = {
           4, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
      switch (shape)
        {
        case GmshShape::triangle:
          return triangle;
        case GmshShape::quadrilateral:
          return quadrilateral;
        case GmshShape::tetrahedron:
          return tetrahedron;
        default:
          return hexahedron;
        }
    }

    /// At every corner its neighbours, in right-handed order where the element is not inverted.
    const std::vector<std::array<unsigned int, 4>> &corners_of(const GmshShape shape)
    {
      using Corners                      = std::vector<std::array<unsigned int, 4>>;
      static const Corners triangle      = {{0, 1, 2}};
      static const Corners quadrilateral = {{0, 1, 3}, {1, 2, 0}, {2, 3, 1}, {3, 0, 2}};
      static const Corners tetrahedron   = {{0, 1, 2, 3}};
      static const Corners hexahedron    = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                            {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
      switch (shape)
        {
        case GmshShape::triangle:
          return triangle;
        case GmshShape::quadrilateral:
          return quadrilateral;
        case GmshShape::tetrahedron:
          return tetrahedron;
        default:
          return hexahedron;
        }
    }

    /// The mirror image: what is inverted becomes upright.
    void mirror(GmshElement &cell)
    {
      switch (cell.shape)
        {
        case GmshShape::triangle:
          std::swap(cell.nodes[1], cell.nodes[2]);
          break;
        case GmshShape::tetrahedron:
          std::swap(cell.nodes[2], cell.nodes[3]);
          break;
        case GmshShape::hexahedron:
          std::swap(cell.nodes[5], cell.nodes[7]);
          [[fallthrough]];
        default:
          std::swap(cell.nodes[1], cell.nodes[3]);
        }
    }

    class Maker
    {
    public:
      Maker(GmshFile &&file_, const int dimension_, const DoubledNodes doubled_)
        : file(std::move(file_))
        , dimension(dimension_)
        , doubled(doubled_)
      {
      }

      GmshBody make()
      {
        take_cells();
        if (dimension == 2)
          refuse_out_of_plane();
        for (GmshElement &cell : body.cells)
          orient(cell);
        if (doubled == DoubledNodes::refuse)
          refuse_coincident_nodes();
        meet();
        take_groups();
        renumber();
        return std::move(body);
      }

    private:
      std::string node(const unsigned int i) const
      {
        std::ostringstream text;
        text << file.node_numbers[i] << " (" << file.points[i][0] << ' ' << file.points[i][1];
        if (dimension == 3)
          text << ' ' << file.points[i][2];
        text << ')';
        return text.str();
      }

      std::string middle(const GmshElement &e) const
      {
        std::ostringstream text;
        for (int d = 0; d < dimension; ++d)
          {
            double sum = 0;
            for (unsigned int i = 0; i < n_nodes_of(e.shape); ++i)
              sum += file.points[e.nodes[i]][static_cast<std::size_t>(d)] / n_nodes_of(e.shape);
            text << (d > 0 ? " " : "") << sum;
          }
        return text.str();
      }

      static void refuse(const std::string &problem) { throw base::InputError(problem); }

      void take_cells()
      {
        used.assign(file.points.size(), false);
        for (const GmshElement &e : file.elements)
          {
            const unsigned int n = n_nodes_of(e.shape);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < i; ++j)
                if (e.nodes[i] == e.nodes[j])
                  refuse("element " + std::to_string(e.number) + " has the node " +
                         std::to_string(file.node_numbers[e.nodes[i]]) + " twice.");
            if (dimension_of(e.shape) != dimension)
              continue;
            if (!body.cells.empty() && body.cells.front().shape != e.shape)
              refuse("mesh: it mixes element shapes (elements " + std::to_string(body.cells.front().number) + " and " +
                     std::to_string(e.number) +
                     "). Use triangles and tetrahedra only, or quadrilaterals and hexahedra only.");
            body.cells.push_back(e);
            for (unsigned int i = 0; i < n; ++i)
              used[e.nodes[i]] = true;
          }
        if (body.cells.empty())
          refuse("has no element of dimension " + std::to_string(dimension) +
                 ", which is the model's. Give the body a physical group and mesh it in Gmsh in that dimension.");
        for (const GmshElement &cell : body.cells)
          if (file.groups[dimension].count(cell.group) == 0)
            refuse("some elements have no named group. Give every element a named physical group: it selects the "
                   "material. One of them is element " +
                   std::to_string(cell.number) + "." + groups_of_other_dimensions());
      }

      /// Named groups where there is none of the model's dimension: the name has gone to the wrong place.
      std::string groups_of_other_dimensions() const
      {
        std::string text;
        for (const auto &[of, names] : file.groups)
          for (const auto &group : names)
            {
              if (of == dimension)
                return "";
              text += (text.empty() ? "" : ", ") + ('"' + group.second + '"') + " of dimension " + std::to_string(of);
            }
        return text.empty() ? "" : " The named groups are of other dimensions: " + text + ".";
      }

      /// Rounding by the mesh generator is no step out of the plane.
      void refuse_out_of_plane() const
      {
        const double       noise = 1e-9 * largest_extent(2);
        const unsigned int first = body.cells.front().nodes[0];
        for (std::size_t i = 0; i < used.size(); ++i)
          if (used[i] && !(std::fabs(file.points[i][2] - file.points[first][2]) <= noise))
            {
              std::ostringstream text;
              text << "a plane model lies in a plane of equal z, but node " << file.node_numbers[i]
                   << " has z = " << file.points[i][2] << " and node " << file.node_numbers[first]
                   << " has z = " << file.points[first][2] << '.';
              refuse(text.str());
            }
      }

      /// Corners of least and of most coordinates of all nodes that a cell has.
      std::array<std::array<double, 3>, 2> box() const
      {
        std::array<double, 3> low, high;
        low.fill(std::numeric_limits<double>::max());
        high.fill(-std::numeric_limits<double>::max());
        for (std::size_t i = 0; i < used.size(); ++i)
          for (std::size_t d = 0; used[i] && d < 3; ++d)
            {
              low[d]  = std::fmin(low[d], file.points[i][d]);
              high[d] = std::fmax(high[d], file.points[i][d]);
            }
        return {low, high};
      }

      double largest_extent(const std::size_t axes) const
      {
        const auto [low, high] = box();
        double largest         = 0;
        for (std::size_t d = 0; d < axes; ++d)
          largest = std::fmax(largest, high[d] - low[d]);
        return largest;
      }

      double corner_volume(const GmshElement &cell, const std::array<unsigned int, 4> &corner) const
      {
        std::array<std::array<double, 3>, 3> edge{{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}};
        for (std::size_t e = 0; e < static_cast<std::size_t>(dimension); ++e)
          for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
            edge[e][d] = file.points[cell.nodes[corner[e + 1]]][d] - file.points[cell.nodes[corner[0]]][d];
        return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
               edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
               edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
      }

      void orient(GmshElement &cell) const
      {
        double least = std::numeric_limits<double>::max(), most = -least;
        for (const auto &corner : corners_of(cell.shape))
          {
            const double volume = corner_volume(cell, corner);
            least               = std::fmin(least, volume);
            most                = std::fmax(most, volume);
          }
        if (most < 0)
          mirror(cell);
        else if (!(least > 0))
          refuse("mesh: element " + std::to_string(cell.number) + " at " + middle(cell) +
                 " is inverted or flat (its Jacobian has not the same sign at every corner). Repair the mesh there.");
      }

      /// Two nodes at one place appear as one in every picture, but the elements around them do not hold together.
      void refuse_coincident_nodes() const
      {
        const std::array<double, 3> low     = box()[0];
        const double                largest = largest_extent(3);

        using Rounded = std::pair<std::array<std::int64_t, 3>, unsigned int>;
        std::vector<Rounded> places;
        for (unsigned int i = 0; i < used.size(); ++i)
          if (used[i])
            {
              places.push_back({{}, i});
              for (std::size_t d = 0; d < 3; ++d)
                places.back().first[d] = std::llround((file.points[i][d] - low[d]) / (1e-9 * largest));
            }
        std::sort(places.begin(), places.end());
        const auto pair = std::adjacent_find(places.begin(), places.end(),
                                             [](const Rounded &a, const Rounded &b) { return a.first == b.first; });
        if (pair != places.end())
          refuse("mesh: the nodes " + node(pair->second) + " and " + node((pair + 1)->second) +
                 " are at one place, so the elements around them do not hold together. Merge them (in Gmsh: Coherence "
                 "Mesh); for a notch without width set Mesh/Doubled nodes = notch.");
      }

      struct Meeting
      {
        SideKey      key;
        unsigned int cell, side;
      };

      /// The nodes of a side, anticlockwise as seen from outside its cell.
      std::vector<unsigned int> around(const Meeting &m) const
      {
        const GmshElement        &cell  = body.cells[m.cell];
        const Sides              &sides = sides_of(cell.shape);
        std::vector<unsigned int> nodes;
        for (unsigned int i = 0; i < sides.nodes; ++i)
          nodes.push_back(cell.nodes[sides.of[m.side][i]]);
        return nodes;
      }

      /// The same circle of nodes from the one of smallest number; of two nodes the order itself is the direction.
      static std::vector<unsigned int> from_smallest(std::vector<unsigned int> nodes)
      {
        if (nodes.size() > 2)
          std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
      }

      /// Every side belongs to one cell, or to two that lie on either side of it.
      void meet()
      {
        std::vector<Meeting> all;
        for (unsigned int c = 0; c < body.cells.size(); ++c)
          {
            const GmshElement &cell  = body.cells[c];
            const Sides       &sides = sides_of(cell.shape);
            for (unsigned int s = 0; s < sides.of.size(); ++s)
              {
                Side nodes{};
                for (unsigned int i = 0; i < sides.nodes; ++i)
                  nodes[i] = cell.nodes[sides.of[s][i]];
                all.push_back({side_key(nodes, sides.nodes), c, s});
              }
          }
        std::sort(all.begin(), all.end(),
                  [](const Meeting &a, const Meeting &b) { return a.key != b.key ? a.key < b.key : a.cell < b.cell; });
        for (std::size_t i = 0; i < all.size();)
          {
            std::size_t end = i + 1;
            while (end < all.size() && all[end].key == all[i].key)
              ++end;
            if (end - i == 1)
              surface.emplace_back(all[i].key);
            else
              prove_meeting(all[i], all[i + 1], end - i);
            i = end;
          }
      }

      void prove_meeting(const Meeting &a, const Meeting &b, const std::size_t cells) const
      {
        const auto both = [&] {
          return "mesh: elements " + std::to_string(body.cells[a.cell].number) + " and " +
                 std::to_string(body.cells[b.cell].number) + " at " + middle(body.cells[a.cell]);
        };
        if (cells > 2)
          refuse(both() + " and others share one side; at most two can. Remove what is there twice.");
        const auto                seen = from_smallest(around(a));
        std::vector<unsigned int> back = around(b);
        if (seen == from_smallest(back))
          refuse(both() + " lie over each other: both are on the same side of the side they share.");
        std::reverse(back.begin(), back.end());
        if (seen != from_smallest(back))
          refuse(both() + " share a side that is twisted between them.");
      }

      void take_groups()
      {
        const auto &names = file.groups[dimension - 1];
        for (const GmshElement &e : file.elements)
          {
            if (dimension_of(e.shape) != dimension - 1 || e.group == 0)
              continue;
            const std::string group = std::to_string(e.group);
            const auto        name  = names.find(e.group);
            if (name == names.end())
              refuse("physical group " + group +
                     " of its boundary has no name. Name it in Gmsh: Physical ...(\"name\", " + group + ").");
            const std::string what = "mesh: element " + std::to_string(e.number) + " of the physical group \"" +
                                     name->second + "\" at " + middle(e);
            const SideKey key = side_key({e.nodes[0], e.nodes[1], e.nodes[2], e.nodes[3]}, n_nodes_of(e.shape));
            if (!std::binary_search(surface.begin(), surface.end(), key))
              refuse(what + " is not on the surface of the body. Groups of this dimension name parts of the surface.");
            const auto known = body.groups.emplace(key, e.group);
            if (!known.second && known.first->second != e.group)
              refuse(what + " belongs to another group too, \"" + names.at(known.first->second) +
                     "\". A part of the surface has one name.");
          }
      }

      /// Nodes that no cell has are left out.
      void renumber()
      {
        std::vector<unsigned int> place(used.size(), nothing);
        for (std::size_t i = 0; i < used.size(); ++i)
          if (used[i])
            {
              place[i] = static_cast<unsigned int>(body.points.size());
              body.points.push_back(file.points[i]);
            }
        for (GmshElement &cell : body.cells)
          for (unsigned int i = 0; i < n_nodes_of(cell.shape); ++i)
            cell.nodes[i] = place[cell.nodes[i]];
        std::map<SideKey, int> groups; // the order of the nodes, and so of the keys, stays
        for (const auto &[key, group] : body.groups)
          {
            SideKey renumbered = key;
            for (unsigned int &n : renumbered)
              n = n == nothing ? nothing : place[n];
            groups.emplace_hint(groups.end(), renumbered, group);
          }
        body.groups = std::move(groups);
      }

      GmshFile             file;
      int                  dimension;
      DoubledNodes         doubled;
      GmshBody             body;
      std::vector<bool>    used;    // by a cell
      std::vector<SideKey> surface; // sides of one cell only, in rising order
    };
  }

  SideKey side_key(std::array<unsigned int, 4> nodes, const unsigned int n_nodes)
  {
    std::fill(nodes.begin() + n_nodes, nodes.end(), nothing);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  GmshBody body_of(GmshFile &&file, const int dimension, const DoubledNodes doubled)
  {
    return Maker(std::move(file), dimension, doubled).make();
  }
}

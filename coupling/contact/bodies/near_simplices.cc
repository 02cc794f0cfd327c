#include "coupling/contact/bodies/near_simplices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coupling::bodies
{
  using Box = Eigen::AlignedBox3d;

  namespace
  {
    constexpr double growth = 0.2; ///< of a box, over its size: a list lasts for many steps, and is short

    using Cells = Eigen::Array<std::int64_t, 3, 1>;

    /** Boxes in the cells of a grid over a region. */
    class BoxGrid
    {
    public:
      BoxGrid(const std::vector<Box> &boxes_, const std::vector<std::int32_t> &members, const Box &region_)
        : boxes(boxes_)
        , region(region_)
        , stamp(boxes_.size(), -1)
      {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const std::int32_t m : members)
          mean += boxes[index(m)].sizes();
        mean /= static_cast<double>(members.size());
        size              = mean.maxCoeff();
        const double most = 4.0 * static_cast<double>(members.size()) + 64;
        for (;; size *= 1.26)
          {
            const Eigen::Array3d along = (region.sizes().array() / size).floor() + 1;
            if (along.prod() > most)
              continue;
            cells = along.cast<std::int64_t>();
            break;
          }
        held.resize(static_cast<std::size_t>(cells.prod()));
        for (const std::int32_t m : members)
          each_cell(boxes[index(m)], [&](const std::size_t cell) { held[cell].push_back(m); });
      }

      /** Call visit(member) once for all whose box meets the box of this one. */
      template <typename Visit>
      void meet(const std::int32_t one, const Visit &visit)
      {
        each_cell(boxes[index(one)], [&](const std::size_t cell) {
          for (const std::int32_t m : held[cell])
            if (stamp[index(m)] != one)
              {
                stamp[index(m)] = one;
                if (boxes[index(m)].intersects(boxes[index(one)]))
                  visit(m);
              }
        });
      }

    private:
      static std::size_t index(const std::int32_t i) { return static_cast<std::size_t>(i); }

      Cells cell_of(const Eigen::Vector3d &x) const
      {
        const Eigen::Array3d at = ((x - region.min()).array() / size).floor();
        return at.max(0.0).min((cells - 1).cast<double>()).cast<std::int64_t>();
      }

      template <typename Visit>
      void each_cell(const Box &box, const Visit &visit) const
      {
        if (!box.intersects(region))
          return;
        const Cells first = cell_of(box.min()), last = cell_of(box.max());
        for (std::int64_t z = first[2]; z <= last[2]; ++z)
          for (std::int64_t y = first[1]; y <= last[1]; ++y)
            for (std::int64_t x = first[0]; x <= last[0]; ++x)
              visit(static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x));
      }

      const std::vector<Box>                &boxes;
      Box                                    region;
      double                                 size = 0;
      Cells                                  cells;
      std::vector<std::vector<std::int32_t>> held;
      std::vector<std::int32_t>              stamp;
    };

    bool share_a_vertex(const BodyElement &a, const BodyElement &b)
    {
      return std::any_of(a.vertices.begin(), a.vertices.end(), [&b](const std::int32_t v) {
        return std::find(b.vertices.begin(), b.vertices.end(), v) != b.vertices.end();
      });
    }

    Box box_of(const BodyMesh &mesh, const std::size_t simplex)
    {
      Box box;
      for (int c = 0; c < mesh.corners; ++c)
        box.extend(mesh.place[static_cast<std::size_t>(mesh.simplices[simplex].vertex[c])]);
      return box;
    }

    Box grown(const Box &box, const double by)
    {
      return Box(box.min() - Eigen::Vector3d::Constant(by), box.max() + Eigen::Vector3d::Constant(by));
    }
  } // namespace

  bool NearBodies::good(const BodyMesh &mesh) const
  {
    if (reference.empty())
      return false;
    for (std::size_t v = 0; v < reference.size(); ++v)
      if ((mesh.place[v] - reference[v]).squaredNorm() > reach[v] * reach[v])
        return false;
    return true;
  }

  void NearBodies::search(const BodyMesh &mesh)
  {
    boxes.resize(mesh.simplices.size());
    reach.assign(mesh.place.size(), std::numeric_limits<double>::infinity());
    std::vector<Box>                       around(mesh.bodies.size());
    std::vector<std::vector<std::int32_t>> of_body(mesh.bodies.size());
    for (std::size_t s = 0; s < boxes.size(); ++s)
      {
        const Box    box = box_of(mesh, s);
        const double by  = growth * box.sizes().maxCoeff();
        boxes[s]         = grown(box, by);
        for (int c = 0; c < mesh.corners; ++c)
          {
            double &least = reach[static_cast<std::size_t>(mesh.simplices[s].vertex[c])];
            least         = std::min(least, by);
          }
        const auto body = static_cast<std::size_t>(mesh.body_of(mesh.simplices[s]));
        around[body].extend(boxes[s]);
        of_body[body].push_back(static_cast<std::int32_t>(s));
      }
    const auto within = [&](const std::size_t body, const Box &region) {
      std::vector<std::int32_t> members;
      for (const std::int32_t s : of_body[body])
        if (boxes[static_cast<std::size_t>(s)].intersects(region))
          members.push_back(s);
      return members;
    };
    pairs.clear();
    for (std::size_t a = 0; a < around.size(); ++a)
      for (std::size_t b = same ? a : a + 1; b < around.size(); ++b)
        {
          if (!around[a].intersects(around[b]))
            continue;
          const Box  region = around[a].intersection(around[b]);
          const auto first = within(a, region), second = within(b, region);
          if (first.empty() || second.empty())
            continue;
          BoxGrid grid(boxes, second, region);
          for (const std::int32_t s : first)
            grid.meet(s, [&](const std::int32_t t) {
              const auto element = [&](const std::int32_t of) -> const BodyElement & {
                return mesh.elements[static_cast<std::size_t>(mesh.simplices[static_cast<std::size_t>(of)].element)];
              };
              if (a != b || (s < t && !share_a_vertex(element(s), element(t))))
                pairs.push_back({s, t});
            });
        }
    std::sort(pairs.begin(), pairs.end());
    list_simplices();
    reference = mesh.place;
    ++search_count;
  }

  void NearBodies::list_simplices()
  {
    listed.clear();
    for (const NearSimplices &pair : pairs)
      listed.insert(listed.end(), {pair.first, pair.second});
    std::sort(listed.begin(), listed.end());
    listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
  }

  const std::vector<NearSimplices> &NearBodies::update(const BodyMesh &mesh)
  {
    if (!good(mesh))
      search(mesh);
    for (const std::int32_t s : listed)
      boxes[static_cast<std::size_t>(s)] = box_of(mesh, static_cast<std::size_t>(s));
    return pairs;
  }
} // namespace coupling::bodies

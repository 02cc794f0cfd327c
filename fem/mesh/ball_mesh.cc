#include "fem/mesh/ball_mesh.h"

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace fem
{
  using namespace dealii;

  namespace
  {
    constexpr double eighth_turn = 0.25 * 3.14159265358979323846;
    /// Half an edge of the cube within, over the radius: elements are about as large there as beside it.
    constexpr double core = 0.35;

    /// Call use(signs) for each orthant: signs of one bit per axis.
    template <int dim, typename Use>
    void each_orthant(const Use &use)
    {
      for (unsigned int bits = 0; bits < 1u << dim; ++bits)
        {
          std::array<double, dim> sign;
          for (unsigned int d = 0; d < dim; ++d)
            sign[d] = bits >> d & 1u ? 1 : -1;
          use(sign);
        }
    }

    /**
     * The blocks of a ball, in a cube from -1 to 1 whose surface becomes the sphere, and whose last axis points to the finest place.
     */
    template <int dim>
    class BallBlocks
    {
    public:
      static constexpr unsigned int corners = 1u << dim;
      using Signs                           = std::array<double, dim>;
      using Lengths                         = std::array<double, dim>;
      using Block = std::array<unsigned int, corners>; ///< points at its corners, in deal.II's order

      /// @param fineness how much smaller elements are at the finest place
      explicit BallBlocks(const double fineness)
      {
        const auto as_it_is = [](const Point<dim> &p) { return p; };
        each_orthant<dim>([&](const Signs &sign) { add_box(sign, sizes(core, core), as_it_is); });
        each_orthant<dim>([&](const Signs &sign) {
          for (unsigned int side = 0; side < dim; ++side)
            if (side + 1 < dim || sign[side] < 0)
              add_around(sign, side, sizes(core, core), sizes(1, 1), as_it_is);
        });
        add_finest_side(fineness);
      }

      std::vector<Point<dim>> points;
      std::vector<Block>      blocks;

    private:
      static Lengths sizes(const double across, const double along)
      {
        Lengths found;
        found.fill(across);
        found[dim - 1] = along;
        return found;
      }

      /// Halves of boxes at the surface, each half as large as the next or somewhat more.
      void add_finest_side(const double fineness)
      {
        const auto below_surface =
          [](const Point<dim> &p) { // across: parts of the side, which is narrower within; along: depth
            Point<dim> place = (1 - p[dim - 1]) * p;
            place[dim - 1]   = 1 - p[dim - 1];
            return place;
          };
        constexpr double rounding = 1e-9;
        const double     boxes    = std::ceil(std::log2(fineness) - rounding);
        const auto       box      = [&](const double number) {
          const double part = boxes > 0 ? std::pow(fineness, -number / boxes) : 1.0;
          return sizes(part, (1 - core) * part);
        };
        each_orthant<dim>([&](const Signs &sign) {
          if (sign[dim - 1] < 0)
            return;
          add_box(sign, box(boxes), below_surface);
          for (double number = 0; number < boxes; ++number)
            for (unsigned int side = 0; side < dim; ++side)
              add_around(sign, side, box(number + 1), box(number), below_surface);
        });
      }

      /// What of a box about the origin lies in an orthant.
      template <typename Map>
      void add_box(const Signs &sign, const Lengths &size, const Map &map)
      {
        add_block(
          [&](const auto &end) {
            Point<dim> p;
            for (unsigned int d = 0; d < dim; ++d)
              p[d] = end[d] ? sign[d] * size[d] : 0;
            return p;
          },
          map);
      }

      /// What lies between two boxes about the origin in an orthant, on the side of one axis.
      template <typename Map>
      void
      add_around(const Signs &sign, const unsigned int side, const Lengths &inner, const Lengths &outer, const Map &map)
      {
        add_block(
          [&](const auto &end) {
            Point<dim> p;
            for (unsigned int d = 0; d < dim; ++d)
              p[d] = end[d] || d == side ? sign[d] * (end[side] ? outer[d] : inner[d]) : 0;
            return p;
          },
          map);
      }

      template <typename Place, typename Map>
      void add_block(const Place &place, const Map &map)
      {
        Block block;
        for (unsigned int c = 0; c < corners; ++c)
          {
            std::array<bool, dim> end;
            for (unsigned int d = 0; d < dim; ++d)
              end[d] = (c >> d & 1u) != 0;
            block[c] = point(map(place(end)));
          }
        blocks.push_back(block);
      }

      unsigned int point(const Point<dim> &place)
      {
        constexpr double rounding = 1e-9; // the smallest block is larger than a thousandth
        const auto       same     = std::find_if(points.begin(), points.end(),
                                                 [&](const Point<dim> &known) { return known.distance(place) < rounding; });
        const auto       number   = static_cast<unsigned int>(same - points.begin());
        if (same == points.end())
          points.push_back(place);
        return number;
      }
    };

    /// Elements of blocks that are each divided alike along every edge.
    template <int dim>
    class Divided
    {
    public:
      Divided(const BallBlocks<dim> &blocks, const unsigned int divisions)
        : coarse(blocks)
        , parts(divisions)
      {
        for (const auto &block : coarse.blocks)
          each(parts, [&](const Numbers &first) { add(block, first); });
      }

      std::vector<Point<dim>>    vertices;
      std::vector<CellData<dim>> cells;

    private:
      using Numbers = std::array<unsigned int, dim>;
      /// A place among points of the blocks: those that have part in it, ascending, with their parts in a whole number.
      using Mean = std::vector<std::pair<unsigned int, unsigned int>>;

      /// Call use(numbers) for all that are each less than a count.
      template <typename Use>
      static void each(const unsigned int count, const Use &use)
      {
        unsigned int all = 1;
        for (unsigned int d = 0; d < dim; ++d)
          all *= count;
        for (unsigned int n = 0; n < all; ++n)
          {
            Numbers      numbers;
            unsigned int rest = n;
            for (unsigned int &number : numbers)
              {
                number = rest % count;
                rest /= count;
              }
            use(numbers);
          }
      }

      void add(const typename BallBlocks<dim>::Block &block, const Numbers &first)
      {
        CellData<dim> cell;
        cell.vertices.clear();
        for (unsigned int c = 0; c < BallBlocks<dim>::corners; ++c)
          {
            Numbers at = first;
            for (unsigned int d = 0; d < dim; ++d)
              at[d] += c >> d & 1u;
            cell.vertices.push_back(vertex(block, at));
          }
        cells.push_back(cell);
      }

      /// Blocks that share a side make the same mean of the same points there.
      unsigned int vertex(const typename BallBlocks<dim>::Block &block, const Numbers &at)
      {
        Mean mean;
        for (unsigned int c = 0; c < BallBlocks<dim>::corners; ++c)
          {
            unsigned int part = 1;
            for (unsigned int d = 0; d < dim; ++d)
              part *= c >> d & 1u ? at[d] : parts - at[d];
            if (part > 0)
              mean.emplace_back(block[c], part);
          }
        std::sort(mean.begin(), mean.end());
        const auto [known, is_new] = numbers.emplace(mean, static_cast<unsigned int>(vertices.size()));
        if (is_new)
          {
            Point<dim> place;
            for (const auto &[point, part] : mean)
              place += part / std::pow(parts, dim) * Tensor<1, dim>(coarse.points[point]);
            vertices.push_back(place);
          }
        return known->second;
      }

      const BallBlocks<dim>       &coarse;
      unsigned int                 parts;
      std::map<Mean, unsigned int> numbers;
    };

    /// From the cube into the unit ball: the cube within stays as it is, and faces of the larger one become equal angles.
    template <int dim>
    Point<dim> in_ball(const Point<dim> &p)
    {
      double size = 0;
      for (unsigned int d = 0; d < dim; ++d)
        size = std::max(size, std::fabs(p[d]));
      if (size <= core)
        return p;
      Tensor<1, dim> along;
      for (unsigned int d = 0; d < dim; ++d)
        along[d] = std::tan(eighth_turn * p[d] / size);
      const double round = (size - core) / (1 - core);
      return Point<dim>((1 - round) * core / size * Tensor<1, dim>(p) + round / along.norm() * along);
    }

    /// A part of the unit sphere with its corners, and the pyramid from the centre to them, both as volumes.
    struct Pyramid
    {
      double round = 0, straight = 0;
    };

    void add_part(const Point<2> &a, const Point<2> &b, Pyramid &found)
    {
      const double turn = std::fabs(a[0] * b[1] - a[1] * b[0]);
      found.straight += turn / 2;
      found.round += std::atan2(turn, a * b) / 2;
    }

    /// A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126. @param part of it that counts
    void add_part(const Point<3> &a, const Point<3> &b, const Point<3> &c, const double part, Pyramid &found)
    {
      const double product = std::fabs(a * cross_product_3d(b, c));
      found.straight += part * product / 6;
      found.round += part * 2 * std::atan2(product, 1 + a * b + b * c + c * a) / 3;
    }

    Pyramid pyramid(const Triangulation<2>::face_iterator &face)
    {
      Pyramid found;
      add_part(face->vertex(0), face->vertex(1), found);
      return found;
    }

    /// Of a bilinear face: the mean over both diagonals.
    Pyramid pyramid(const Triangulation<3>::face_iterator &face)
    {
      Pyramid found;
      for (const auto &[a, b, c] : {std::array{0u, 1u, 3u}, {0u, 3u, 2u}, {0u, 1u, 2u}, {1u, 3u, 2u}})
        add_part(face->vertex(a), face->vertex(b), face->vertex(c), 0.5, found);
      return found;
    }

    /// Lift the nodes on the unit sphere so that each face has about the volume of its part of the ball below it, and all together have it.
    template <int dim>
    void keep_volume(Triangulation<dim> &mesh)
    {
      std::map<unsigned int, Point<dim> *> nodes;
      std::map<unsigned int, Pyramid> lifts; // of each node: lift of its faces, by their parts of the sphere, and these
      Pyramid                         ball;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const Pyramid found = pyramid(face);
              ball.round += found.round;
              for (const unsigned int v : face->vertex_indices())
                {
                  nodes[face->vertex_index(v)] = &face->vertex(v);
                  Pyramid &sum                 = lifts[face->vertex_index(v)];
                  sum.straight += found.round * (found.round / found.straight - 1) / dim;
                  sum.round += found.round;
                }
            }
      const double  straight = GridTools::volume(mesh);
      constexpr int passes   = 5;         // each is exact but for the squares of lifts
      double        part = 0, wanted = 1; // of the lifts
      for (int pass = 0; pass < passes; ++pass)
        {
          for (const auto &[number, node] : nodes)
            {
              const double lift = lifts[number].straight / lifts[number].round;
              *node *= (1 + wanted * lift) / (1 + part * lift);
            }
          part = wanted;
          wanted *= (ball.round - straight) / (GridTools::volume(mesh) - straight);
        }
    }

    /// Axes of a ball, the last towards its finest place.
    std::array<Tensor<1, 2>, 2> axes(const Tensor<1, 2> &towards) { return {{cross_product_2d(towards), towards}}; }
    std::array<Tensor<1, 3>, 3> axes(const Tensor<1, 3> &towards)
    {
      unsigned int least = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::fabs(towards[d]) < std::fabs(towards[least]))
          least = d;
      Tensor<1, 3> first;
      first[least] = 1;
      first -= (first * towards) * towards;
      first /= first.norm();
      return {{first, cross_product_3d(towards, first), towards}};
    }
  }

  template <int dim>
  void make_ball(const NamedBall &ball, Triangulation<dim> &mesh)
  {
    Tensor<1, dim> towards, centre;
    for (unsigned int d = 0; d < dim; ++d)
      {
        towards[d] = ball.towards[d];
        centre[d]  = ball.centre[d];
      }
    const bool graded = towards.norm() > 0;
    if (graded)
      towards /= towards.norm();
    else
      towards[dim - 1] = 1;

    const BallBlocks<dim> blocks(graded ? ball.fineness : 1.0);
    Divided<dim>          elements(blocks, ball.divisions / 2);
    for (Point<dim> &vertex : elements.vertices)
      vertex = in_ball(vertex);
    GridTools::invert_cells_with_negative_measure(elements.vertices, elements.cells);
    GridTools::consistently_order_cells(elements.cells);
    mesh.create_triangulation(elements.vertices, elements.cells, SubCellData());
    keep_volume(mesh);
    GridTools::transform(
      [&, along = axes(towards)](const Point<dim> &p) {
        Tensor<1, dim> place = centre;
        for (unsigned int d = 0; d < dim; ++d)
          place += ball.radius * p[d] * along[d];
        return Point<dim>(place);
      },
      mesh);
  }

  template void make_ball(const NamedBall &, Triangulation<2> &);
  template void make_ball(const NamedBall &, Triangulation<3> &);
}

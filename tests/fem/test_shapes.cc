// Built-in shapes have the measures that they were given.
#include "fem/mesh/shapes.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <map>

TEST_CASE("a round bar has the volume and the end faces of a cylinder at every refinement, blocks and simplices",
          "[fem]")
{
  fem::CylinderShape bar;
  bar.length           = 0.3;
  bar.radius           = 0.02;
  bar.divisions        = 2;
  const double section = 3.14159265358979323846 * bar.radius * bar.radius;
  for (const auto family : {fem::ElementFamily::hypercube, fem::ElementFamily::simplex})
    for (const unsigned int refinements : {0u, 1u, 2u})
      {
        fem::ShapeOptions options;
        options.family       = family;
        options.refinements  = family == fem::ElementFamily::simplex ? std::min(refinements, 1u) : refinements;
        options.communicator = MPI_COMM_SELF;
        const auto mesh      = fem::make_shape<3>(bar, options);
        double     volume = 0, left = 0, right = 0;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          {
            volume += cell->measure();
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary())
                {
                  left += cell->face(f)->boundary_id() == mesh.boundary("left") ? cell->face(f)->measure() : 0;
                  right += cell->face(f)->boundary_id() == mesh.boundary("right") ? cell->face(f)->measure() : 0;
                }
          }
        CAPTURE(refinements);
        CHECK(volume == Approx(section * bar.length).epsilon(1e-10));
        CHECK(left == Approx(section).epsilon(1e-10));
        CHECK(right == Approx(section).epsilon(1e-10));
      }
}

TEST_CASE("boxes are bodies of their own, with their materials and the names of their sides, even where they touch",
          "[fem]")
{
  fem::BodiesShape shape;
  shape.boxes = {{"lower", "steel", {0.1, 0, -0.02}, {0.2, 0.3, 0.02}, {2, 3, 1}},
                 {"upper", "brass", {0.1, 0, 0}, {0.2, 0.3, 0.05}, {2, 3, 2}},
                 {"far", "steel", {1, 1, 1}, {0.1, 0.1, 0.1}, {1, 1, 1}}};
  for (const auto family : {fem::ElementFamily::hypercube, fem::ElementFamily::simplex})
    {
      fem::ShapeOptions options;
      options.family       = family;
      options.refinements  = 1;
      options.communicator = MPI_COMM_SELF;
      const auto mesh      = fem::make_shape<3>(shape, options);
      CHECK(mesh.boundaries.size() == 2 * 18); // each by word and by axis
      std::map<dealii::types::boundary_id, double> area;
      std::map<dealii::types::material_id, double> volume;
      for (const auto &cell : mesh.triangulation->active_cell_iterators())
        {
          volume[cell->material_id()] += cell->measure();
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                area[cell->face(f)->boundary_id()] += cell->face(f)->measure();
                if (cell->face(f)->boundary_id() == mesh.boundary("upper back"))
                  CHECK(cell->face(f)->center()[2] == Approx(0).margin(1e-15));
              }
        }
      CHECK(area.at(mesh.boundary("lower front")) == Approx(0.06).epsilon(1e-12)); // both sides of the joint are there
      CHECK(area.at(mesh.boundary("upper back")) == Approx(0.06).epsilon(1e-12));
      CHECK(area.at(mesh.boundary("upper left")) == Approx(0.015).epsilon(1e-12));
      CHECK(volume.at(mesh.materials.at("steel")) == Approx(0.0012 + 0.001).epsilon(1e-12));
      CHECK(volume.at(mesh.materials.at("brass")) == Approx(0.003).epsilon(1e-12));
    }
}

TEST_CASE("boxes that overlap, have no extent or share a name are refused by name", "[fem]")
{
  fem::ShapeOptions options;
  options.communicator     = MPI_COMM_SELF;
  const fem::NamedBox a    = {"a", "solid", {0, 0, 0}, {1, 1, 1}, {1, 1, 1}};
  fem::NamedBox       b    = {"b", "solid", {0.5, 0.5, 0.5}, {1, 1, 1}, {1, 1, 1}};
  const auto          made = [&] { return fem::make_shape<3>(fem::BodiesShape{{a, b}, {}}, options); };
  CHECK_THROWS_WITH(made(), Catch::Contains("boxes a and b overlap"));
  b.corner = {1, 0, 0};
  CHECK_NOTHROW(made());
  b.name = "a";
  CHECK_THROWS_WITH(made(), Catch::Contains("two of them are named a"));
  b.name = "b";
  b.size = {1, 0, 1};
  CHECK_THROWS_WITH(made(), Catch::Contains("box b: its size"));
}

namespace
{
  fem::Mesh<3> ball_mesh(const fem::NamedBall &ball)
  {
    fem::BodiesShape shape;
    shape.balls = {ball};
    fem::ShapeOptions options;
    options.communicator = MPI_COMM_SELF;
    return fem::make_shape<3>(shape, options);
  }

  fem::NamedBall ball_towards_y(const double fineness)
  {
    fem::NamedBall ball;
    ball.name     = "one";
    ball.centre   = {1, 2, -3};
    ball.radius   = 0.5;
    ball.towards  = {0, 3, 0};
    ball.fineness = fineness;
    return ball;
  }
}

TEST_CASE(
  "a ball has its volume whatever its elements, and its nodes lie on the sphere to the square of their distance",
  "[fem]")
{
  double off[2];
  for (const unsigned int divisions : {4u, 8u})
    for (const double fineness : {1.0, 3.0, 40.0})
      {
        fem::NamedBall ball = ball_towards_y(fineness);
        ball.divisions      = divisions;
        const auto mesh     = ball_mesh(ball);
        double     volume = 0, &farthest = off[divisions / 8];
        farthest = 0;
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          {
            volume += cell->measure();
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary())
                {
                  REQUIRE(face->boundary_id() == mesh.boundary("one"));
                  for (const unsigned int v : face->vertex_indices())
                    farthest = std::max(farthest, std::fabs(face->vertex(v).distance({1, 2, -3}) - ball.radius));
                }
          }
        CAPTURE(divisions, fineness);
        CHECK(volume == Approx(4.0 / 3.0 * M_PI * 0.125).epsilon(1e-8));
        CHECK(farthest < 0.026 * ball.radius); // a sixth of the square of their distance, at four of them
      }
  CHECK(std::log2(off[0] / off[1]) == Approx(2).margin(0.1));
}

TEST_CASE("elements of a ball are finer towards one side by as much as wanted, and elsewhere as they were", "[fem]")
{
  std::map<double, double> finest, coarsest;
  for (const double fineness : {1.0, 2.0, 5.0, 100.0})
    {
      const auto             mesh = ball_mesh(ball_towards_y(fineness));
      const dealii::Point<3> pole(1, 2.5, -3), far(1, 1.5, -3);
      const auto             edge_at = [&](const dealii::Point<3> &place) {
        for (const auto &cell : mesh.triangulation->active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              for (const unsigned int v : face->vertex_indices())
                if (face->vertex(v).distance(place) < 0.005)
                  return face->vertex(0).distance(face->vertex(1));
        return 0.0;
      };
      finest[fineness]   = edge_at(pole);
      coarsest[fineness] = edge_at(far);
      CAPTURE(fineness);
      CHECK(finest[fineness] == Approx(finest[1] / fineness).epsilon(0.03));
      CHECK(coarsest[fineness] == Approx(coarsest[1]).epsilon(1e-3));
    }
}

TEST_CASE("a ball without radius, of an odd number of elements, or coarser towards one side is refused by name",
          "[fem]")
{
  fem::NamedBall none = ball_towards_y(2), odd = none, coarser = none;
  none.radius      = 0;
  odd.divisions    = 5;
  coarser.fineness = 0.5;
  CHECK_THROWS_WITH(ball_mesh(none), Catch::Contains("ball one") && Catch::Contains("radius"));
  CHECK_THROWS_WITH(ball_mesh(odd), Catch::Contains("ball one") && Catch::Contains("even"));
  CHECK_THROWS_WITH(ball_mesh(coarser), Catch::Contains("ball one") && Catch::Contains("fineness"));
}

// Built-in shapes have the measures that they were given.
#include "fem/mesh/shapes.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/tria.h>

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

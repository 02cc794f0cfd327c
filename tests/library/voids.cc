// Places without particles: which lines meet them, and that no link crosses them.
#include "apps/models/region.h"
#include "apps/runs/structure/model.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

namespace
{
  using Shape = apps::Region::Shape;

  /** Of about the same extent, about the same middle; @param by added to all of its half widths [m] */
  apps::Region widened(const Shape shape, const double by)
  {
    apps::Region region;
    region.shape  = shape;
    region.lower  = {0.2 - by, 0.3 - by, 0.1 - by};
    region.upper  = {0.7 + by, 0.5 + by, 0.9 + by};
    region.centre = {0.5, 0.4, 0.6};
    region.radius = 0.25 + by;
    // Longer by as much along its axis, whose direction is (3, 0, 4) / 5.
    region.from = {0.2 - 0.6 * by, 0.5, 0.1 - 0.8 * by};
    region.to   = {0.8 + 0.6 * by, 0.5, 0.9 + 0.8 * by};
    return region;
  }

  bool held_somewhere(const apps::Region    &region,
                      const Eigen::Vector3d &one,
                      const Eigen::Vector3d &other,
                      const int              dimension)
  {
    constexpr int parts = 2000;
    for (int k = 0; k <= parts; ++k)
      if (region.holds(one + double(k) / parts * (other - one), dimension))
        return true;
    return false;
  }

  /** Two rows of touching discs above each other, with the void of a notch between them from the left end on. */
  apps::StructureModel two_rows(const double notch)
  {
    apps::StructureModel model;
    model.dimension                = 2;
    model.source.interaction_ratio = 1.5;
    model.source.thickness         = 0.01;
    model.material.only.choose(cluster::concrete());
    apps::VoidSection &empty = model.voids.emplace_back();
    empty.region.shape       = Shape::box;
    empty.region.lower       = {-1, 0.0009, 0};
    empty.region.upper       = {notch, 0.0011, 0};
    return model;
  }
} // namespace

TEST_CASE("A line meets a region where one of its places lies in it", "[apps][structure]")
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> anywhere(-0.2, 1.2);
  const auto place = [&] { return Eigen::Vector3d(anywhere(random), anywhere(random), anywhere(random)); };
  for (const int dimension : {2, 3})
    for (const Shape shape : {Shape::box, Shape::sphere, Shape::cylinder})
      {
        int met = 0;
        for (int n = 0; n < 500; ++n)
          {
            const Eigen::Vector3d one = place(), other = place();
            const bool            meets = widened(shape, 0).meets(one, other, dimension);
            met += meets;
            INFO(dimension << " " << int(shape) << ": " << one.transpose() << " to " << other.transpose());
            // Sampled places are less than 0.0013 m apart, so that a region wider by 0.001 m shows all that meets this one.
            CHECK((!meets || held_somewhere(widened(shape, 0.001), one, other, dimension)));
            CHECK((meets || !held_somewhere(widened(shape, 0), one, other, dimension)));
          }
        CHECK(met > 50);
        CHECK(met < 400);
      }
}

TEST_CASE("A line along an edge of a box, or of no length, meets it where it touches it", "[apps][structure]")
{
  const apps::Region box = widened(Shape::box, 0);
  CHECK(box.meets({0.2, 0.3, 0}, {0.2, 0.3, 1}, 3));
  CHECK_FALSE(box.meets({0.2, 0.3 - 1e-9, 0}, {0.2, 0.3 - 1e-9, 1}, 3));
  CHECK(box.meets({0.5, 0.4, 0.5}, {0.5, 0.4, 0.5}, 3));
  CHECK_FALSE(box.meets({0.5, 0.4, 0.05}, {0.5, 0.4, 0.05}, 3));
  CHECK(box.meets({0.5, 0.4, 0.05}, {0.5, 0.4, 0.05}, 2)); // no z in the plane
}

TEST_CASE("No link crosses a void that is thinner than links are long", "[apps][structure]")
{
  dem::Packing rows;
  for (int row = 0; row < 2; ++row)
    for (int n = 0; n < 10; ++n)
      {
        rows.centre.emplace_back(0.002 * n, 0.002 * row, 0);
        rows.radius.push_back(0.001);
      }
  const auto across = [&](const apps::StructureModel &model) {
    int n = 0;
    for (const dem::ElasticLink &link : model.network(rows).links)
      n += rows.centre[link.first].y() != rows.centre[link.second].y();
    return n;
  };
  // Each disc has its neighbour above, and the two beside that at 2.83 mm.
  CHECK(across(two_rows(-0.5)) == 28);
  // The void ends past the middle between the fifth and the sixth disc, so that the lines from either to above the other meet it.
  CHECK(across(two_rows(0.0091)) == 13);
  CHECK(across(two_rows(1)) == 0);
  CHECK(two_rows(1).network(rows).links.size() == 18);
}

// One mix in meshes and in peridynamic grids, beside particles: what is aggregate there, and what bonds have which constants.
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/mesh.h"
#include "apps/runs/peridynamics/model.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/errors.h"
#include "dem/laws/cpm.h"
#include "fem/mesh/mesh.h"
#include "fem/mesh/regroup.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace
{
  namespace pd = dem::peridynamics;

  apps::MixSection round_ones(const double content, const double smallest, const double largest)
  {
    apps::MixSection mix;
    mix.content  = content;
    mix.grading  = apps::MixSection::Grading::passing;
    mix.curve    = {{smallest, 0}, {largest, 100}};
    mix.smallest = smallest;
    mix.sizes    = apps::MixSection::Sizes::drawn;
    return mix;
  }

  apps::MeshSection block(const std::int64_t divisions, const apps::MixSection &mix)
  {
    apps::MeshSection mesh;
    mesh.source        = apps::MeshSection::Source::box;
    mesh.box_size      = {0.04, 0.04, 0.04};
    mesh.box_divisions = {divisions, divisions, divisions};
    mesh.mix.mix       = mix;
    return mesh;
  }

  template <int dim>
  double part_of(const fem::Mesh<dim> &mesh, const std::string &group)
  {
    double part = 0, all = 0;
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      {
        all += cell->measure();
        part += cell->material_id() == mesh.materials.at(group) ? cell->measure() : 0;
      }
    return part / all;
  }
} // namespace

TEST_CASE("Mix: the part of a mesh that is aggregate tends to that of the mix", "[library][mesoscale]")
{
  apps::start_mpi();
  const apps::MixSection mix      = round_ones(0.25, 6e-3, 12e-3);
  const double           expected = mix.placed_in({0.04, 0.04, 0.04}, false).structure.content();
  for (const auto &[divisions, error] : {std::pair{8, 0.08}, std::pair{16, 0.02}, std::pair{32, 0.005}})
    {
      const auto mesh = apps::make_mesh<3>(block(divisions, mix), MPI_COMM_SELF);
      CHECK(mesh.materials.size() == 2);
      CHECK_THAT(part_of(mesh, "aggregate"), WithinRel(expected, error));
      CHECK_THAT(part_of(mesh, "aggregate") + part_of(mesh, "mortar"), WithinRel(1.0, 1e-12));
    }
}

TEST_CASE("Mix: an element is of the sphere that its middle lies in, and a particle there is aggregate as well",
          "[library][mesoscale]")
{
  apps::start_mpi();
  const apps::MixSection mix     = round_ones(0.25, 6e-3, 12e-3);
  const auto             spheres = mix.placed_in({0.04, 0.04, 0.04}, false).structure;
  const auto             mesh    = apps::make_mesh<3>(block(20, mix), MPI_COMM_SELF);
  dem::Packing           points; // in the middles of elements, as places without an extent
  std::vector<bool>      stone;
  for (const auto &cell : mesh.triangulation->active_cell_iterators())
    {
      const auto middle = cell->center();
      points.centre.emplace_back(middle[0], middle[1], middle[2]);
      points.radius.push_back(1e-12);
      stone.push_back(cell->material_id() == mesh.materials.at("aggregate"));
      const bool inside = std::any_of(spheres.inclusions.begin(), spheres.inclusions.end(), [&](const auto &sphere) {
        return (points.centre.back() - sphere.centre).norm() <= sphere.radius;
      });
      REQUIRE(stone.back() == inside);
    }
  apps::SpecimenSection specimen;
  specimen.source = apps::SpecimenSection::Source::file;
  specimen.box    = {0.04, 0.04, 0.04};
  dem::CpmParameters mortar;
  mortar.normal_modulus       = 20e9;
  mortar.limit_elastic_strain = 1e-4;
  mortar.relative_ductility   = 30;
  mortar.cohesion             = 3e6;
  apps::MaterialSection material;
  material.only.choose(mortar);
  const apps::MixedSpecimen mixed{specimen, mix, material, 3};
  mixed.check({});
  mixed.number(points, "points");
  for (std::size_t i = 0; i < points.size(); ++i)
    REQUIRE((points.material[i] > 0) == stone[i]);
}

TEST_CASE("Mix: a plane mesh is a section through concrete", "[library][mesoscale]")
{
  apps::start_mpi();
  double sum = 0;
  for (const std::int64_t seed : {1, 2, 3, 4, 5, 6})
    {
      apps::MixSection mix   = round_ones(0.3, 4e-3, 8e-3);
      mix.seed               = seed;
      apps::MeshSection mesh = block(64, mix);
      mesh.box_size          = {0.08, 0.08, 0};
      sum += part_of(apps::make_mesh<2>(mesh, MPI_COMM_SELF), "aggregate");
    }
  CHECK_THAT(sum / 6, WithinAbs(0.3, 0.015)); // Delesse (1847): area for volume
}

TEST_CASE("Mix: one group of a mesh is shared out, the others stay, and what cannot be is refused",
          "[library][mesoscale]")
{
  apps::start_mpi();
  apps::MeshSection mesh;
  mesh.source = apps::MeshSection::Source::bodies;
  for (const auto &[name, corner] : {std::pair{"concrete", 0.0}, std::pair{"steel", 0.05}})
    {
      apps::BoxSection &box = mesh.boxes.emplace_back();
      box.name = box.material = name;
      box.corner              = {corner, 0, 0};
      box.size                = {0.04, 0.04, 0.04};
      box.divisions           = {10, 10, 10};
    }
  mesh.mix.mix    = round_ones(0.25, 6e-3, 12e-3);
  mesh.mix.group  = "concrete";
  const auto made = apps::make_mesh<3>(mesh, MPI_COMM_SELF);
  CHECK(made.materials.size() == 3);
  CHECK_THAT(part_of(made, "steel"), WithinRel(0.5, 1e-12));
  CHECK_THAT(part_of(made, "aggregate"), WithinAbs(0.125, 0.01));

  mesh.mix.group = "timber";
  CHECK_THROWS_WITH(apps::make_mesh<3>(mesh, MPI_COMM_SELF),
                    Contains("Mesh/Mix") && Contains("timber") && Contains("steel"));
  mesh.mix.group      = "concrete";
  mesh.mix.mix.mortar = "steel";
  CHECK_THROWS_WITH(apps::make_mesh<3>(mesh, MPI_COMM_SELF),
                    Contains("Mesh/Mix") && Contains("steel") && Contains("already"));
  mesh.mix.mix                 = round_ones(0.001, 4e-4, 5e-4);
  mesh.boxes.front().divisions = {2, 2, 2};
  CHECK_THROWS_WITH(apps::make_mesh<3>(mesh, MPI_COMM_SELF), Contains("no element"));
}

namespace
{
  apps::PeridynamicsModel peridynamic_block(const apps::MixSection &mix, const double spacing)
  {
    apps::PeridynamicsModel model;
    model.size                            = {0.04, 0.04, 0.04};
    model.spacing                         = spacing;
    model.materials.only.young_modulus    = 20e9;
    model.materials.only.density          = 2400;
    model.materials.only.critical_stretch = 1e-4;
    model.materials.mix                   = mix;
    return model;
  }
} // namespace

TEST_CASE("Mix: peridynamic nodes are of the aggregate that they lie in, and bonds of mortar, aggregate or interface",
          "[library][mesoscale][peridynamics]")
{
  apps::MixSection mix      = round_ones(0.25, 6e-3, 12e-3);
  const double     expected = mix.placed_in({0.04, 0.04, 0.04}, false).structure.content();
  const auto       model    = peridynamic_block(mix, 1e-3);
  model.check({});
  CHECK(model.materials.names() == std::vector<std::string>{"mortar", "aggregate"});
  const pd::Bonds    bonds = model.bonds();
  const pd::Mixture &made  = bonds.mixture();
  const auto         nodes = static_cast<double>(bonds.grid().nodes().size());
  const auto         stone = std::count_if(bonds.grid().nodes().begin(), bonds.grid().nodes().end(),
                                           [&](const std::size_t place) { return made.of[place] > 0; });
  CHECK_THAT(static_cast<double>(stone) / nodes, WithinRel(expected, 0.01));

  REQUIRE(made.materials.size() > 2); // aggregates within the horizon of each other
  pd::Mixture pairs = made;
  for (std::size_t one = 0; one < made.materials.size(); ++one)
    for (std::size_t other = 0; other <= one; ++other)
      {
        const pd::PairConstants &pair  = pairs.between(one, other);
        const bool               alike = one == other;
        CHECK_THAT(pair.young_modulus, WithinRel(alike && one == 0 ? 20e9 : alike ? 50e9 : 10e9, 1e-12));
        // Strength over stiffness: 5/2.5 within an aggregate, 0.5/0.5 across an interface.
        CHECK_THAT(pair.critical_stretch, WithinRel(alike && one > 0 ? 2e-4 : 1e-4, 1e-12));
      }
  // Two nodes within the horizon and of one number lie in one aggregate.
  const auto                   structure = mix.placed_in({0.04, 0.04, 0.04}, false).structure;
  std::vector<Eigen::Vector3d> places;
  for (const std::size_t place : bonds.grid().nodes())
    places.emplace_back(bonds.grid().position(place) + Eigen::Vector3d::Constant(0.02));
  const auto in = dem::aggregates_at(structure, places);
  for (std::size_t i = 0; i < in.size(); i += 7)
    for (std::size_t j = i + 1; j < std::min(in.size(), i + 200); ++j)
      if ((places[i] - places[j]).norm() <= bonds.horizon())
        CHECK((made.of[bonds.grid().nodes()[i]] == made.of[bonds.grid().nodes()[j]]) == (in[i] == in[j]));
}

TEST_CASE(
  "Mix: with Materials peridynamic nodes are of those of its names; a rod, and a grid that is too coarse, have none",
  "[library][mesoscale][peridynamics]")
{
  apps::PeridynamicsModel model = peridynamic_block(round_ones(0.25, 6e-3, 12e-3), 2e-3);
  model.materials.only          = {};
  model.materials.named         = {{"mortar", 20e9, 2400, 0, 0}, {"gravel", 60e9, 2700, 0, 0}};
  CHECK_THROWS_WITH(model.check({}), Contains("Body/Mix/Aggregate") && Contains("Materials"));
  model.materials.mix.aggregate = "gravel";
  model.check({});
  const pd::Mixture made = model.bonds().mixture();
  CHECK(std::count_if(made.of.begin(), made.of.end(), [](const std::int32_t number) { return number > 0; }) > 1000);

  // Constants that the factors give, said outright, with those of the interface: every bond has the same, between aggregates as well.
  const auto by_factors         = peridynamic_block(round_ones(0.25, 6e-3, 12e-3), 1e-3);
  model.spacing                 = 1e-3;
  model.materials.mix.aggregate = "aggregate";
  model.materials.named         = {{"mortar", 20e9, 2400, 1e-4, 0}, {"aggregate", 50e9, 2400, 2e-4, 0}};
  model.materials.interfaces    = {{"zone", "mortar", "aggregate", true, 10e9, 1e-4, 0}};
  const pd::Mixture own = model.bonds().mixture(), factors = by_factors.bonds().mixture();
  REQUIRE(factors.materials.size() > 2);
  CHECK(own.of == factors.of);
  REQUIRE(own.pairs.size() == factors.pairs.size());
  for (std::size_t pair = 0; pair < own.pairs.size(); ++pair)
    {
      CHECK_THAT(own.pairs[pair].young_modulus, WithinRel(factors.pairs[pair].young_modulus, 1e-12));
      CHECK_THAT(own.pairs[pair].critical_stretch, WithinRel(factors.pairs[pair].critical_stretch, 1e-12));
    }

  model.materials.named.clear();
  model.materials.interfaces.clear();
  model.size = {0.04};
  CHECK_THROWS_WITH(model.check({}), Contains("Mix") && Contains("rod"));
  const auto coarse = peridynamic_block(round_ones(0.001, 4e-4, 5e-4), 4e-3);
  CHECK_THROWS_WITH(coarse.bonds(), Contains("Body/Mix") && Contains("no node"));
}

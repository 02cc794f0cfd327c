// What the probes of a solid read, against closed forms, at displacements made by hand.
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/solid.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "tests/apps/scene_runs.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <deal.II/dofs/dof_tools.h>

using namespace apps_tests;

namespace
{
  constexpr double E = 2e9, strain = 1e-4;

  /** A box of 2 m x 1 m x 0.1 m, nu = 0, pulled at its right end and held at its left. */
  std::string bar(const std::string &more = "")
  {
    return "set Kind = continuum\nsubsection Model\n  set Dimension = 2\n  set Thickness = 0.1\nend\n"
           "subsection Mesh\n  set Source = box\n  subsection Box\n    set Size = 2, 1, 0\n    set Divisions x = 4\n"
           "    set Divisions y = 2\n  end\nend\n"
           "subsection Materials\n  subsection solid\n    set Law = isotropic elastic\n    subsection isotropic "
           "elastic\n"
           "      set Young modulus = 2e9\n      set Poisson ratio = 0\n    end\n  end\nend\n"
           "subsection Boundary conditions\n  subsection left\n    set Displacement x = 0\n    set Displacement y = 0\n"
           "  end\n  subsection right\n    set Traction x = 2e5*t\n  end\nend\n"
           "subsection Points\n  subsection three quarters\n    set Position = 1.5, 0.5, 0\n  end\nend\n" +
           more;
  }

  struct Probed
  {
    explicit Probed(const std::string &scene_text)
      : scene((apps::start_mpi(), apps::read_scene(folder.file("bar.prm", scene_text), {})))
      , model(dynamic_cast<const apps::SceneOf<apps::ContinuumModel> &>(*scene.scene).model())
      , solid(apps::make_solid<2>(model))
      , probes(*solid, model)
    {
    }

    /** By column, of u = strain x along x under the loads of a time. */
    std::map<std::string, double> read(const double time, const double work)
    {
      energy.internal = work;
      std::map<dealii::types::global_dof_index, dealii::Point<2>> place;
      dealii::DoFTools::map_dofs_to_support_points(solid->mapping(), solid->dofs(), place);
      fem::Vector u = solid->make_vector(), internal = u, external = u;
      for (const auto &node : place)
        u[node.first] = 0;
      std::vector<dealii::types::global_dof_index> indices(solid->dofs().get_fe().n_dofs_per_cell());
      for (const auto &cell : solid->dofs().active_cell_iterators())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (solid->dofs().get_fe().system_to_component_index(i).first == 0)
              u[indices[i]] = strain * place[indices[i]][0];
        }
      u.update_ghost_values();
      solid->internal_force(u, internal);
      solid->external_force(time, external);
      const std::vector<double>     row = probes.read({&u, &internal, &external}, energy);
      std::map<std::string, double> values;
      const auto                    columns = probes.columns();
      REQUIRE(row.size() == columns.size());
      for (std::size_t i = 0; i < row.size(); ++i)
        values[columns[i].column.name] = row[i];
      return values;
    }

    const ScratchFolder            folder;
    const apps::CheckedScene       scene;
    const apps::ContinuumModel    &model;
    std::unique_ptr<fem::Solid<2>> solid;
    apps::ContinuumProbes<2>       probes;
    apps::ContinuumEnergy          energy;
  };
} // namespace

TEST_CASE("Probes of a solid read loads, reactions, displacements and energies as closed forms say", "[apps]")
{
  Probed     bar_gauges(bar());
  const auto read = bar_gauges.read(0.5, 7.0);
  CHECK(read.at("load_x") == Approx(1e5 * 0.1));
  CHECK(read.at("reaction_left_x") == Approx(-E * strain * 0.1));
  CHECK(std::abs(read.at("reaction_left_y")) < 1e-9);
  CHECK(read.at("displacement_three_quarters_x") == Approx(1.5 * strain));
  CHECK(read.at("displacement_three_quarters_y") == 0);
  CHECK(read.at("energy_stored") == 7.0); // linear: the work itself
  CHECK(read.at("energy_dissipated") == 0);
  CHECK(read.count("largest_damage") == 0); // an elastic solid has none
  CHECK(bar_gauges.probes.first_reaction() == "reaction_left_x");
  CHECK(read.count("load_y") == 0); // nothing acts along it
  CHECK(read.count("reaction_right_x") == 0);
}

TEST_CASE("Where two boundaries hold the same nodes, a total counts these once and balances the load", "[apps]")
{
  const ScratchFolder folder;
  folder.file("x.prm",
              bar("subsection Boundary conditions\n  subsection bottom\n    set Displacement x = 0\n  end\nend\n"));
  const auto   series = results_of(folder, "x.prm").series;
  const double load = series.column("load_x").back(), total = series.column("total_reaction_x").back();
  REQUIRE(load > 0);
  CHECK(total == Approx(-load).epsilon(1e-9));
  // The corner belongs to both.
  const double both = series.column("reaction_left_x").back() + series.column("reaction_bottom_x").back();
  CHECK(std::abs(both - total) > 1e-3 * load);
  for (const std::string &name : series.names)
    CHECK(name != "total_reaction_y"); // along y one boundary holds
}

TEST_CASE("Gauges count as dissipated what materials say, or else what a solid that need not be elastic does not store",
          "[apps]")
{
  const std::string text  = bar();
  std::string       large = text;
  large.replace(large.find("set Thickness"), 0, "set Large displacement = true\n  ");
  Probed       probed(large);
  const double green  = strain + 0.5 * strain * strain; // St. Venant-Kirchhoff
  const double stored = 0.5 * E * green * green * 2 * 1 * 0.1;
  const auto   read   = probed.read(0.5, 1.25 * stored);
  CHECK(read.at("energy_stored") == Approx(stored).epsilon(1e-12));
  CHECK(read.at("energy_dissipated") == Approx(0.25 * stored).epsilon(1e-9));
  CHECK(probed.energy.stored == read.at("energy_stored"));
  probed.energy.external = 1.25 * stored;
  CHECK(probed.energy.balance_error() < 1e-12);

  probed.energy.materials_keep_account = true;
  probed.energy.dissipated             = 2 * stored;
  CHECK(probed.read(0.5, 1.25 * stored).at("energy_dissipated") == 2 * stored);
  CHECK(probed.energy.residual() == Approx(-1.75 * stored).epsilon(1e-9));
  CHECK(probed.energy.balance_error() == Approx(1.75 / 2).epsilon(1e-9));
}

TEST_CASE("A point of the probes outside the solid is refused at its place", "[apps]")
{
  std::string text = bar();
  text.replace(text.find("1.5, 0.5"), 8, "2.5, 0.5");
  CHECK_THROWS_WITH(Probed(text), Catch::Contains("bar.prm") && Catch::Contains("Points/three quarters: "));
}

TEST_CASE("The equilibrium that a static solid begins with says how far it is, by iteration", "[apps]")
{
  const Probed             pulled(bar());
  const auto               analysis = apps::make_static_analysis(*pulled.solid, pulled.model);
  std::vector<std::string> told;
  analysis->tell_iterations_to([&](const std::string &so_far) { told.push_back(so_far); });
  CHECK(analysis->static_solver()->relax_to(1).converged);
  REQUIRE(!told.empty());
  for (const std::string &line : told)
    CHECK_THAT(line, Catch::StartsWith("iteration ") && Catch::Contains(": unbalanced force ") &&
                       Catch::EndsWith(" times the tolerance"));
  analysis->tell_iterations_to({});
  const std::size_t before = told.size();
  CHECK(analysis->static_solver()->relax_to(2).converged);
  CHECK(told.size() == before);
}

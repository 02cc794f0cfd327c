// A material that fem does not know, written here: meshes, plane stress, checkpoint, ParaView files, gauges, point-test, scenes and
// transfer take it as it is.
#include "apps/process/mpi_session.h"
#include "apps/results/run_result.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/solid.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "coupling/sequential/transfer.h"
#include "fem/materials/refuse.h"
#include "fem/points/material_kind_of.h"
#include "fem/points/material_path.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/scratch_folder.h"
#include "tests/coupling/field_fixture.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/grid_generator.h>
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>

using apps_tests::content_of;
using apps_tests::ScratchFolder;
using base::Voigt;

namespace
{
  struct ChalkParameters
  {
    double young_modulus = fem::required;
    double poisson_ratio = 0;
    double threshold     = fem::required; ///< k_0 [-]
    double ductility     = 1e-3;          ///< k_f [-]
  };

  /// sigma = (1 - w) D (eps - eps_0), 1 - w = (k_0/k) exp((k_0 - k)/k_f), k the largest sqrt((eps - eps_0) . D (eps - eps_0) / E) so far.
  class Chalk
  {
  public:
    using Parameters                     = ChalkParameters;
    static constexpr const char *name    = "chalk";
    static constexpr const char *meaning = "Isotropic damage by the elastic energy";

    struct State
    {
      Voigt  misfit     = Voigt::Zero(); ///< eps_0
      double equivalent = 0, damage = 0;
      Voigt  strain = Voigt::Zero(), stress = Voigt::Zero();
    };

    template <typename Number>
    static void describe(Parameters &p, Number &&number)
    {
      number("Young modulus", p.young_modulus, "Pa", "E", 1e3, 1e300, true);
      number("Poisson ratio", p.poisson_ratio, "-", "nu", 0.0, 0.49, false);
      number("Threshold", p.threshold, "-", "k_0", 1e-12, 1.0, true);
      number("Ductility", p.ductility, "-", "k_f", 1e-12, 1.0, false);
    }

    template <typename Column>
    static void describe_state(State &s, Column &&column)
    {
      using fem::PointQuantity;
      using Kind  = PointQuantity::Kind;
      using Role  = PointQuantity::Role;
      using Shown = PointQuantity::Shown;
      column(PointQuantity{"misfit", "-", "strain without stress", Kind::strain}, s.misfit.data());
      column(PointQuantity{"equivalent_strain", "-", "largest so far", Kind::number, Role::other, Shown::series},
             &s.equivalent);
      column(PointQuantity{"whiteness", "-", "lost stiffness", Kind::number, Role::damage}, &s.damage);
      column(PointQuantity{"strain", "-", "", Kind::strain, Role::other, Shown::nowhere}, s.strain.data());
      column(PointQuantity{"stress", "Pa", "", Kind::stress, Role::other, Shown::nowhere}, s.stress.data());
    }

    explicit Chalk(const Parameters &parameters)
      : p(parameters)
      , stiffness(base::isotropic_stiffness(p.young_modulus / (3 * (1 - 2 * p.poisson_ratio)),
                                            p.young_modulus / (2 * (1 + p.poisson_ratio))))
    {
      fem::demand(p.ductility >= p.threshold, "Ductility", p.ductility, "must not be below Threshold.");
    }

    fem::Response<State>
    evaluate(const Voigt &strain, const State &committed, const fem::ElementExtent &, const bool = true) const
    {
      const Voigt          elastic = strain - committed.misfit, whole = stiffness * elastic;
      const double         equivalent = std::sqrt(elastic.dot(whole) / p.young_modulus);
      fem::Response<State> r;
      r.trial            = committed;
      r.trial.strain     = strain;
      r.trial.equivalent = std::fmax(committed.equivalent, equivalent);
      const double left  = integrity(r.trial.equivalent);
      r.trial.damage     = 1 - left;
      r.stress = r.trial.stress = left * whole;
      r.tangent                 = left * stiffness;
      if (equivalent > committed.equivalent && equivalent > p.threshold)
        r.tangent -=
          left * (1 / equivalent + 1 / p.ductility) / (p.young_modulus * equivalent) * whole * whole.transpose();
      return r;
    }

    const base::Stiffness &elastic_stiffness() const { return stiffness; }

    double stored_energy(const Voigt &strain, const Voigt &stress, const State &s) const
    {
      return 0.5 * stress.dot(strain - s.misfit);
    }

    fem::Dissipation dissipation(const State &from, const State &to) const
    {
      const auto undamaged = [this](const State &s) {
        return 0.5 * (s.strain - s.misfit).dot(stiffness * (s.strain - s.misfit));
      };
      return {0, 0.5 * (undamaged(from) + undamaged(to)) * (to.damage - from.damage)};
    }

    double          strain_scale() const { return p.threshold; }
    fem::Increments increments() const { return fem::Increments::followed; }
    static double   damage_of(const State &s) { return s.damage; }
    static bool     was_elastic(const State &from, const State &to) { return to.damage == from.damage; }
    static bool     leapt(const State &, const State &) { return false; }

    fem::UniaxialStrengths uniaxial_strengths() const
    {
      return {p.young_modulus * p.threshold, p.young_modulus * p.threshold};
    }

    State initial_state(const fem::InitialPointState &given, const fem::ElementExtent &) const
    {
      State  s;
      double low = p.threshold, high = 100 * p.ductility;
      for (int halving = 0; halving < 60; ++halving)
        (1 - integrity(0.5 * (low + high)) < given.damage ? low : high) = 0.5 * (low + high);
      s.stress     = given.stress;
      s.equivalent = low;
      s.damage     = 1 - integrity(low);
      s.misfit     = -stiffness.inverse() * given.stress / (1 - s.damage);
      return s;
    }

    double integrity(const double k) const
    {
      return k <= p.threshold ? 1 : p.threshold / k * std::exp((p.threshold - k) / p.ductility);
    }

  private:
    Parameters      p;
    base::Stiffness stiffness;
  };

  constexpr double E = 1e9, k_0 = 1e-4, k_f = 1e-3;

  ChalkParameters parameters(const double poisson = 0)
  {
    ChalkParameters p;
    p.young_modulus = E;
    p.poisson_ratio = poisson;
    p.threshold     = k_0;
    p.ductility     = k_f;
    return p;
  }

  void register_once()
  {
    static const bool done = [] {
      fem::add_material(std::make_shared<fem::MaterialKindOf<Chalk>>());
      return true;
    }();
    CHECK(done);
  }

  /// Stress of a bar at a strain past k_0, nu = 0.
  double softened(const double strain) { return E * k_0 * std::exp((k_0 - strain) / k_f); }

  constexpr double furthest = 4e-4, length = 0.1, height = 0.02, thickness = 0.05;

  std::string bar_scene(const std::string &plane)
  {
    return "set Kind = continuum\n"
           "subsection Model\n  set Dimension = 2\n  set Plane = " +
           plane +
           "\n  set Thickness = 0.05\nend\n"
           "subsection Mesh\n  set Source = box\n  subsection Box\n    set Size = 0.1, 0.02, 0\n"
           "    set Divisions x = 5\n    set Divisions y = 2\n  end\nend\n"
           "subsection Materials\n  subsection solid\n    set Law = chalk\n    subsection chalk\n"
           "      set Young modulus = 1e9\n      set Threshold = 1e-4\n    end\n  end\nend\n"
           "subsection Boundary conditions\n  subsection left\n    set Displacement x = 0\n  end\n"
           "  subsection right\n    set Displacement x = 4e-5*t\n  end\n"
           "  subsection bottom\n    set Displacement y = 0\n  end\nend\n"
           "subsection Control\n  set End = 1\n  set First step = 0.02\nend\n"
           "subsection Output\n  set Snapshots = 1\nend\n";
  }
} // namespace

TEST_CASE("a material of one's own answers point-test, with its columns and refusals", "[materials]")
{
  register_once();
  const auto &kinds = fem::material_kinds();
  REQUIRE(kinds.back()->name() == "chalk");
  CHECK(kinds.back()->has_history());
  const fem::MaterialConstantsOf<Chalk> constants(parameters(0.2));
  fem::MaterialPath                     path;
  path.stress_given                  = {false, true, true, true, true, true};
  path.rows                          = {{0.5e-4}, {2e-4}, {1e-4}, {4e-4}};
  const fem::MaterialHistory history = fem::drive(constants, path);
  const auto                 value   = [&](const std::string &name, const std::size_t row) {
    INFO(name);
    std::size_t c = 0;
    while (c < history.names.size() && history.names[c] + " [" + history.units[c] + "]" != name)
      ++c;
    REQUIRE(c < history.names.size());
    return history.rows[row][c];
  };
  CHECK(value("stress_xx [Pa]", 0) == Approx(E * 0.5e-4));
  CHECK(value("stress_xx [Pa]", 1) == Approx(softened(2e-4)).epsilon(1e-9));
  CHECK(value("stress_xx [Pa]", 2) == Approx(softened(2e-4) / 2).epsilon(1e-9)); // unloads to the origin
  CHECK(value("stress_xx [Pa]", 3) == Approx(softened(4e-4)).epsilon(1e-9));
  CHECK(value("strain_yy [-]", 3) == Approx(-0.2 * 4e-4).epsilon(1e-9));
  CHECK(value("equivalent_strain [-]", 2) == Approx(2e-4).epsilon(1e-9));
  CHECK(value("whiteness [-]", 3) == Approx(1 - softened(4e-4) / (E * 4e-4)).epsilon(1e-9));
  CHECK(value("misfit_xy [-]", 3) == 0);
  CHECK(std::count_if(history.names.begin(), history.names.end(),
                      [](const std::string &n) { return n.rfind("strain_", 0) == 0; }) == 6);

  ChalkParameters brittle = parameters();
  brittle.ductility       = 0.5e-4;
  CHECK_THROWS_WITH(fem::drive(fem::MaterialConstantsOf<Chalk>(brittle), path),
                    Catch::Contains("material: Ductility = 5e-05: must not be below Threshold."));
}

TEST_CASE("a scene of a material of one's own is read and run, with gauges, ParaView files and a picture of its damage",
          "[materials]")
{
  register_once();
  apps::start_mpi();
  const std::string        plane = GENERATE("strain", "stress"); // the same with nu = 0
  const ScratchFolder      folder;
  const apps::CheckedScene scene   = apps::read_scene(folder.file("bar.prm", bar_scene(plane)), {});
  apps::RunRequest         request = apps::request_of(scene);
  request.output_folder            = folder / "out";
  REQUIRE(scene.scene->run(request).exit_status() == 0);

  const auto   series = postprocess::read_csv_table(folder / "out/series.csv", true);
  const double volume = length * height * thickness, section = height * thickness;
  CHECK(series.column("largest_damage").back() == Approx(1 - softened(furthest) / (E * furthest)).epsilon(1e-6));
  CHECK(series.column("largest_equivalent_strain").back() == Approx(furthest).epsilon(1e-6));
  CHECK(series.column("largest_crack_opening").back() == 0);
  CHECK(series.column("reaction_right_x").back() == Approx(softened(furthest) * section).epsilon(1e-6));
  const double stored = 0.5 * softened(furthest) * furthest;
  const double work   = 0.5 * E * k_0 * k_0 + E * k_0 * k_f - k_f * softened(furthest);
  CHECK(series.column("energy_stored").back() == Approx(stored * volume).epsilon(1e-6));
  CHECK(series.column("energy_dissipated").back() == Approx((work - stored) * volume).epsilon(2e-3)); // by steps

  const auto figures = nlohmann::json::parse(content_of(folder / "out/summary.json"))["figures"];
  CHECK(figures["largest_equivalent_strain"]["value"] == series.column("largest_equivalent_strain").back());
  CHECK(figures["dissipated_energy"]["unit"] == "J");
  CHECK(series.column("energy_damage").back() == series.column("energy_dissipated").back());
  CHECK(series.column("energy_plasticity").back() == 0);
  CHECK(figures.contains("peak_reaction_right_x"));
  CHECK(std::filesystem::exists(folder / "out/damage.png"));

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "out/solid/solid_000001.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid &grid = *reader->GetOutput();
  REQUIRE(grid.GetCellData()->GetArray("whiteness") != nullptr);
  CHECK(grid.GetCellData()->GetArray("whiteness")->GetTuple1(0) ==
        Approx(series.column("largest_damage").back()).epsilon(1e-5));
  REQUIRE(grid.GetCellData()->GetArray("equivalent_strain") != nullptr);
  REQUIRE(grid.GetPointData()->GetArray("misfit") != nullptr);
  CHECK(grid.GetPointData()->GetArray("misfit")->GetNumberOfComponents() == 6);
  CHECK(grid.GetPointData()->GetArray("stress") != nullptr);
}

TEST_CASE("a scene whose steps are too long for their work says so, and not one of short steps", "[materials]")
{
  register_once();
  apps::start_mpi();
  const ScratchFolder folder;
  double              dissipated[2], error[2];
  for (const bool is_long : {false, true})
    {
      const apps::CheckedScene scene =
        apps::read_scene(folder.file("bar.prm", bar_scene("stress")),
                         {is_long ? "Control/First step=1" : "Control/First step=0.02", "Output/Snapshots=0"});
      apps::RunRequest request = apps::request_of(scene);
      request.output_folder    = folder / (is_long ? "long" : "short");

      REQUIRE(scene.scene->run(request).exit_status() == 0);
      const auto summary  = nlohmann::json::parse(content_of(request.output_folder / "summary.json"));
      dissipated[is_long] = summary["energy"]["dissipated"];
      error[is_long]      = summary["energy"]["balance_error"];
      if (is_long)
        {
          REQUIRE(summary["warnings"].size() == 1);
          CHECK_THAT(summary["warnings"][0].get<std::string>(),
                     Catch::Contains("the energies do not balance by 100 % of the largest: the steps are too long"));
        }
      else
        CHECK(summary["warnings"].empty());
    }
  CHECK(dissipated[1] == Approx(dissipated[0]).epsilon(0.01));
  // All that the trapeze of one step counts is what the bar can give back.
  CHECK(error[1] == Approx(1).epsilon(0.02));
  CHECK(error[0] < 1e-3);
}

TEST_CASE("a scene that gives a material of one's own wrong constants is refused at its place", "[materials]")
{
  register_once();
  const ScratchFolder folder;
  std::string         text = bar_scene("strain");
  text.replace(text.find("set Threshold = 1e-4"), 20, "set Threshold = 2   ");
  CHECK_THROWS_WITH(apps::read_scene(folder.file("a.prm", text), {}),
                    Catch::Contains("Materials/solid/chalk/Threshold = 2: expected a number in [1e-12, 1]"));
  text = bar_scene("strain");
  text.replace(text.find("set Threshold = 1e-4"), 20, "set Threshold = 0.5 ");
  CHECK_THROWS_WITH(apps::read_scene(folder.file("b.prm", text), {}),
                    Catch::Contains("Materials/solid: Ductility = 0.001: must not be below Threshold."));
  CHECK_THROWS_WITH(apps::read_scene(folder.file("c.prm", bar_scene("strain")), {"Model/Large displacement=true"}),
                    Catch::Contains("is a small-strain law."));
}

TEST_CASE("an analysis of a material of one's own goes on from a checkpoint to the same bits", "[materials]")
{
  register_once();
  apps::start_mpi();
  const ScratchFolder         folder;
  const apps::CheckedScene    scene = apps::read_scene(folder.file("bar.prm", bar_scene("stress")), {});
  const apps::ContinuumModel &model = dynamic_cast<const apps::SceneOf<apps::ContinuumModel> &>(*scene.scene).model();
  const auto                  straight_solid = apps::make_solid<2>(model), resumed_solid = apps::make_solid<2>(model);
  const auto                  straight = apps::make_static_analysis(*straight_solid, model),
             resumed                   = apps::make_static_analysis(*resumed_solid, model);
  for (int step = 0; step < 25; ++step)
    straight->advance();
  MemoryState         memory;
  MemoryState::Writer writer(memory);
  straight->visit_state(writer);
  CHECK(memory.columns.at("histories").size() == 10u * 4u * 20u); // elements, points, numbers of a history
  MemoryState::Reader reader(memory);
  resumed->visit_state(reader);
  for (int step = 0; step < 10; ++step)
    {
      straight->advance();
      resumed->advance();
    }
  const fem::Vector &a = *straight->state().internal_force, &b = *resumed->state().internal_force;
  for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
    CHECK(a.local_element(i) == b.local_element(i));
  CHECK(straight->energy().internal == resumed->energy().internal);
  CHECK(straight->energy().dissipated > 0);
  CHECK(straight->energy().dissipated == resumed->energy().dissipated);
}

TEST_CASE("a material of one's own takes stress and damage of particles", "[materials]")
{
  register_once();
  apps::start_mpi();
  fem::Solid<3> solid(fem::make_mesh<3>(
                        [](dealii::Triangulation<3> &mesh) {
                          dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {2, 2, 2}, dealii::Point<3>(),
                                                                            dealii::Point<3>(0.1, 0.1, 0.1), true);
                          for (const auto &cell : mesh.active_cell_iterators())
                            cell->set_material_id(0);
                        },
                        fem::ElementFamily::hypercube, MPI_COMM_SELF),
                      {});
  solid.assign("0", fem::make_points(Chalk(parameters()), fem::Plane::strain));
  fem::Loads<3> loads;
  loads.remove_rigid_motion = true;
  solid.set_loads(loads);
  const Eigen::Matrix3d stress = fields::symmetric(2e4, -1e4, 0, 0.5e4, 0, 0),
                        damage = fields::symmetric(0.6, 0.6, 0.6, 0, 0, 0);
  coupling::TransferOptions options;
  options.averaging.kernel = coupling::Kernel::specimen;
  options.law.weights      = {{1, 0, 0}};
  options.law.factor       = 1;
  options.law.exponent     = 1;
  options.strength         = E * k_0;
  const auto field  = fields::box({0.1, 0.1, 0.1}, {4, 4, 4}, 0, fields::constant(stress), fields::constant(damage));
  const auto report = coupling::transfer(field, options, solid);
  CHECK(report.count.points == 64);
  CHECK(report.count.elastic == 0);
  CHECK(report.count.returned == 0); // the stress given is answered to zero strain
  solid.visit_histories([&](const fem::PointQuantity &of, const double *value) {
    if (of.role == fem::PointQuantity::Role::damage)
      CHECK(*value == Approx(0.6).epsilon(1e-9));
  });
}

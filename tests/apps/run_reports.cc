// What reports of runs are made of: figures of a series, balance, materials, laboratory notes.
#include "apps/figures/contact_figures.h"
#include "apps/figures/energy_terms.h"
#include "apps/figures/lab_report.h"
#include "apps/figures/series_figures.h"
#include "apps/figures/summary_head.h"
#include "apps/specimens/material_counts.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Contains;

namespace
{
  postprocess::CsvTable table(const std::vector<std::string> &names, const std::vector<std::vector<double>> &columns)
  {
    postprocess::CsvTable made;
    made.names   = names;
    made.columns = columns;
    return made;
  }

  apps::LabNotes notes(const char *name, const double strength, const bool peak_passed)
  {
    apps::LabNotes made;
    made.name                  = name;
    made.figures.strength      = strength;
    made.figures.peak_passed   = peak_passed;
    made.figures.young_modulus = 3e10;
    made.section               = 1e-4;
    made.gauge_length          = 0.01;
    return made;
  }
} // namespace

TEST_CASE("A figure of a column is its end, its least and its largest, each with when", "[apps]")
{
  const auto series = table({"time", "force"}, {{0, 1, 2, 3}, {0, 5, -7, 2}});
  const auto figure = apps::figure_of(series, "force", "N");
  CHECK(figure["end"] == nlohmann::json({{"value", 2.0}, {"unit", "N"}, {"at_time", 3.0}}));
  CHECK(figure["least"]["value"] == -7.0);
  CHECK(figure["least"]["at_time"] == 2.0);
  CHECK(figure["largest"]["at_time"] == 1.0);
  CHECK(apps::figure_of(series, "force", "")["end"]["unit"] == "-");
}

TEST_CASE("The balance is the largest residual over the largest energy of all rows, parts' own residuals left out",
          "[apps]")
{
  // All comes to rest: at the end there is next to nothing to divide by.
  const auto series = table({"time", "energy_kinetic", "energy_solid_residual", "energy_residual"},
                            {{0, 1, 2}, {50, 10, 1e-9}, {1000, 0, 0}, {0, -0.5, 1e-9}});
  CHECK(apps::worst_residual(series) == Approx(0.01).epsilon(1e-14));
  CHECK(apps::worst_residual(table({"time", "energy_kinetic", "energy_residual"}, {{0}, {0}, {0}})) == 0);
}

TEST_CASE("Energies have the same names, order and number as columns, as values of a row and in a summary", "[apps]")
{
  dem::EnergyAccount energy;
  energy.external_work                           = 3;
  energy.elastic                                 = 2;
  std::vector<postprocess::SeriesColumn> columns = {{"time", "s"}};
  std::vector<double>                    row     = {0.5};
  apps::append_energy_columns(columns);
  apps::append_energies(row, energy);
  REQUIRE(columns.size() == row.size());
  const nlohmann::json terms = apps::json_of(energy, 0.25);
  CHECK(terms["balance_error"] == 0.25);
  CHECK(terms["unit"] == "J");
  for (std::size_t k = 1; k < columns.size(); ++k)
    {
      CHECK(columns[k].unit == "J");
      CHECK(terms[columns[k].name.substr(std::string("energy_").size())] == row[k]);
    }
  CHECK(columns.back().name == "energy_residual");
  CHECK(row.back() == 1);
}

TEST_CASE("Several materials are counted with their pairs; one is not", "[apps]")
{
  const apps::MaterialCounts counts({"mortar", "stone"}, {0, 0, 1}, {0, 1, 1, 2, 1});
  CHECK_THAT(counts.text(),
             Contains("mortar 2, stone 1") && Contains("mortar-mortar 1, mortar-stone 3, stone-stone 1"));
  nlohmann::json summary;
  counts.put_into(summary);
  CHECK(summary["materials"][1] == nlohmann::json({{"name", "stone"}, {"particles", 1}}));
  REQUIRE(summary["material_pairs"].size() == 3);
  CHECK(summary["material_pairs"][1]["links"] == 3);

  const apps::MaterialCounts one({"mortar"}, {0, 0}, {0});
  nlohmann::json             untouched;
  one.put_into(untouched);
  CHECK(one.text().empty());
  CHECK(untouched.is_null());
}

TEST_CASE("A strength is reported once its peak is passed, a ratio of strengths once both are", "[apps]")
{
  const auto both = apps::figures_of({notes("tension", 3e6, true), notes("compression", 30e6, true)});
  CHECK(both["strength_ratio"]["value"] == 10.0);
  CHECK(both["section"] == nlohmann::json({{"value", 1e-4}, {"unit", "m^2"}}));
  const auto one = apps::figures_of({notes("tension", 3e6, true), notes("compression", 30e6, false)});
  CHECK(one["tensile_strength"]["value"] == 3e6);
  CHECK(one["compressive_strength"]["value"].is_null());
  CHECK(one["strength_ratio"]["value"].is_null());
  CHECK_FALSE(one["strength_ratio"]["not_determined"].get<std::string>().empty());
  CHECK_FALSE(apps::figures_of({notes("tension", 3e6, true)}).contains("strength_ratio"));
}

TEST_CASE("A crack at a grip is a warning, and a cell has no grips", "[apps]")
{
  apps::LabNotes test      = notes("tension", 3e6, true);
  test.crack.area          = 1e-4;
  test.crack.area_at_grips = 0;
  CHECK(apps::warnings_of({test}).empty());
  test.crack.area_at_grips = 0.5e-4;
  REQUIRE(apps::warnings_of({test}).size() == 1);
  CHECK_THAT(apps::warning_lines(apps::warnings_of({test})),
             Catch::StartsWith("warning      tension: a crack touches a grip (50 % "));
  test.section = 0;
  CHECK(apps::warnings_of({test}).empty());
}

TEST_CASE("Curves of compression are drawn upwards as well", "[apps]")
{
  const base::Column strain = {0, -1e-3}, stress = {0, -30e6};
  const auto         panel = apps::panel_of(apps::UniaxialLoad::compression, strain, stress);
  REQUIRE(panel.series.size() == 1);
  CHECK(panel.series[0].x.back() > 0);
  CHECK(panel.series[0].y.back() > 0);
  CHECK(panel.title == "compression");
}

TEST_CASE("Every summary begins with its scene, its kind and the changes as they were typed", "[apps]")
{
  apps::RunRequest request;
  request.scene_file        = "x.prm";
  request.overrides         = {"Time/End time=1"};
  const nlohmann::json head = apps::summary_head(request, "particles");
  CHECK(head["scene"] == "x.prm");
  CHECK(head["requested"] == nlohmann::json({{"kind", "particles"}, {"overrides", {"Time/End time=1"}}}));
  CHECK_FALSE(head["version"].get<std::string>().empty());
}

TEST_CASE("The contact that a run reports is named as that of bodies, or of particles with the solid", "[apps]")
{
  apps::ContactFigures contact;
  contact.note(1e-3, 5);
  contact.note(3e-3, 4);
  CHECK(contact.text("particles with the solid") ==
        "contact      of particles with the solid: first at 0.001 s, last at 0.003 s, at most 5 N\n");
}

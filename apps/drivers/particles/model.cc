#include "apps/drivers/particles/model.h"

#include "apps/figures/drawn_curve.h"
#include "apps/figures/energy_terms.h"
#include "apps/scene/physics_section.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    void declare_output(Section &root, OutputSection &output, std::string &horizontal, std::string &vertical)
    {
      output.declare(root);
      Section &section = *root.find_section("Output");
      Entry   &samples = *section.find_entry("Samples");
      samples.means("Rows of series.csv from the start to the end time, besides that of the start; stop conditions are "
                    "looked at with each. A test of section Laboratory has so many during its ramp and again from the "
                    "beginning of the loading; whenever it has lasted twice as long, they lie twice as far apart");
      samples.decides = true; // when a stop condition is seen
      section.find_entry("Snapshots")
        ->means("ParaView files from the start to the end time, the first and last state "
                "besides; 0: none at all. Of a test of section Laboratory spread over its rows in the same proportion");
      section.text("Curve horizontal", horizontal, Need::optional)
        .means("Column of series.csv for curve.png; empty: the time. A test of section Laboratory, which draws "
               "stress_strain.png, has a curve.png only where a column is given")
        .housekeeping();
      section.text("Curve vertical", vertical, Need::optional)
        .means(
          "Column of series.csv for curve.png; empty: the stress of a test, the first probe, or the kinetic energy")
        .housekeeping();
    }
  } // namespace

  void ParticlesModel::declare(Section &root)
  {
    declare_as_part(root);
    declare_course(root);
    laboratory.declare(root);
  }

  void ParticlesModel::declare_as_part(Section &root)
  {
    SpecimenSection::Use use;
    use.other_particles = true;
    source.declare(root, physics.dimension, use);
    more.declare(root);
    material.declare(root);
    declare_physics(root, physics);
    groups.declare(root);
    clumps.declare(root);
    motion.declare(root);
    forces.declare(root);
    walls.declare(root);
    initial_velocity.declare(root);
    gauges.declare(root);
  }

  void ParticlesModel::declare_course(Section &root, const char *const weight)
  {
    time.declare(root);
    time.declare_by_time(root);
    root.find_section("Time")
      ->number("End time", end_time, "s", Range::positive(), Need::required)
      .means("When the run ends, unless a stop condition or the test of section Laboratory ends it before")
      .only_if([this] { return !laboratory.given(); }, "there is no section Laboratory that ends the run");
    gravity.declare(root, weight);
    stops.declare(root);
    declare_output(root, output, horizontal, vertical);
  }

  void ParticlesModel::check(const base::EntryPath &root) const
  {
    check_as_part(root);
    time.check_by_time(root);
    gravity.check(root, physics.dimension);
    laboratory.check(root, source, physics, names_before_test());
    if (laboratory.given() && gravity.asks_for_equilibrium())
      root.at("Gravity").refuse("Initial equilibrium",
                                "platens of section Laboratory stand where the packing ends, and would not know of "
                                "an equilibrium that moves it. Choose none.");
    stops.check(root, column_names());
    curve_horizontal();
    curve_vertical();
  }

  GroupNames ParticlesModel::check_as_part(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    const base::EntryPath specimen = root.at("Specimen");
    if (bonded() && !source.says_distance)
      specimen.refuse("Interaction ratio",
                      "the law links particles from the start: say up to which distance. Concrete: "
                      "about 1.5; 1.05 links spheres that touch. Or say Installation gap.");
    if (source.source == SpecimenSection::Source::none && more.added.empty())
      specimen.refuse("Source", "there is no particle at all. Give some in section More particles.");
    GroupNames names;
    more.check(root, physics.dimension, material, names);
    groups.check(root, physics.dimension, names);
    clumps.check(root, physics.dimension, names);
    motion.check(root, physics, names);
    forces.check(root, physics.dimension, names);
    walls.check(root, physics.dimension);
    initial_velocity.check(root, physics, names);
    gauges.check(root, names, motion, walls);
    return names;
  }

  dem::Packing ParticlesModel::packing(const std::function<bool(const Eigen::Vector3d &)> &keeps,
                                       std::optional<dem::Packing> *const                  cell) const
  {
    SpecimenSection specimen = source;
    specimen.bonded          = bonded();
    const auto one_body      = [this](const dem::Packing &whole) {
      return clumps.clumps.empty() ? std::function<bool(std::size_t, std::size_t)>() :
                                          clumps.one_body(groups_in(whole), whole.size());
    };
    return more.compose(specimen, material, physics.dimension, one_body, keeps, cell);
  }

  ParticleGroups ParticlesModel::groups_in(const dem::Packing &packing) const
  {
    ParticleGroups found = more.groups_in(packing.size(), physics.dimension);
    groups.find(packing, physics.dimension, found);
    clumps.find_pebbles(packing, physics.dimension, found);
    return found;
  }

  dem::SpecimenParameters ParticlesModel::parameters() const
  {
    dem::SpecimenParameters made;
    made.physics           = physics;
    made.density           = source.density;
    made.interaction_ratio = source.interaction_ratio;
    made.installation_gap  = source.installation_gap;
    made.thickness         = source.thickness;
    made.loose             = more.loose(physics.dimension);
    made.step_factor       = time.step_factor;
    made.damping           = time.damping_at(0);
    made.gravity           = gravity.vector();
    return made;
  }

  std::vector<postprocess::SeriesColumn> ParticlesModel::columns() const
  {
    std::vector<postprocess::SeriesColumn> all = {{"time", "s"}};
    for (const GaugeSection &gauge : gauges.gauges)
      all.push_back({gauge.name, gauge.unit()});
    for (const postprocess::SeriesColumn &column : laboratory.columns())
      all.push_back(column);
    for (const char *count : {"links", "broken_links", "contacts"})
      all.push_back({count, ""});
    append_energy_columns(all);
    return all;
  }

  std::vector<std::string> ParticlesModel::names_before_test() const
  {
    std::vector<std::string> names;
    for (const GaugeSection &gauge : gauges.gauges)
      names.push_back(gauge.name);
    return names;
  }

  std::vector<std::string> ParticlesModel::column_names() const
  {
    std::vector<std::string> names;
    for (const postprocess::SeriesColumn &column : columns())
      names.push_back(column.name);
    return names;
  }

  std::string ParticlesModel::curve_horizontal() const
  {
    return chosen_column(column_names(), "Curve horizontal", horizontal, laboratory.given() ? "strain" : "time");
  }

  std::string ParticlesModel::curve_vertical() const
  {
    return chosen_column(column_names(), "Curve vertical", vertical,
                         laboratory.given()    ? "stress" :
                         gauges.gauges.empty() ? "energy_kinetic" :
                                                 gauges.gauges.front().name);
  }
} // namespace apps

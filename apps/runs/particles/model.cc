#include "apps/runs/particles/model.h"

#include "apps/figures/drawn_curve.h"
#include "apps/figures/energy_terms.h"
#include "apps/models/specimen_parameters.h"

namespace apps
{
  void ParticlesModel::check(const base::EntryPath &root) const
  {
    const GroupNames names = check_as_part(root);
    precice.check(root);
    if (precice.given())
      names.require(root.at("preCICE"), "Group", precice.vertices);
    if (precice.given() && laboratory.given())
      root.at("preCICE").refuse("Participant",
                                "the machine of section Laboratory cannot go back in time. Take it away.");
    time.check_by_time(root);
    gravity.check(root, physics.dimension);
    laboratory.check(root, source, physics, names_before_test());
    if (laboratory.given() && gravity.asks_for_equilibrium())
      root.at("Gravity").refuse("Initial equilibrium",
                                "platens of section Laboratory stand where the packing ends, and would not know of "
                                "an equilibrium that moves it. Choose none.");
    joints.check(root, physics.dimension);
    if (joints.given() && !bonded())
      root.at("Specimen").refuse("Joints", "they cut links, and the law of the material makes none.");
    if (joints.given() && gravity.asks_for_equilibrium())
      root.at("Gravity").refuse("Initial equilibrium", "is not found for a specimen with joints. Choose none.");
    stops.check(root, column_names());
    curve_horizontal();
    curve_vertical();
  }

  GroupNames ParticlesModel::check_as_part(const base::EntryPath &root) const
  {
    source.check(root, physics.dimension);
    material.check(root, physics.dimension);
    mixed().check(root);
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
    probes.check(root, names, motion, walls);
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
    return more.compose({specimen, mix, material, physics.dimension}, one_body, keeps, cell);
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
    dem::SpecimenParameters made = specimen_parameters(source, physics, time);
    made.installation_gap        = source.installation_gap;
    made.loose                   = more.loose(physics.dimension);
    made.damping                 = time.damping_at(0);
    made.gravity                 = gravity.vector();
    made.emission_reach          = emission.reach;
    return made;
  }

  JointedPacking ParticlesModel::jointed(const dem::Packing &packing) const
  {
    return {joints, source, packing, physics.dimension, joints.given() ? more.loose(physics.dimension) : 0};
  }

  std::vector<postprocess::SeriesColumn> ParticlesModel::columns() const
  {
    std::vector<postprocess::SeriesColumn> all = {{"time", "s"}};
    for (const ProbeSection &probe : probes.probes)
      all.push_back({probe.name, probe.unit()});
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
    for (const ProbeSection &probe : probes.probes)
      names.push_back(probe.name);
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
                         probes.probes.empty() ? "energy_kinetic" :
                                                 probes.probes.front().name);
  }
} // namespace apps

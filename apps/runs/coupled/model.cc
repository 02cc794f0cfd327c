#include "apps/runs/coupled/model.h"

#include "apps/figures/drawn_curve.h"
#include "apps/runs/continuum/upright.h"
#include "apps/text/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace apps
{
  void CoupledModel::check(const base::EntryPath &scene) const
  {
    const base::EntryPath solid = scene.at("Continuum"), body = scene.at("Particles");
    continuum.check_as_part(solid);
    if (continuum.is_static())
      solid.at("Model").refuse("Analysis", "particles move, and so does what they touch: explicit.");
    if (particles.physics.dimension != continuum.solid.dimension)
      solid.at("Model").refuse("Dimension", "must be that of the particles (Particles/Physics/Dimension).");
    const GroupNames groups = particles.check_as_part(body);
    particles.time.check_by_time(scene);
    particles.gravity.check(scene, dimension());
    couplings.check(scene, groups, continuum.contacts.empty() && handshakes.empty());
    handshakes.check(scene, dimension());
    check_sides(scene);
    laboratory.check(scene, couplings, continuum.loads, dimension());
    for (const CouplingSection &coupling : couplings.couplings)
      {
        if (particles.walls.knows(coupling.name))
          throw base::InputError("Couplings/" + coupling.name + ": there is a wall of this name. Take another.");
        if (!coupling.bond.given())
          continue;
        const auto links = coupling.bond.links(particles.physics);
        if (!(links ? links->bonds() : particles.bonded()))
          path_of(coupling).at("Bond").refuse(
            "Law", "links of this law carry no tension: nothing could be glued. Take one that bonds.");
      }
  }

  base::EntryPath CoupledModel::path_of(const CouplingSection &coupling) const
  {
    return base::EntryPath().at("Couplings").at(coupling.name);
  }

  void CoupledModel::refuse_unknown_boundaries(const std::vector<std::string> &known) const
  {
    for (const CouplingSection &coupling : couplings.couplings)
      for (const std::string &name : coupling.boundaries)
        if (std::find(known.begin(), known.end(), name) == known.end())
          path_of(coupling).refuse("Boundary", fmt::format("the mesh has no boundary \"{}\". {} It has: {}.", name,
                                                           did_you_mean(name, known), fmt::join(known, ", ")));
  }

  void CoupledModel::check_sides(const base::EntryPath &scene) const
  {
    const Eigen::Vector3d weight = particles.gravity.vector();
    require_upright_names(continuum, weight);
    if (continuum.mesh.source == MeshSection::Source::file)
      return;
    for (const CouplingSection &coupling : couplings.couplings)
      for (const std::string &boundary : coupling.boundaries)
        if (const std::string fault = fault_of_side(boundary, weight); !fault.empty())
          scene.at("Couplings").at(coupling.name).refuse("Boundary", fault);
  }

  dem::Packing CoupledModel::packing(std::optional<dem::Packing> *const cell) const
  {
    if (handshakes.empty())
      return particles.packing();
    return particles.packing([this](const Eigen::Vector3d &place) { return handshakes.may_hold(place); }, cell);
  }

  ParticleMedia CoupledModel::media(const std::optional<dem::Packing> &cell) const
  {
    if (handshakes.empty())
      return {};
    return media_of({cell, particles.mixed(), particles.physics.rotations}, continuum, handshakes);
  }

  namespace
  {
    std::vector<std::string> names_of(const std::vector<postprocess::SeriesColumn> &columns)
    {
      std::vector<std::string> names;
      for (const postprocess::SeriesColumn &column : columns)
        names.push_back(column.name);
      return names;
    }
  } // namespace

  void CoupledModel::check_columns(const std::vector<postprocess::SeriesColumn> &columns,
                                   const std::vector<postprocess::SeriesColumn> &reported) const
  {
    std::vector<std::string> names = names_of(columns);
    particles.stops.check({}, names);
    curve(columns, reported);
    std::sort(names.begin(), names.end());
    if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
      throw base::InputError("column " + *twice +
                             " of series.csv would be there twice. Name a probe or a coupling otherwise.");
  }

  std::pair<std::string, std::string> CoupledModel::curve(const std::vector<postprocess::SeriesColumn> &columns,
                                                          const std::vector<postprocess::SeriesColumn> &reported) const
  {
    const std::vector<std::string> names = names_of(columns);
    return {
      chosen_column(names, "Curve horizontal", particles.horizontal, laboratory.given() ? "strain" : "time"),
      chosen_column(names, "Curve vertical", particles.vertical, laboratory.given() ? "stress" : reported.back().name)};
  }
} // namespace apps

#include "apps/runs/structure/model.h"

#include "apps/specimens/specimen_packing.h"
#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  void PathSection::check(const base::EntryPath &root, const DisplacementProbesSection &probes) const
  {
    const base::EntryPath s = root.at("Path");
    if (step > end)
      s.refuse("Step", "must not be above End.");
    if (leading.empty())
      return;
    if (!probes.find(leading))
      s.refuse("Opening", "is no probe (a sub-section of Probes). " + did_you_mean_or_known(leading, probes.names()));
    if (opening_step > end_opening)
      s.refuse("Opening step", "must not be above End opening.");
  }

  dem::QuasiStaticParameters PathSection::parameters(dem::Ranks *const ranks) const
  {
    dem::QuasiStaticParameters p;
    p.strain_step        = step;
    p.end_strain         = end;
    p.end_stress         = stop_fraction;
    p.growth_step        = growth_step;
    p.tolerance          = tolerance;
    p.relaxation.damping = damping;
    p.solver             = solver;
    p.ranks              = ranks;
    return p;
  }

  void StructureModel::check(const base::EntryPath &root) const
  {
    source.check(root, dimension);
    material.check(root, dimension);
    mixed().check(root);
    for (const VoidSection &empty : voids)
      empty.region.check(root.at("Voids").at(empty.name), dimension);
    GroupNames names;
    groups.check(root, dimension, names);
    supports.check(root, dimension, names);
    probes.check(root, dimension, names);
    gravity.check(root, dimension);
    path.check(root, probes);
    bending_test.check(root, gravity.acts());
    wedge_splitting.check(root);
    if (!has_solid())
      return;
    const base::EntryPath solid = root.at("Continuum");
    continuum.check_as_static_part(solid);
    if (continuum.solid.dimension != dimension)
      solid.at("Model").refuse("Dimension", "must be that of the particles (Physics/Dimension).");
    handshakes.check(root, dimension);
    if (handshakes.promote() && any_given(continuum.loads.body_force))
      solid.refuse("Body force", "elements that become particles would lose it: leave out Promote at, or the force.");
  }

  bool StructureModel::is_void(const Eigen::Vector3d &place) const
  {
    return std::any_of(voids.begin(), voids.end(),
                       [&](const VoidSection &empty) { return empty.region.holds(place, dimension); });
  }

  bool StructureModel::is_void_between(const Eigen::Vector3d &one, const Eigen::Vector3d &other) const
  {
    return std::any_of(voids.begin(), voids.end(),
                       [&](const VoidSection &empty) { return empty.region.meets(one, other, dimension); });
  }

  dem::Packing StructureModel::packing(std::optional<dem::Packing> *const cell) const
  {
    const dem::Packing whole = specimen_particles(source, dimension, cell);
    dem::Packing       kept  = particles_where(whole, [&](const std::size_t i) {
      const Eigen::Vector3d &place = whole.centre[i];
      return (!has_solid() || handshakes.may_come_to_hold(place)) && !is_void(place);
    });
    if (kept.size() == 0)
      throw base::InputError(
        "no particle of the specimen lies where particles are to be. Check the places of Handshakes and Voids "
        "against the packing (metres).");
    mixed().number(kept, origin_of(source));
    return kept;
  }

  ParticleMedia StructureModel::media(const std::optional<dem::Packing> &cell) const
  {
    if (!has_solid())
      return {};
    return media_of({cell, mixed(), rotations}, continuum, handshakes);
  }

  ParticleGroups StructureModel::groups_in(const dem::Packing &packing) const
  {
    ParticleGroups found;
    groups.find(packing, dimension, found);
    return found;
  }

  dem::Physics StructureModel::physics() const
  {
    dem::Physics modelled;
    modelled.dimension = dimension;
    modelled.rotations = rotations;
    return modelled;
  }

  dem::ElasticNetwork StructureModel::linked(const dem::Packing &packing) const
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.rotations         = rotations;
    links.interaction_ratio = source.interaction_ratio;
    links.thickness         = source.thickness;
    return dem::make_network(packing, links, materials(packing));
  }

  dem::ElasticNetwork StructureModel::network(const dem::Packing &packing) const
  {
    dem::ElasticNetwork made    = linked(packing);
    const auto          crosses = [&](const dem::ElasticLink &link) {
      const Eigen::Vector3d &first = packing.centre[static_cast<std::size_t>(link.first)];
      return is_void_between(first, first + link.branch);
    };
    made.links.erase(std::remove_if(made.links.begin(), made.links.end(), crosses), made.links.end());
    return made;
  }

  std::vector<Eigen::Vector3d> StructureModel::weights(const dem::Packing &packing) const
  {
    const std::vector<double>    density = materials(packing).densities(source.density);
    std::vector<Eigen::Vector3d> weight;
    for (std::size_t i = 0; i < packing.size(); ++i)
      weight.push_back(density.at(packing.material.empty() ? 0 : static_cast<std::size_t>(packing.material[i])) *
                       shape().volume(packing.radius[i]) * gravity.vector());
    return weight;
  }

  dem::LoadedNetwork StructureModel::particles(const dem::Packing &packing, const ParticleGroups &members) const
  {
    dem::LoadedNetwork loaded = dem::unloaded(network(packing));
    supports.drive(loaded, members);
    if (gravity.acts())
      dem::weigh_down(loaded, weights(packing));
    return loaded;
  }
} // namespace apps

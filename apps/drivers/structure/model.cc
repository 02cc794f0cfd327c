#include "apps/drivers/structure/model.h"

#include "apps/specimens/specimen_packing.h"

#include <algorithm>
#include <limits>

namespace apps
{
  void PathSection::declare(Section &root)
  {
    Section &s = root.section("Path", "How the load factor t is led along the equilibria, in which it may fall back");
    s.number("End", end, "-", Range::positive(), Need::required)
      .means("Load factor at which the path ends at the latest");
    s.number("Step", step, "-", Range::positive(), Need::required)
      .means("Largest step of the load factor; halve it to see what it decides (and to lower the error of the energy "
             "balance)");
    s.number("Stop fraction", stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means("The path ends when the force of the load factor has fallen to this part of its peak; 0: never");
    s.number("Growth step", growth_step, "-", Range::between(1e-4, 1), Need::optional)
      .means("Largest growth of any link's damaging strain in a step, over itself; it controls the steps where damage "
             "is fast");
    s.number("Tolerance", tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Unbalanced force over forces of links and solid, both as root of the sum of squares");
    s.number("Damping", damping, "-", Range::from_up_to(0.01, 1), Need::optional)
      .means("Local (Cundall) damping where cracks run away and dynamics looks for the next equilibrium");
  }

  void PathSection::check(const base::EntryPath &root) const
  {
    if (step > end)
      root.at("Path").refuse("Step", "must not be above End.");
  }

  dem::QuasiStaticParameters PathSection::parameters() const
  {
    dem::QuasiStaticParameters p;
    p.strain_step        = step;
    p.end_strain         = end;
    p.end_stress         = stop_fraction;
    p.growth_step        = growth_step;
    p.tolerance          = tolerance;
    p.relaxation.damping = damping;
    return p;
  }

  void StructureModel::declare(Section &root)
  {
    SpecimenSection::Use use;
    use.inertia = false;
    source.declare(root, dimension, use);
    material.declare(root, use.inertia);
    Section &modelled = root.section("Physics", "What is modelled");
    modelled.choice("Dimension", dimension, {{"2", 2}, {"3", 3}}, Need::optional)
      .means("3: spheres in space; 2: discs in the plane z = 0");
    modelled.flag("Rotations", rotations).means("Particles spin; off: they only translate");
    root
      .section("Voids",
               "One sub-section per place without particles, as a notch is: those whose centre lies in it are left out")
      .named_sections("VOID", [this](Section &opened) {
        VoidSection &added = voids.emplace_back();
        added.name         = opened.name();
        added.region.declare(opened);
      });
    groups.declare(root);
    supports.declare(root);
    Section &solid = root.section(
      "Continuum", "The solid around the particles, linear elastic; sections of a scene of kind continuum, "
                   "its loads and displacements in proportion to t");
    solid.only_if([this] { return has_solid(); }, "section Handshakes is there");
    continuum.declare_as_static_part(solid);
    handshakes.declare(root, continuum, false);
    path.declare(root);
    gauges.declare(root);
    declare_output(root);
  }

  void StructureModel::declare_output(Section &root)
  {
    Section &output = root.section("Output", "How often results are written");
    output.integer("Points per snapshot", snapshot_interval, "", Range::between(0, 1e6), Need::optional)
      .means("Points of the path from one set of ParaView files to the next; 0: none at all")
      .housekeeping();
    output.number("Checkpoint interval", checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
    output.text("Curve horizontal", horizontal, Need::optional)
      .means("Column of series.csv for curve.png; empty: the first probe, or the load factor")
      .housekeeping();
    output.text("Curve vertical", vertical, Need::optional)
      .means("Column of series.csv for curve.png; empty: the first reaction, or the force of the load factor")
      .housekeeping();
  }

  void StructureModel::check(const base::EntryPath &root) const
  {
    source.check(root, dimension);
    material.check(root, dimension);
    for (const VoidSection &empty : voids)
      empty.region.check(root.at("Voids").at(empty.name), dimension);
    GroupNames names;
    groups.check(root, dimension, names);
    supports.check(root, dimension, names);
    gauges.check(root, dimension, names);
    path.check(root);
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
    material.assign(kept, dimension, origin_of(source));
    return kept;
  }

  ParticleMedia StructureModel::media(const std::optional<dem::Packing> &cell) const
  {
    if (!has_solid())
      return {};
    return media_of({cell, source, material, dimension, rotations}, continuum, handshakes);
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

  dem::ElasticNetwork StructureModel::network(const dem::Packing &packing) const
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.rotations         = rotations;
    links.interaction_ratio = source.interaction_ratio;
    links.thickness         = source.thickness;
    return dem::make_network(packing, links, material.materials());
  }

  dem::LoadedNetwork StructureModel::particles(const dem::Packing &packing, const ParticleGroups &members) const
  {
    dem::LoadedNetwork loaded = dem::unloaded(network(packing));
    supports.lead(loaded, members);
    return loaded;
  }
} // namespace apps

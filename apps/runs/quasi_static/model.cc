#include "apps/runs/quasi_static/model.h"

#include "dem/network/turning_grips.h"

namespace apps
{
  void QuasiStaticModel::check(const base::EntryPath &root) const
  {
    source.check(root, dimension);
    material.check(root, dimension);
    mixed().check(root);
    joints.check(root, dimension);
    if (joints.given() && is_cell())
      root.at("Specimen")
        .refuse("Joints", "they cut through a body, and a periodic cell has no end to them. Choose "
                          "Specimen/Body = box.");
    const base::EntryPath loading = root.at("Loading");
    if (dimension == 2 && axis == 2)
      loading.refuse("Axis", "in two dimensions the specimen lies in the plane z = 0. Load it along x or y.");
    if (!is_cell())
      grips.check(loading);
    if (!is_cell() && grips_turn && !lateral_blocked)
      loading.refuse("Grips turn", "the specimen would fall over: set Lateral motion blocked = true.");
    for (const UniaxialLoad load : tests)
      if (const auto way = steps(load); way.end_strain < way.strain_step)
        loading.at(load == UniaxialLoad::tension ? "Tension" : "Compression")
          .refuse("Stop strain", "must not be below the strain step.");
  }

  dem::QuasiStaticParameters QuasiStaticModel::steps(const UniaxialLoad load) const
  {
    const Test                &test = load == UniaxialLoad::tension ? tension : compression;
    dem::QuasiStaticParameters p;
    p.sign               = load == UniaxialLoad::tension ? 1 : -1;
    p.strain_step        = test.strain_step;
    p.end_strain         = test.stop_strain;
    p.end_stress         = test.stop_fraction;
    p.growth_step        = growth_step;
    p.tolerance          = tolerance;
    p.relaxation.damping = damping;
    p.solver             = linear_solver;
    return p;
  }

  dem::GripLayers QuasiStaticModel::grip_layers(const dem::Packing &packing) const
  {
    dem::check_packing(packing, "packing");
    return dem::find_grip_layers({packing.centre, packing.radius, dimension, source.thickness}, axis,
                                 grips.parameters());
  }

  dem::LoadedNetwork QuasiStaticModel::load(const JointedPacking &jointed) const
  {
    dem::NetworkParameters links;
    links.dimension         = dimension;
    links.rotations         = rotations;
    links.interaction_ratio = source.interaction_ratio;
    links.installation_gap  = source.installation_gap;
    links.thickness         = source.thickness;
    if (is_cell())
      return dem::load_cell(dem::make_network(jointed.packing(), links, materials(jointed)), axis, !lateral_blocked);
    dem::GripPair pair;
    pair.axis            = axis;
    pair.lateral_blocked = lateral_blocked;
    pair.spin_blocked    = spin_blocked;
    pair.layers          = grip_layers(jointed.packing());
    dem::Packing free    = jointed.packing();
    free.periodic_cell.reset();
    dem::LoadedNetwork loaded = dem::load_grips(dem::make_network(free, links, materials(jointed)), pair);
    if (grips_turn)
      dem::let_grips_turn(loaded, pair);
    return loaded;
  }
} // namespace apps

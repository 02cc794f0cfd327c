#include "apps/runs/continuum/model.h"

#include "apps/models/start_velocity.h"
#include "apps/runs/continuum/cells.h"
#include "apps/runs/continuum/upright.h"
#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    void refuse_moving_cells(const base::EntryPath &root, const MaterialsSection &materials)
    {
      for (const auto &group : materials.groups)
        if (const CellsConstants *cells = group->cells())
          cells->refuse_motion(root.at("Materials").at(group->group).at(group->law->name()));
    }
  } // namespace

  void ControlSection::check(const base::EntryPath &root, const std::vector<std::string> &points) const
  {
    const base::EntryPath s = root.at("Control");
    if (smallest() > first() || first() > largest() * (1 + 1e-12))
      s.refuse("First step", "it must lie between the smallest and the largest step.");
    if (relax && follow != Follow::time)
      s.refuse("Relax", "goes with Control/Follow = time: path control follows the load down by itself.");
    if (follow != Follow::indirect)
      return;
    for (const char *entry : {"Opening from", "Opening to"})
      {
        const std::string &name = entry == std::string("Opening from") ? opening_from : opening_to;
        if (std::find(points.begin(), points.end(), name) == points.end())
          s.refuse(entry,
                   "there is no such point. " +
                     (points.empty() ? "Give its place: subsection Points/" + name + "." : did_you_mean(name, points)));
      }
    if (opening_from == opening_to)
      s.refuse("Opening to", "is the same point as Opening from.");
  }

  void ContinuumModel::check(const base::EntryPath &root) const
  {
    check_as_part(root);
    std::vector<std::string> points;
    for (const auto &point : loads.points)
      points.push_back(point->name);
    if (is_static())
      control.check(root, points);
    precice.check(root);
    if (precice.given() && is_static())
      root.at("preCICE").refuse("Participant", "only a solid in motion is coupled: Model/Analysis = explicit.");
    if (precice.given() && (!contacts.empty() || !motion.rigid.empty()))
      root.at("preCICE").refuse("Participant", "a solid whose bodies touch, or do not deform, cannot go back in time.");
  }

  void ContinuumModel::check_as_part(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Model");
    if (solid.large_displacement && solid.mean_dilatation)
      s.refuse("Mean dilatation", "is a small-strain form. Switch it off with large displacements.");
    if (!motion.rigid.empty() && !solid.large_displacement)
      root.at("Motion").refuse("Rigid bodies", "they turn: Model/Large displacement = true goes with them.");
    refuse_time(root.at("Motion"), "Initial velocity", motion.initial_velocity);
    mesh.check(root, solid.dimension);
    materials.check(root, solid.large_displacement);
    if (is_static())
      refuse_moving_cells(root, materials);
    loads.check(root, solid.dimension);
    require_upright_names(*this, body_force_at_once(*this));
    contacts.check(root, !is_static());
  }

  void ContinuumModel::check_as_static_part(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Model");
    if (!is_static())
      s.refuse("Analysis", "nothing moves in time here: static.");
    if (solid.large_displacement)
      s.refuse("Large displacement", "the solid around particles in equilibrium is linear. Switch it off.");
    mesh.check(root, solid.dimension);
    materials.check(root, solid.large_displacement);
    refuse_moving_cells(root, materials);
    loads.check(root, solid.dimension);
    require_upright_names(*this, body_force_at_once(*this));
  }

  ContinuumModel ContinuumModel::of_each_rank()
  {
    ContinuumModel model;
    model.spread = false;
    return model;
  }

  bool ContinuumModel::has_cells() const
  {
    return std::any_of(materials.groups.begin(), materials.groups.end(),
                       [](const auto &group) { return group->cells() != nullptr; });
  }

  MPI_Comm ContinuumModel::ranks_of_mesh() const { return spread && !has_cells() ? MPI_COMM_WORLD : MPI_COMM_SELF; }
} // namespace apps

#include "apps/runs/continuum/probes.h"

#include "apps/runs/continuum/solid.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace apps
{
  namespace
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;

    bool acts(const LoadsSection &loads, const std::size_t c)
    {
      const auto any = [c](const auto &list, const auto &formula) {
        return std::any_of(list.begin(), list.end(), [&](const auto &item) { return formula(*item)[c].given(); });
      };
      return any(loads.boundaries, [](const BoundaryCondition &b) -> const Expressions & { return b.traction; }) ||
             any(loads.forces, [](const PointLoad &f) -> const Expressions & { return f.force; }) ||
             loads.body_force[c].given() ||
             std::any_of(loads.boundaries.begin(), loads.boundaries.end(),
                         [](const auto &b) { return b->pressure.given(); });
    }
  } // namespace

  template <int dim>
  ContinuumProbes<dim>::ContinuumProbes(fem::Solid<dim> &solid_, const ContinuumModel &model)
    : solid(solid_)
  {
    dealii::Point<dim> low, high;
    for (unsigned int c = 0; c < dim; ++c)
      {
        low[c]  = -1e300;
        high[c] = 1e300;
      }
    for (unsigned int c = 0; c < dim; ++c)
      if (acts(model.loads, c))
        loads.push_back({std::string("load_") + "xyz"[c], solid.dofs_within(low, high, c)});
    for (const auto &b : model.loads.boundaries)
      for (unsigned int c = 0; c < dim; ++c)
        if (b->displacement[c].given())
          reactions.push_back({"reaction_" + column_name(b->name) + "_" + "xyz"[c], solid.boundary_dofs(b->name, c)});
    for (const auto &s : model.loads.supports)
      for (unsigned int c = 0; c < dim; ++c)
        if (s->displacement[c].given())
          reactions.push_back(
            {"reaction_" + column_name(s->name) + "_" + "xyz"[c],
             solid.dofs_within(point_of<dim>(s->from), point_of<dim>(s->is_box ? s->to : s->from), c)});
    for (const auto &p : model.loads.points)
      for (unsigned int c = 0; c < dim; ++c)
        try
          {
            displacements.push_back({"displacement_" + column_name(p->name) + "_" + "xyz"[c],
                                     solid.interpolation(point_of<dim>(p->position), c)});
          }
        catch (const base::InputError &refusal)
          {
            throw base::InputError(p->place.text() + ": Points/" + p->name + ": " + refusal.what());
          }
    add_totals();
    watch_histories();
    fem::Vector rest = solid.make_vector();
    rest.update_ghost_values();
    start_at(rest);
  }

  template <int dim>
  void ContinuumProbes<dim>::add_totals()
  {
    const std::size_t sets = reactions.size();
    for (unsigned int c = 0; c < dim; ++c)
      {
        std::set<dealii::types::global_dof_index> all;
        std::size_t                               counted_each = 0;
        for (std::size_t r = 0; r < sets; ++r)
          if (reactions[r].name.back() == "xyz"[c])
            {
              all.insert(reactions[r].dofs.begin(), reactions[r].dofs.end());
              counted_each += reactions[r].dofs.size();
            }
        if (sum(counted_each - all.size(), solid.communicator()) > 0)
          reactions.push_back({std::string("total_reaction_") + "xyz" [c], { all.begin(), all.end() }});
      }
  }

  template <int dim>
  bool ContinuumProbes<dim>::Watched::is(const fem::PointQuantity &of) const
  {
    return role != fem::PointQuantity::Role::other ? of.role == role : quantity == of.name;
  }

  template <int dim>
  void ContinuumProbes<dim>::watch_histories()
  {
    using Quantity = fem::PointQuantity;
    if (solid.linear()) // has none
      return;
    for (const auto &group : solid.groups())
      for (const Quantity &of : group.second->quantities())
        if (of.shown == Quantity::Shown::counted && std::find(counted.begin(), counted.end(), of.name) == counted.end())
          counted.push_back(of.name);
    watched = {{"largest_damage", "-", Quantity::Role::damage, ""},
               {"largest_crack_opening", "m", Quantity::Role::crack_opening, ""}};
    for (const auto &group : solid.groups())
      for (const Quantity &of : group.second->quantities())
        if (of.shown == Quantity::Shown::series && of.kind == Quantity::Kind::number &&
            std::none_of(watched.begin(), watched.end(), [&of](const Watched &w) { return w.is(of); }))
          watched.push_back({std::string("largest_") + of.name, of.unit, Quantity::Role::other, of.name});
  }

  template <int dim>
  std::vector<ProbeColumn> ContinuumProbes<dim>::columns() const
  {
    using Reported = ProbeColumn::Reported;
    std::vector<ProbeColumn> all;
    for (const auto *resultants : {&loads, &reactions})
      for (const Resultant &r : *resultants)
        all.push_back({{r.name, "N"}, Reported::peak});
    for (const Displacement &d : displacements)
      all.push_back({{d.name, "m"}, Reported::last, "final_" + d.name});
    all.push_back({{"energy_stored", "J"}});
    all.push_back({{"energy_dissipated", "J"}, Reported::last, "dissipated_energy"});
    for (const Watched &w : watched)
      all.push_back({{w.name, w.unit}, Reported::last, w.name});
    for (const std::string &name : counted)
      all.push_back({{"points_" + name, ""}, Reported::last, "points_" + name});
    return all;
  }

  template <int dim>
  std::string ContinuumProbes<dim>::first_reaction() const
  {
    return reactions.empty() ? "" : reactions.front().name;
  }

  template <int dim>
  typename ContinuumProbes<dim>::Points ContinuumProbes<dim>::read_points(const fem::Vector &displacement,
                                                                          const double       work) const
  {
    Points found{work, std::vector<double>(watched.size(), 0.0), std::vector<double>(counted.size(), 0.0)};
    if (solid.linear()) // nothing is dissipated
      return found;
    found.stored = 0;
    solid.visit_points(displacement, [&](const fem::PointView<dim> &point) {
      found.stored += point.volume * point.material->stored_energy(point.index, point.strain, point.stress);
      point.material->visit(point.index, [&](const fem::PointQuantity &of, const double *value) {
        for (std::size_t w = 0; w < watched.size(); ++w)
          if (watched[w].is(of))
            found.largest[w] = std::max(found.largest[w], *value);
        for (std::size_t c = 0; c < counted.size(); ++c)
          found.count[c] += counted[c] == of.name ? *value : 0;
      });
    });
    const MPI_Comm comm = solid.communicator();
    found.stored        = sum(found.stored, comm);
    for (double &largest : found.largest)
      largest = max(largest, comm);
    for (double &count : found.count)
      count = sum(count, comm);
    return found;
  }

  template <int dim>
  std::vector<double> ContinuumProbes<dim>::read(const SolidState &state, ContinuumEnergy &energy) const
  {
    std::vector<double> row;
    for (const Resultant &r : loads)
      {
        double total = 0;
        for (const auto dof : r.dofs)
          total += (*state.external_force)[dof];
        row.push_back(total);
      }
    for (const Resultant &r : reactions)
      {
        double total = 0;
        for (const auto dof : r.dofs)
          total += (*state.internal_force)[dof] - (*state.external_force)[dof];
        row.push_back(total);
      }
    for (const Displacement &d : displacements)
      {
        double total = 0;
        for (const auto &[dof, weight] : d.weights)
          total += weight * (*state.displacement)[dof];
        row.push_back(total);
      }
    for (double &value : row)
      value = sum(value, solid.communicator());
    const Points points = read_points(*state.displacement, energy.internal);
    energy.stored       = points.stored - stored_at_start;
    if (!energy.materials_keep_account)
      energy.dissipated = energy.internal - energy.stored;
    row.insert(row.end(), {points.stored, energy.dissipated});
    row.insert(row.end(), points.largest.begin(), points.largest.end());
    row.insert(row.end(), points.count.begin(), points.count.end());
    return row;
  }

  template class ContinuumProbes<2>;
  template class ContinuumProbes<3>;
} // namespace apps

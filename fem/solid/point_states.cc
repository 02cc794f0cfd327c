// Points of a solid that are evaluated together, and what all of them remember.
#include "base/flat_state.h"
#include "fem/points/gathered_points.h"
#include "fem/solid/element_sweep.h"

#include <deal.II/base/mpi.h>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /** What is gathered for a group of elements. */
    template <typename Item>
    struct OfGroup
    {
      std::string       name;
      GatheredPoints   *law = nullptr;
      std::vector<Item> items;
    };

    /** In the order of the groups' names: points are gathered by all ranks together, and their addresses differ from rank to rank. */
    template <typename Item>
    std::vector<OfGroup<Item>> gathered_groups(const std::map<std::string, std::unique_ptr<MaterialPoints>> &groups)
    {
      std::vector<OfGroup<Item>> found;
      for (const auto &[name, law] : groups)
        if (auto *gathered = dynamic_cast<GatheredPoints *>(law.get()))
          found.push_back({name, gathered, {}});
      return found;
    }

    /** Those of a law; nullptr where its points are not gathered. */
    template <typename Item>
    std::vector<Item> *items_of(std::vector<OfGroup<Item>> &groups, const MaterialPoints *law)
    {
      for (OfGroup<Item> &group : groups)
        if (group.law == law)
          return &group.items;
      return nullptr;
    }
  } // namespace

  template <int dim>
  void Solid<dim>::place_gathered_points()
  {
    auto groups = gathered_groups<GatheredPoints::Site>(materials);
    gathers     = !groups.empty(); // the same on every rank
    if (!gathers)
      return;
    FEValues<dim> values(*geometry, *element, points, update_quadrature_points);
    std::size_t   next = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e     = elements[next++];
          auto *const          sites = items_of(groups, e.material);
          if (!sites)
            continue;
          values.reinit(cell);
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              GatheredPoints::Site site;
              site.number = cell->global_active_cell_index() * points.size() + q;
              for (unsigned int d = 0; d < dim; ++d)
                site.place[d] = values.quadrature_point(q)[d];
              site.element = e.extent;
              sites->push_back(site);
            }
        }
    for (auto &group : groups)
      group.law->place(std::move(group.items), {dim == 2, settings.large_displacement, group.name});
  }

  template <int dim>
  void Solid<dim>::begin_motion(const double length)
  {
    if (gathers)
      for (const auto &law : materials)
        if (auto *gathered = dynamic_cast<GatheredPoints *>(law.second.get()))
          gathered->begin_motion(length);
  }

  template <int dim>
  void Solid<dim>::gather(const Vector &displacement, const bool with_tangent)
  {
    if (!gathers)
      return;
    auto              groups = gathered_groups<base::Voigt>(materials);
    ElementSweep<dim> at_hand(*this);
    std::size_t       next = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e = elements[next++];
          if (auto *const strains = items_of(groups, e.material))
            {
              at_hand.reinit(cell, displacement);
              for (unsigned int q = 0; q < points.size(); ++q)
                strains->push_back(at_hand.strain(q));
            }
        }
    for (const auto &group : groups)
      group.law->gather(group.items, with_tangent);
  }

  template <int dim>
  void Solid<dim>::visit_histories(const StateColumn &column)
  {
    for (const ElementPoints &e : elements)
      for (std::size_t q = 0; q < points.size(); ++q)
        e.material->visit(e.first + q, column);
  }

  template <int dim>
  void Solid<dim>::visit_state(base::StateVisitor &visitor)
  {
    base::Column values;
    visit_histories(
      [&](const PointQuantity &of, const double *first) { values.insert(values.end(), first, first + of.values()); });
    visitor.column("histories", values);
    auto next = values.begin();
    visit_histories([&](const PointQuantity &of, double *first) {
      std::copy_n(next, of.values(), first);
      next += of.values();
    });
    for (const auto &[group, law] : materials)
      {
        if (!law->remembers_more())
          continue;
        base::Column more, size(1); // its length must be known on every rank before it is read
        {
          base::FlatStateWriter writer(more);
          law->visit_more(writer);
        }
        const base::Column before = more;
        size[0]                   = static_cast<double>(more.size());
        visitor.column("length_of_" + group, size);
        more.resize(static_cast<std::size_t>(size[0]));
        visitor.column("more_of_" + group, more);
        if (more == before)
          continue;
        base::FlatStateReader reader(more);
        law->visit_more(reader);
      }
  }

  template <int dim>
  base::Column Solid<dim>::saved_points()
  {
    base::Column          saved;
    base::FlatStateWriter writer(saved);
    visit_state(writer);
    return saved;
  }

  template <int dim>
  void Solid<dim>::restore_points(const base::Column &saved)
  {
    base::FlatStateReader reader(saved);
    visit_state(reader);
  }

  template <int dim>
  std::string Solid<dim>::end_of_validity() const
  {
    std::string own;
    for (const auto &law : materials)
      if (const auto *gathered = dynamic_cast<const GatheredPoints *>(law.second.get()); gathered && own.empty())
        own = gathered->end_of_validity();
    for (const std::string &found : Utilities::MPI::all_gather(communicator(), own))
      if (!found.empty())
        return found;
    return "";
  }

  template <int dim>
  std::vector<std::string> Solid<dim>::notes() const
  {
    std::vector<std::string> own, all;
    for (const auto &[group, law] : materials)
      if (const auto *gathered = dynamic_cast<const GatheredPoints *>(law.get()))
        for (const std::string &note : gathered->notes())
          own.push_back(group + ": " + note);
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator(), own))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }

  template void                     Solid<2>::begin_motion(double);
  template void                     Solid<3>::begin_motion(double);
  template void                     Solid<2>::place_gathered_points();
  template void                     Solid<3>::place_gathered_points();
  template void                     Solid<2>::gather(const Vector &, bool);
  template void                     Solid<3>::gather(const Vector &, bool);
  template void                     Solid<2>::visit_histories(const StateColumn &);
  template void                     Solid<3>::visit_histories(const StateColumn &);
  template void                     Solid<2>::visit_state(base::StateVisitor &);
  template void                     Solid<3>::visit_state(base::StateVisitor &);
  template base::Column             Solid<2>::saved_points();
  template base::Column             Solid<3>::saved_points();
  template void                     Solid<2>::restore_points(const base::Column &);
  template void                     Solid<3>::restore_points(const base::Column &);
  template std::vector<std::string> Solid<2>::notes() const;
  template std::vector<std::string> Solid<3>::notes() const;
  template std::string              Solid<2>::end_of_validity() const;
  template std::string              Solid<3>::end_of_validity() const;
}

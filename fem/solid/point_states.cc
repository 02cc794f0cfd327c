// Points of a solid that are asked together, and what all of them remember.
#include "base/flat_state.h"
#include "fem/points/gathered_points.h"
#include "fem/solid/element_sweep.h"

#include <deal.II/base/mpi.h>

namespace fem
{
  using namespace dealii;

  template <int dim>
  void Solid<dim>::place_gathered_points()
  {
    std::map<GatheredPoints *, std::vector<GatheredPoints::Site>> sites;
    for (const auto &law : materials)
      if (auto *gathered = dynamic_cast<GatheredPoints *>(law.second.get()))
        sites[gathered] = {};
    gathers = !sites.empty(); // the same on every rank
    if (!gathers)
      return;
    FEValues<dim> values(*geometry, *element, points, update_quadrature_points);
    std::size_t   next = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e        = elements[next++];
          auto *const          gathered = dynamic_cast<GatheredPoints *>(e.material);
          if (!gathered)
            continue;
          values.reinit(cell);
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              GatheredPoints::Site site;
              site.number = cell->global_active_cell_index() * points.size() + q;
              for (unsigned int d = 0; d < dim; ++d)
                site.place[d] = values.quadrature_point(q)[d];
              site.element = e.extent;
              sites[gathered].push_back(site);
            }
        }
    for (auto &[gathered, of_it] : sites)
      gathered->place(std::move(of_it), {dim == 2, settings.large_displacement});
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
    std::map<GatheredPoints *, std::vector<base::Voigt>> strains;
    for (const auto &law : materials)
      if (auto *gathered = dynamic_cast<GatheredPoints *>(law.second.get()))
        strains[gathered] = {};
    ElementSweep<dim> at_hand(*this);
    std::size_t       next = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const ElementPoints &e = elements[next++];
          if (auto *gathered = dynamic_cast<GatheredPoints *>(e.material))
            {
              at_hand.reinit(cell, displacement);
              for (unsigned int q = 0; q < points.size(); ++q)
                strains[gathered].push_back(at_hand.strain(q));
            }
        }
    for (const auto &[gathered, of_it] : strains)
      gathered->gather(of_it, with_tangent);
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

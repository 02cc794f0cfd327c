// State of cells, and the columns reported of them.
#include "base/errors.h"
#include "coupling/multiscale/cell_points.h"
#include "coupling/multiscale/stretch.h"

#include <algorithm>

namespace coupling
{
  void CellPoints::set_initial(std::size_t, const fem::InitialPointState &, const fem::ElementExtent &)
  {
    throw base::InputError("cells: no initial state can be given to them.");
  }

  std::vector<fem::PointQuantity> CellPoints::quantities() const
  {
    std::vector<fem::PointQuantity> all;
    Record                          record;
    describe(record, [&all](const fem::PointQuantity &of, double *) { all.push_back(of); });
    return all;
  }

  void CellPoints::describe(Record &record, const fem::StateColumn &column)
  {
    using Kind  = fem::PointQuantity::Kind;
    using Role  = fem::PointQuantity::Role;
    using Shown = fem::PointQuantity::Shown;
    column({"promoted", "-", "1: the particles answer", Kind::number, Role::other, Shown::counted}, &record.promoted);
    column({promoted_in_state, "-", "number of the state", Kind::number, Role::other, Shown::fields}, &record.since);
    column({"damage_of_links", "-", "mean over the links of a cell", Kind::number, Role::damage, Shown::fields},
           &record.damage);
    column({"localised", "-", "1: the cell has lost ellipticity", Kind::number, Role::other, Shown::counted},
           &record.localised);
    column({"strain_of_cell", "-", "", Kind::strain, Role::other, Shown::nowhere}, record.strain.data());
  }

  void CellPoints::visit(const std::size_t number, const fem::StateColumn &column)
  {
    Point       &point  = points.at(number);
    const Record before = point.record;
    describe(point.record, column);
    if (before == point.record)
      return;
    point.known = false;
    point.fresh.reset();
  }

  void CellPoints::visit_more(base::StateVisitor &visitor)
  {
    visitor.scalar("states", states);
    localised.visit_state(visitor);
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        Point       &point  = points[i];
        std::int64_t banded = point.band ? 1 : 0, promoted = point.cell ? 1 : 0;
        visitor.scalar("promoted", promoted);
        visitor.scalar("banded", banded);
        visitor.scalar("stored", point.stored);
        base::Column stress(point.stress.begin(), point.stress.end());
        visitor.column("stress", stress);
        std::copy(stress.begin(), stress.end(), point.stress.begin());
        if (promoted == 0)
          point.cell.reset();
        else if (!point.cell)
          point.cell = point.prepared->promoted_at(base::Voigt::Zero(), point.prepared->system_of_thread(0));
        if (point.cell)
          point.cell->visit_state(visitor);
        if (banded == 0)
          point.band.reset();
        else if (!point.band)
          point.band.emplace();
        if (point.band)
          point.band->visit_state(visitor);
        point.known = false;
        point.fresh.reset();
      }
  }

  double CellPoints::stored_energy(const std::size_t number, const base::Voigt &strain, const base::Voigt &stress) const
  {
    const Point &point = points.at(number);
    if (point.record.promoted > 0)
      return point.stored;
    if (!parameters.large_strains)
      return 0.5 * stress.dot(strain);
    const base::Voigt e = Stretch(strain).strain();
    return 0.5 * e.dot(point.prepared->stiffness() * e);
  }

  double CellPoints::stored_now(const Point &point, const base::Voigt &strain) const
  {
    const double of_cell = point.cell->energy().stored / point.prepared->volume();
    return point.band ? point.band->share_of_cell() * of_cell + point.band->stored_outside(strain) : of_cell;
  }

  fem::Dissipation CellPoints::dissipated(const std::size_t number, const fem::ElementExtent &) const
  {
    if (!losses_known)
      find_losses();
    const Point &point = points.at(number);
    return point.known && point.is_promoted ? point.lost : fem::Dissipation();
  }

  void CellPoints::find_losses() const
  {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (is_mine(i) && points[i].known && points[i].is_promoted)
        {
          points[i].lost = losses_of(points[i]);
          own.push_back(i);
        }
    dealt.share(own, [this](const std::size_t i, base::StateVisitor &visitor) {
      visitor.scalar("plasticity", points[i].lost.plasticity);
      visitor.scalar("damage", points[i].lost.damage);
    });
    losses_known = true;
  }

  fem::Dissipation CellPoints::losses_of(const Point &point)
  {
    const dem::RespondingCell &cell = point.cell ? *point.cell : *point.fresh;
    const dem::CellEnergy      from = cell.energy(), to = cell.energy_of_trial();
    const double               share = (point.band ? point.band->share_of_cell() : 1.0) / point.prepared->volume();
    return {share * (to.friction - from.friction), share * (to.damage - from.damage + to.damped - from.damped)};
  }

  std::size_t CellPoints::promoted() const
  {
    return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const Point &point) { return point.record.promoted > 0; }));
  }
} // namespace coupling

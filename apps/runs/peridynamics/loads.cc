#include "apps/runs/peridynamics/loads.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    bool varies_in_time(const PeridynamicTraction &traction)
    {
      return traction.pressure.varies_in_time() || std::any_of(traction.value.begin(), traction.value.end(),
                                                               [](const Expression &e) { return e.varies_in_time(); });
    }
  } // namespace

  Eigen::Vector3d PeridynamicTraction::at(const pd::BoundaryPoint &point,
                                          const int                dimension,
                                          const double             when,
                                          const bool               quiet) const
  {
    const Eigen::Vector3d &x = point.place;
    const double           t = when;
    Eigen::Vector3d        p = Eigen::Vector3d::Zero();
    if (value.size() == 1 && dimension > 1)
      p = value[0](x.x(), x.y(), x.z(), t) * point.normal;
    else
      for (std::size_t c = 0; c < value.size(); ++c)
        p[static_cast<Eigen::Index>(c)] = value[c](x.x(), x.y(), x.z(), t);
    if (pressure.given())
      p -= pressure(x.x(), x.y(), x.z(), t) * point.normal;
    return quiet && !varies_in_time(*this) ? Eigen::Vector3d(when * p) : p;
  }

  void PeridynamicLoadsSection::check(const base::EntryPath &root, const int dimension) const
  {
    for (const PeridynamicTraction &t : tractions)
      {
        const base::EntryPath section = root.at("Tractions").at(t.name);
        if (t.value.empty() && !t.pressure.given())
          section.refuse("Value", "gives no traction, nor does Pressure.");
        for (std::size_t c = static_cast<std::size_t>(dimension); c < t.value.size(); ++c)
          if (t.value[c].varies_in_space() || t.value[c].varies_in_time() || t.value[c](0, 0, 0, 1) != 0)
            section.refuse("Value", fmt::format("has a component along {}, but the body has {} dimension{}.", "xyz"[c],
                                                dimension, dimension > 1 ? "s" : ""));
      }
    for (const PeridynamicSupport &s : supports)
      {
        const base::EntryPath section = root.at("Displacements").at(s.name);
        if (s.boundary.empty())
          s.region.check(section, dimension);
        if (!any_given(s.displacement))
          section.refuse("x", "none of x, y and z is prescribed.");
      }
  }

  namespace
  {
    /** A component of a node that a formula moves. */
    struct DrivenComponent
    {
      std::size_t     node;
      std::size_t     component;
      Eigen::Vector3d place;
      Expression      formula;
    };

    std::vector<std::size_t> nodes_of(const PeridynamicSupport &support, const pd::Grid &grid)
    {
      if (!support.boundary.empty())
        try
          {
            return pd::outer_nodes(grid, support.boundary);
          }
        catch (const base::InputError &refusal)
          {
            throw base::InputError("Displacements/" + support.name + "/" + refusal.what());
          }
      std::vector<std::size_t> found;
      for (const std::size_t i : grid.nodes())
        if (support.region.holds(grid.position(i), grid.dimension() == 1 ? 3 : grid.dimension()))
          found.push_back(i);
      if (found.empty())
        throw base::InputError("Displacements/" + support.name + ": no node lies in the region.");
      return found;
    }

    std::vector<pd::BoundaryPoint> points_of(const PeridynamicTraction &traction, const pd::Grid &grid)
    try
      {
        return pd::boundary_points(grid, traction.boundary);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError("Tractions/" + traction.name + "/" + refusal.what());
      }

    void
    drive(const std::list<PeridynamicSupport> &supports, const pd::Grid &grid, const bool quiet, PeridynamicLoads &made)
    {
      std::vector<DrivenComponent> driven;
      made.act.held.assign(grid.places(), 0);
      for (const PeridynamicSupport &support : supports)
        for (const std::size_t i : nodes_of(support, grid))
          for (std::size_t c = 0; c < static_cast<std::size_t>(grid.dimension()); ++c)
            if (support.displacement[c].given())
              {
                made.act.held[i] |= static_cast<std::uint8_t>(1u << c);
                made.held = true;
                driven.push_back({i, c, grid.position(i), support.displacement[c]});
              }
      made.act.displacements = [driven, quiet](const double when, pd::Field &u) {
        for (const DrivenComponent &l : driven)
          {
            const double value       = l.formula(l.place.x(), l.place.y(), l.place.z(), when);
            u.c[l.component][l.node] = quiet && !l.formula.varies_in_time() ? when * value : value;
          }
      };
    }
  } // namespace

  PeridynamicLoads PeridynamicLoadsSection::on(const pd::Bonds &bonds, const bool quiet) const
  {
    const int        dimension = bonds.grid().dimension();
    PeridynamicLoads made;
    for (const PeridynamicTraction &t : tractions)
      {
        auto transfer = std::make_shared<pd::Transfer>(bonds.grid(), bonds.horizon(), bonds.model(),
                                                       points_of(t, bonds.grid()), t.weight, t.form);
        if (made.transfers.empty())
          for (const pd::BoundaryPoint &p : transfer->points())
            made.first_traction = std::max(made.first_traction, t.at(p, dimension, 1.0, quiet).norm());
        if (transfer->singular() > 0)
          made.warnings.push_back(fmt::format(
            "Tractions/{}: at {} points the nodes lie on a line; what they cannot carry along it is shared out evenly.",
            t.name, transfer->singular()));
        made.transfers.push_back(transfer);
      }
    made.act.forces = [acting = tractions, transfers = made.transfers, dimension,
                       quiet](const double when, const pd::Field *const u, pd::Field &forces) {
      auto transfer = transfers.begin();
      for (const PeridynamicTraction &t : acting)
        {
          std::vector<Eigen::Vector3d> values;
          for (const pd::BoundaryPoint &p : (*transfer)->points())
            values.push_back(t.at(p, dimension, when, quiet));
          (*transfer++)->add(values, u, forces);
        }
    };
    drive(supports, bonds.grid(), quiet, made);
    return made;
  }
} // namespace apps

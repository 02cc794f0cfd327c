#include "coupling/multiscale/cell_points.h"

#include "base/errors.h"
#include "coupling/multiscale/ellipticity.h"
#include "coupling/multiscale/stretch.h"

#include <Eigen/Eigenvalues>

#include <omp.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** The first stiffness, scaled so that none of the others is stiffer in any strain. */
    base::Stiffness stiffest_of(const std::vector<std::shared_ptr<const PreparedCell>> &cells)
    {
      const base::Stiffness &first = cells.front()->stiffness();
      double                 scale = 1;
      for (const auto &cell : cells)
        if (cell != cells.front())
          scale = std::max(scale, Eigen::GeneralizedSelfAdjointEigenSolver<base::Stiffness>(cell->stiffness(), first,
                                                                                            Eigen::EigenvaluesOnly)
                                    .eigenvalues()[5]);
      return scale * first;
    }
  } // namespace

  CellPoints::CellPoints(CellPointsParameters given, const fem::Plane plane)
    : parameters(std::move(given))
  {
    if (parameters.cells.empty())
      throw std::invalid_argument("cells: at least one is needed.");
    if (plane == fem::Plane::stress)
      throw base::InputError("cells are not built for plane stress. Set Model/Plane = strain, or Model/Dimension = 3.");
    stiffest = stiffest_of(parameters.cells);
  }

  void CellPoints::allocate(const std::size_t n_points)
  {
    points.clear();
    points.resize(n_points);
    sites.assign(n_points, {});
    for (std::size_t i = 0; i < n_points; ++i)
      points[i].prepared = parameters.cells[i % parameters.cells.size()];
  }

  void CellPoints::place(std::vector<Site> given, const Setting &setting)
  {
    sites                    = std::move(given);
    parameters.plane         = setting.plane;
    parameters.large_strains = setting.large_strains;
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i].prepared = parameters.cells[sites[i].number % parameters.cells.size()];
  }

  void CellPoints::gather(const std::vector<base::Voigt> &strains, const bool with_tangent)
  {
    const auto n = static_cast<std::int64_t>(points.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t i = 0; i < n; ++i)
      find(points[static_cast<std::size_t>(i)], strains[static_cast<std::size_t>(i)], with_tangent);
  }

  void CellPoints::evaluate(const std::size_t  number,
                            const base::Voigt &strain,
                            const fem::ElementExtent &,
                            const bool        with_tangent,
                            fem::PointAnswer &answer)
  {
    Point &point = points.at(number);
    find(point, strain, with_tangent);
    if (!point.failure.empty())
      throw fem::MaterialFailure(point.failure);
    answer.stress = point.answer.stress;
    if (with_tangent)
      answer.tangent = point.answer.tangent;
  }

  void CellPoints::find(Point &point, const base::Voigt &strain, const bool with_tangent) const
  {
    if (point.known && point.strain == strain && (point.has_tangent || !with_tangent))
      return;
    point.known       = true;
    point.has_tangent = with_tangent;
    point.strain      = strain;
    point.failure.clear();
    try
      {
        if (!parameters.large_strains)
          {
            point.law_strain = strain;
            find_law(point, with_tangent);
            point.answer = point.of_law;
            return;
          }
        const Stretch stretch(strain);
        point.law_strain = stretch.strain();
        find_law(point, with_tangent);
        point.answer.stress = stretch.stress(point.of_law.stress);
        if (with_tangent)
          point.answer.tangent = stretch.tangent(point.of_law.stress, point.of_law.tangent);
      }
    catch (const std::exception &problem) // no exception may leave a thread
      {
        point.failure     = problem.what();
        point.is_promoted = false;
      }
  }

  void CellPoints::find_law(Point &point, const bool with_tangent) const
  {
    point.is_promoted = point.cell || point.prepared->is_left_by(point.law_strain);
    if (!point.is_promoted)
      {
        point.of_law.tangent = point.prepared->stiffness();
        point.of_law.stress  = point.of_law.tangent * point.law_strain;
        return;
      }
    if (!point.cell && !point.fresh)
      point.fresh =
        point.prepared->promoted_at(point.record.strain, point.prepared->system_of_thread(omp_get_thread_num()));
    ask_cell(point, with_tangent);
    if (parameters.localised == Localised::refuse && with_tangent && point.law_strain != point.record.strain)
      if (const WeakestPlane plane = weakest_plane(point.of_law.tangent, point.prepared->stiffness(), parameters.plane);
          plane.is_lost())
        {
          std::ostringstream text;
          text << "the cell localises across the normal " << plane.normal.transpose()
               << ", and such states are refused (When localised = refuse).";
          throw fem::MaterialFailure(text.str());
        }
  }

  void CellPoints::ask_cell(Point &point, const bool with_tangent) const
  {
    dem::RespondingCell &cell   = point.cell ? *point.cell : *point.fresh;
    dem::CellSystem     &system = point.prepared->system_of_thread(omp_get_thread_num());
    if (!point.band)
      {
        const dem::CellResponse response = cell.respond(point.law_strain, system, with_tangent);
        point.of_law                     = {response.stress, response.tangent};
        return;
      }
    const CrackBand::Answer whole = point.band->respond(point.law_strain, [&](const base::Voigt &of_band) {
      const dem::CellResponse response = cell.respond(of_band, system);
      return CrackBand::Answer{response.stress, response.tangent};
    });
    point.of_law                  = {whole.stress, whole.tangent};
  }

  void CellPoints::commit()
  {
    const auto                                  n = static_cast<std::int64_t>(points.size());
    std::vector<std::optional<Eigen::Vector3d>> lost(points.size());
    std::vector<char>                           taken_over(points.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t i = 0; i < n; ++i)
      {
        Point &point = points[static_cast<std::size_t>(i)];
        if (!point.known || !point.failure.empty())
          continue;
        const base::Voigt strain = point.record.strain, stress = point.stress;
        taken_over[static_cast<std::size_t>(i)] = !point.cell && point.is_promoted;
        commit(point);
        lost[static_cast<std::size_t>(i)] = lost_plane(point, strain, stress);
      }
    ++states;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        if (taken_over[i])
          points[i].record.since = static_cast<double>(states);
        if (lost[i])
          localise(i, *lost[i]);
      }
  }

  void CellPoints::commit(Point &point) const
  {
    if (point.is_promoted && point.fresh)
      {
        point.cell            = std::move(point.fresh);
        point.record.promoted = 1;
      }
    point.fresh.reset();
    if (point.cell)
      {
        point.cell->commit();
        if (point.band)
          point.band->commit();
        point.record.damage = point.cell->links().mean_damage();
      }
    point.record.strain = point.law_strain;
    point.stress        = point.of_law.stress;
    point.known         = false; // what is asked next starts from here
  }

  std::optional<Vector3d>
  CellPoints::lost_plane(Point &point, const base::Voigt &strain_before, const base::Voigt &stress_before) const
  {
    if (!point.cell || point.record.localised > 0 || point.record.damage == 0)
      return std::nullopt;
    base::Stiffness tangent = point.of_law.tangent;
    if (!point.has_tangent)
      {
        // In motion nobody asks for tangents. One is worth its price where the work of second order is negative.
        const base::Voigt change = point.record.strain - strain_before;
        if (!(change.dot(point.stress - stress_before) < 0))
          return std::nullopt;
        try
          {
            tangent = point.cell->tangent(point.prepared->system_of_thread(omp_get_thread_num()));
          }
        catch (const base::NumericalError &)
          {
            return std::nullopt; // seen again in the next state
          }
      }
    const WeakestPlane plane = weakest_plane(tangent, point.prepared->stiffness(), parameters.plane);
    return plane.is_lost() ? std::optional(plane.normal) : std::nullopt;
  }

  void CellPoints::localise(const std::size_t number, const Vector3d &normal)
  {
    Point &point           = points[number];
    point.record.localised = 1;
    found.push_back({sites[number].place, normal, states});
    if (parameters.localised == Localised::stop || parameters.localised == Localised::refuse)
      end = text_of(found.back()) + ". What its mean stress is worth from here on, the size of the element decides: "
                                    "When localised = crack band goes on with it.";
    if (parameters.localised != Localised::crack_band)
      return;
    const double width = sites[number].element.along(normal), length = point.prepared->length_along(normal);
    if (length > width * (1 + 1e-9))
      {
        std::ostringstream text;
        text << text_of(found.back()) << ", along which the cell is " << length << " m long and the element " << width
             << " m: a band does not fit in. Take wider elements, or a smaller cell.";
        end = text.str();
        return;
      }
    dem::CellSystem  &system = point.prepared->system_of_thread(0);
    const base::Voigt strain = point.record.strain;
    point.band.emplace(normal, std::min(1.0, length / width), strain, point.stress,
                       point.cell->unloading_stiffness(system), point.cell->energy().stored / point.prepared->volume());
  }

  std::string CellPoints::text_of(const Localisation &localisation) const
  {
    std::ostringstream text;
    text << "the cell at " << localisation.place.transpose() << " has localised in state " << localisation.state
         << ", across the normal " << localisation.normal.transpose();
    return text.str();
  }

  std::vector<std::string> CellPoints::notes() const
  {
    std::vector<std::string> all;
    for (const Localisation &localisation : found)
      all.push_back(text_of(localisation));
    return all;
  }

  void CellPoints::visit_localisations(base::StateVisitor &visitor)
  {
    base::Column              row;
    std::vector<std::int32_t> letters(end.begin(), end.end());
    for (const Localisation &l : found)
      {
        row.insert(row.end(), l.place.begin(), l.place.end());
        row.insert(row.end(), l.normal.begin(), l.normal.end());
        row.push_back(static_cast<double>(l.state));
      }
    visitor.column("localisations", row);
    visitor.column("end", letters);
    end.assign(letters.begin(), letters.end());
    found.clear();
    for (std::size_t i = 0; i + 7 <= row.size(); i += 7)
      found.push_back({{row[i], row[i + 1], row[i + 2]},
                       {row[i + 3], row[i + 4], row[i + 5]},
                       static_cast<std::int64_t>(row[i + 6])});
  }

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
    visit_localisations(visitor);
    for (Point &point : points)
      {
        std::int64_t banded = point.band ? 1 : 0, promoted = point.cell ? 1 : 0;
        visitor.scalar("promoted", promoted);
        visitor.scalar("banded", banded);
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
    if (!point.cell)
      {
        if (!parameters.large_strains)
          return 0.5 * stress.dot(strain);
        const base::Voigt e = Stretch(strain).strain();
        return 0.5 * e.dot(point.prepared->stiffness() * e);
      }
    const double stored = point.cell->energy().stored / point.prepared->volume();
    if (!point.band)
      return stored;
    return point.band->share_of_cell() * stored + point.band->stored_outside(point.record.strain);
  }

  fem::Dissipation CellPoints::dissipated(const std::size_t number, const fem::ElementExtent &) const
  {
    const Point &point = points.at(number);
    if (!point.known || !point.is_promoted)
      return {};
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

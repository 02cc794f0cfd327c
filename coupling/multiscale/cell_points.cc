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
    , dealt(parameters.communicator)
  {
    if (parameters.cells.empty())
      throw std::invalid_argument("cells: at least one is needed.");
    const bool spheres =
      std::any_of(parameters.cells.begin(), parameters.cells.end(), [](const auto &cell) { return !cell->of_discs(); });
    if (plane == fem::Plane::stress && spheres)
      throw base::InputError(
        "cells of spheres are not built for plane stress. Set Model/Plane = strain, or Model/Dimension "
        "= 3, or take discs (Particles = discs).");
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
    sites = std::move(given);
    dealt.name(setting.group);
    parameters.plane = setting.plane;
    for (const auto &cell : parameters.cells)
      if (cell->of_discs() && !setting.plane)
        throw base::InputError("cells of discs are plane, and the model has three dimensions. Set Model/Dimension = 2, "
                               "or take spheres.");
    parameters.large_strains = setting.large_strains;
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i].prepared = parameters.cells[sites[i].number % parameters.cells.size()];
  }

  void CellPoints::gather(const std::vector<base::Voigt> &strains, const bool with_tangent)
  {
    std::vector<std::size_t> requested;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (request(points[i], strains[i], with_tangent))
        requested.push_back(i);
    answer_to(requested);
  }

  void CellPoints::evaluate(const std::size_t  number,
                            const base::Voigt &strain,
                            const fem::ElementExtent &,
                            const bool        with_tangent,
                            fem::PointAnswer &answer)
  {
    Point &point = points.at(number);
    if (request(point, strain, with_tangent))
      answer_to({number});
    if (!point.failure.empty())
      throw fem::MaterialFailure(point.failure);
    answer.stress = point.answer.stress;
    if (with_tangent)
      answer.tangent = point.answer.tangent;
  }

  void CellPoints::begin_step()
  {
    for (Point &point : points)
      {
        if (point.cell)
          point.cell->begin_step();
        if (point.band)
          point.band->begin_step();
        point.fresh.reset();
        point.known = false;
      }
  }

  bool CellPoints::request(Point &point, const base::Voigt &strain, const bool with_tangent)
  {
    if (point.known && point.strain == strain && (point.has_tangent || !with_tangent))
      return false;
    point.known       = true;
    point.has_tangent = with_tangent;
    point.strain      = strain;
    losses_known      = false;
    return true;
  }

  void CellPoints::answer_to(const std::vector<std::size_t> &requested)
  {
    const auto n = static_cast<std::int64_t>(requested.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t k = 0; k < n; ++k)
      {
        Point &point      = points[requested[static_cast<std::size_t>(k)]];
        point.is_promoted = false;
        point.failure.clear();
        try
          {
            point.law_strain = parameters.large_strains ? Stretch(point.strain).strain() : point.strain;
            if (point.prepared->of_discs())
              point.law_strain.segment<3>(2).setZero(); // of a plane model, to rounding
            if (is_mine(requested[static_cast<std::size_t>(k)]))
              find(point);
            else
              answer_elastically(point); // unless its rank sends another answer
          }
        catch (const std::exception &problem) // no exception may leave a thread
          {
            point.failure     = problem.what();
            point.is_promoted = false;
          }
      }
    share_answers(requested);
    for (const std::size_t i : requested)
      if (points[i].failure.empty())
        complete_answer(points[i]);
  }

  void CellPoints::share_answers(const std::vector<std::size_t> &requested)
  {
    std::vector<std::size_t> own;
    for (const std::size_t i : requested)
      if (is_mine(i) && (points[i].is_promoted || !points[i].failure.empty()))
        own.push_back(i);
    dealt.share(own, [this](const std::size_t i, base::StateVisitor &visitor) { visit_answer(points[i], visitor); });
  }

  void CellPoints::visit_answer(Point &point, base::StateVisitor &visitor)
  {
    std::int64_t promoted = point.is_promoted ? 1 : 0;
    visitor.scalar("promoted", promoted);
    visit_text(visitor, "failure", point.failure);
    point.is_promoted = promoted == 1;
    for (double &component : point.of_law.stress)
      visitor.scalar("stress", component);
    for (double &entry : point.of_law.tangent.reshaped())
      visitor.scalar("tangent", entry);
  }

  void CellPoints::complete_answer(Point &point) const
  {
    point.answer = point.of_law;
    if (!parameters.large_strains)
      return;
    const Stretch stretch(point.strain);
    point.answer.stress = stretch.stress(point.of_law.stress);
    if (point.has_tangent)
      point.answer.tangent = stretch.tangent(point.of_law.stress, point.of_law.tangent);
  }

  void CellPoints::answer_elastically(Point &point)
  {
    point.of_law.tangent = point.prepared->stiffness();
    point.of_law.stress  = point.of_law.tangent * point.law_strain;
  }

  void CellPoints::find(Point &point) const
  {
    point.is_promoted = point.cell || point.prepared->is_left_by(point.law_strain);
    if (!point.is_promoted)
      return answer_elastically(point);
    if (!point.cell && !point.fresh)
      point.fresh =
        point.prepared->promoted_at(point.record.strain, point.prepared->system_of_thread(omp_get_thread_num()));
    respond_by_cell(point);
    if (parameters.localised == Localised::refuse && point.has_tangent && point.law_strain != point.record.strain)
      if (const WeakestPlane plane = weakest_plane(point.of_law.tangent, point.prepared->stiffness(), parameters.plane);
          plane.is_lost())
        {
          std::ostringstream text;
          text << "the cell localises across the normal " << plane.normal.transpose()
               << ", and such states are refused (When localised = refuse).";
          throw fem::MaterialFailure(text.str());
        }
  }

  void CellPoints::respond_by_cell(Point &point) const
  {
    dem::RespondingCell &cell   = point.cell ? *point.cell : *point.fresh;
    dem::CellSystem     &system = point.prepared->system_of_thread(omp_get_thread_num());
    if (!point.band)
      {
        const dem::CellResponse response = cell.respond(point.law_strain, system, point.has_tangent);
        point.of_law                     = {response.stress, point.prepared->in_space(response.tangent)};
        return;
      }
    const CrackBand::Cell requested = {
      [&](const base::Voigt &of_band) { return cell.respond(of_band, system, false).stress; },
      [&] { return point.prepared->in_space(cell.tangent(system)); }};
    const CrackBand::Answer whole = point.band->respond(point.law_strain, requested);
    point.of_law                  = {whole.stress, whole.tangent};
  }

  void CellPoints::commit()
  {
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].known && points[i].failure.empty())
        changed.push_back(i);
    std::vector<News> news(points.size());
    const auto        n = static_cast<std::int64_t>(changed.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t k = 0; k < n; ++k)
      if (const std::size_t i = changed[static_cast<std::size_t>(k)]; is_mine(i) && points[i].is_promoted)
        news[i] = commit_cell(i);
    share_news(changed, news);
    ++states;
    for (const std::size_t i : changed)
      take(i, news[i]);
  }

  CellPoints::News CellPoints::commit_cell(const std::size_t number)
  {
    News news;
    try // no exception may leave a thread
      {
        Point &point = points[number];
        if (point.fresh)
          point.cell = std::move(point.fresh);
        point.cell->commit();
        if (point.band)
          point.band->commit();
        news.damage                          = point.cell->links().mean_damage();
        news.stored                          = stored_now(point, point.law_strain);
        const std::optional<Vector3d> normal = lost_plane(point, news.damage);
        if (!normal)
          return news;
        news.normal        = *normal;
        const double share = share_of_cell(number, *normal);
        if (parameters.localised == Localised::crack_band && share <= 1)
          point.band.emplace(*normal, share, point.law_strain, point.of_law.stress, unloading_of(point), news.stored);
      }
    catch (const std::exception &problem)
      {
        news.failure = problem.what();
      }
    return news;
  }

  void CellPoints::share_news(const std::vector<std::size_t> &changed, std::vector<News> &news) const
  {
    std::vector<std::size_t> own;
    for (const std::size_t i : changed)
      if (is_mine(i) && points[i].is_promoted)
        own.push_back(i);
    dealt.share(own, [&news](const std::size_t i, base::StateVisitor &visitor) { news[i].visit(visitor); });
  }

  void CellPoints::News::visit(base::StateVisitor &visitor)
  {
    visitor.scalar("damage", damage);
    visitor.scalar("stored", stored);
    for (double &component : normal)
      visitor.scalar("normal", component);
    visit_text(visitor, "failure", failure);
  }

  void CellPoints::take(const std::size_t number, const News &news)
  {
    Point &point = points[number];
    if (point.is_promoted)
      {
        if (point.record.promoted == 0)
          point.record.since = static_cast<double>(states);
        point.record.promoted = 1;
        point.record.damage   = news.damage;
        point.stored          = news.stored;
      }
    point.fresh.reset();
    point.record.strain = point.law_strain;
    point.stress        = point.of_law.stress;
    point.known         = false; // the next evaluation starts from here
    if (!news.failure.empty())
      throw base::NumericalError(news.failure);
    if (!news.normal.isZero(0))
      localise(number, news.normal);
  }

  std::optional<Vector3d> CellPoints::lost_plane(const Point &point, const double damage) const
  {
    if (point.record.localised > 0 || damage == 0)
      return std::nullopt;
    base::Stiffness tangent = point.of_law.tangent;
    if (!point.has_tangent)
      {
        // In motion no tangent is needed. One is worth its cost where the work of second order is negative.
        const base::Voigt change = point.law_strain - point.record.strain;
        if (!(change.dot(point.of_law.stress - point.stress) < 0))
          return std::nullopt;
        try
          {
            tangent =
              point.prepared->in_space(point.cell->tangent(point.prepared->system_of_thread(omp_get_thread_num())));
          }
        catch (const base::NumericalError &)
          {
            return std::nullopt; // seen again in the next state
          }
      }
    if (!weakest_plane(tangent, point.prepared->stiffness(), parameters.plane).is_lost())
      return std::nullopt;
    return first_lost_normal(unloading_of(point), tangent, point.prepared->stiffness(), parameters.plane);
  }

  base::Stiffness CellPoints::unloading_of(const Point &point)
  {
    dem::CellSystem &system = point.prepared->system_of_thread(omp_get_thread_num());
    return point.prepared->in_space(point.cell->unloading_stiffness(system));
  }

  double CellPoints::share_of_cell(const std::size_t number, const Vector3d &normal) const
  {
    const double share = points[number].prepared->length_along(normal) / sites[number].element.along(normal);
    return share <= 1 + 1e-9 ? std::min(1.0, share) : share;
  }

  void CellPoints::localise(const std::size_t number, const Vector3d &normal)
  {
    points[number].record.localised = 1;
    const Localisation here         = {sites[number].place, normal, states};
    std::ostringstream end;
    if (parameters.localised == Localised::stop || parameters.localised == Localised::refuse)
      end << here.text()
          << ". What its mean stress is worth from here on, the size of the element decides: When localised = crack "
             "band goes on with it.";
    if (parameters.localised == Localised::crack_band && share_of_cell(number, normal) > 1)
      end << here.text() << ", along which the cell is " << points[number].prepared->length_along(normal)
          << " m long and the element " << sites[number].element.along(normal)
          << " m: a band does not fit in. Take wider elements, or a smaller cell.";
    localised.add(here, end.str());
  }
} // namespace coupling

#include "dem/cells/responding_cell.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace dem
{
  namespace
  {
    void check(const LoadedNetwork &cell, const CellResponseParameters &p)
    {
      const auto require = [](const bool holds, const char *entry, const double value, const char *rule) {
        if (holds)
          return;
        std::ostringstream message;
        message << "cell: " << entry << " = " << value << ": " << rule;
        throw base::InputError(message.str());
      };
      if (!cell.network.periodic())
        throw base::InputError("cell: the packing has no periodic cell.");
      require(p.tolerance > 0 && p.tolerance <= 1e-2, "tolerance", p.tolerance, "must lie in (0, 1e-2].");
      require(p.max_iterations > 1, "iterations", p.max_iterations, "must be above 1.");
      require(p.growth_step > 0, "growth step", p.growth_step, "must be above 0.");
    }

    void check(const LoadedNetwork &cell, const base::Vector6 &strain)
    {
      const bool plane = cell.network.dimension == 2;
      if (!strain.allFinite() || (plane && !strain.segment<3>(2).isZero(0)))
        {
          std::ostringstream message;
          message << "cell: strain " << strain.transpose() << ": must be finite"
                  << (plane ? ", in the plane with the components 11, 22 and 12 alone." : ".");
          throw base::InputError(message.str());
        }
    }
    /**
     * Of a linear solution in Newton's method: no more than the next iteration can make use of (Dembo, Eisenstat and Steihaug 1982).
     * @param residual of the cell before it @param tolerance of the cell
     */
    double accuracy_of_step(const double residual, const double tolerance)
    {
      return std::max({1e-12, 1e-3 * tolerance / residual, std::min(1e-3, residual)});
    }

    constexpr double accuracy_of_first_step = 1e-4; ///< from a state in equilibrium

    /** Of the linear solutions for a tangent; what they leave comes in squared where links do not slide. */
    double accuracy_of_tangent(const double tolerance) { return std::max(1e-11, std::min(1e-7, 100 * tolerance)); }
  } // namespace

  RespondingCell::RespondingCell(std::shared_ptr<const LoadedNetwork>   network,
                                 const LinkMaterials                   &materials,
                                 const CellResponseParameters          &requested,
                                 std::shared_ptr<const ElasticResponse> undamaged)
    : cell(std::move(network))
    , scale(mean_arm(cell->network))
    , parameters(requested)
    , committed{DamagingLinks(*cell, materials), LoadedMotion(cell->held.size()), {}, 0, 0, undamaged ? 1 : 0}
    , trial(committed)
    , elastic(std::move(undamaged))
  {
    check(*cell, parameters);
    if (elastic && elastic->motion.size() != cell->network.particles())
      throw std::invalid_argument("cell: the elastic response is that of another cell.");
    evaluate(trial.motion);
    committed = trial;
  }

  RespondingCell::RespondingCell(const RespondingCell &other)
    : cell(other.cell)
    , scale(other.scale)
    , parameters(other.parameters)
    , committed(other.committed)
    , trial(other.trial)
    , fallen(other.fallen)
    , way(other.way)
    , near_by(other.near_by)
    , may_be_near(other.may_be_near)
    , elastic(other.elastic)
    , answer(other.answer)
  {
  }

  RespondingCell &RespondingCell::operator=(const RespondingCell &other)
  {
    if (cell != other.cell)
      own.reset();
    cell        = other.cell;
    scale       = other.scale;
    parameters  = other.parameters;
    committed   = other.committed;
    trial       = other.trial;
    fallen      = other.fallen;
    way         = other.way;
    near_by     = other.near_by;
    may_be_near = other.may_be_near;
    elastic     = other.elastic;
    answer      = other.answer;
    return *this;
  }

  RespondingCell::~RespondingCell() = default;

  void RespondingCell::evaluate(const LoadedMotion &motion)
  {
    trial.links.evaluate(motion);
    trial.unbalanced = unbalanced_of(*cell, motion, trial.links.forces(), trial.links.moments(), scale);
  }

  CellResponse RespondingCell::respond(const base::Vector6 &strain)
  {
    if (!own)
      own = std::make_unique<CellSystem>(*cell);
    return respond(strain, *own);
  }

  CellResponse RespondingCell::respond(const base::Vector6 &strain, CellSystem &shared, const bool with_tangent)
  {
    check(*cell, strain);
    system = &shared;
    if (way && !way->leads_to(strain))
      {
        way.reset();
        near_by.reset();
      }
    trial  = way ? way->begin : start();
    answer = CellResponse();
    if (strain != trial.motion.loads && !respond_elastically(strain) && !respond_near_by(strain))
      walk_to(strain);
    may_be_near     = !trial.is_elastic && (answer.parts == 1 || way) && answer.relaxation_steps == 0;
    answer.stress   = trial.unbalanced.loads / cell->volume;
    answer.residual = trial.unbalanced.residual;
    if (with_tangent)
      answer.tangent = tangent(shared);
    return answer;
  }

  base::Matrix6 RespondingCell::tangent(CellSystem &shared)
  {
    if (trial.is_elastic)
      return elastic->stiffness;
    base::Matrix6       D;
    const LinkStiffness kind =
      trial.motion.loads == start().motion.loads ? LinkStiffness::onward : LinkStiffness::consistent;
    CellSystem::Rates rates;
    if (near_by && may_be_near)
      rates = std::move(near_by->rates);
    if (!shared.condense(trial.links.stiffness(kind), accuracy_of_tangent(parameters.tolerance), D, rates))
      throw base::NumericalError("cell: its stiffness has no finite tangent; something holds it no more.");
    ++answer.iterations;
    near_by.reset();
    if (may_be_near && rates[0].size() > 0)
      near_by = NearBy{trial.motion, std::move(rates)};
    return D / cell->volume;
  }

  base::Matrix6 RespondingCell::unloading_stiffness(CellSystem &shared) const
  {
    base::Matrix6 D;
    if (!shared.condense(committed.links.stiffness(LinkStiffness::secant), accuracy_of_tangent(parameters.tolerance),
                         D))
      throw base::NumericalError("cell: its secant stiffness cannot be condensed; something holds it no more.");
    return D / cell->volume;
  }

  bool RespondingCell::respond_elastically(const base::Vector6 &strain)
  {
    if (!trial.is_elastic)
      return false;
    const base::Vector6   force = trial.unbalanced.loads, change = strain - trial.motion.loads;
    const Eigen::Vector3d held   = (elastic->motion.front() * strain).head<3>(); // the first particle stays where it is
    LoadedMotion         &motion = trial.motion;
    for (std::size_t i = 0; i < elastic->motion.size(); ++i)
      {
        const auto k            = static_cast<Eigen::Index>(i);
        motion.particles.col(k) = elastic->motion[i] * strain;
        motion.particles.col(k).head<3>() -= held;
      }
    motion.loads = strain;
    evaluate(motion);
    if (trial.unbalanced.residual <= parameters.tolerance && trial.links.is_undamaged())
      {
        trial.external_work += 0.5 * (force + trial.unbalanced.loads).dot(change);
        answer.parts = 1;
        return true;
      }
    trial            = committed;
    trial.is_elastic = 0;
    return false;
  }

  bool RespondingCell::respond_near_by(const base::Vector6 &strain)
  {
    constexpr double enough = 1e-2; // of the residual, to be nearer than the committed state
    if (!near_by)
      return false;
    const LoadedMotion  before = trial.motion;
    const base::Vector6 force = trial.unbalanced.loads, change = strain - before.loads;
    trial.motion = near_by->motion;
    for (int p = 0; p < 6; ++p)
      trial.motion.particles += (strain[p] - near_by->motion.loads[p]) * near_by->rates[static_cast<std::size_t>(p)];
    trial.motion.loads = strain;
    evaluate(trial.motion);
    if (trial.unbalanced.residual <= enough && iterate(LinkStiffness::consistent) &&
        trial.links.largest_growth() <= parameters.growth_step)
      {
        trial.external_work += 0.5 * (force + trial.unbalanced.loads).dot(change);
        answer.parts = 1;
        return true;
      }
    trial.motion = before;
    evaluate(before);
    return false;
  }

  void RespondingCell::walk_to(const base::Vector6 &strain)
  {
    constexpr double    smallest = 1.0 / 64;
    const base::Vector6 whole    = strain - trial.motion.loads;
    double              done = 0, part = 1;
    while (done < 1)
      {
        part                       = std::min(part, 1 - done);
        const base::Vector6 target = done + part < 1 ? base::Vector6(strain - (1 - done - part) * whole) : strain;
        const base::Vector6 force = trial.unbalanced.loads, change = target - trial.motion.loads;
        std::optional<Way>  last;
        if (parameters.keeps_its_way && done > 0 && done + part >= 1)
          last = Way{trial, strain};
        if (attempt(target, LinkStiffness::onward, part > smallest) ||
            (part <= smallest && attempt(target, LinkStiffness::secant, false)))
          {
            trial.external_work += 0.5 * (force + trial.unbalanced.loads).dot(change);
            if (last)
              way = std::move(last);
            ++answer.parts;
            done += part;
            part *= 2;
            if (done < 1)
              go_on_from_here();
          }
        else if (part > smallest)
          part /= 2;
        else
          {
            fall_to(target);
            ++answer.parts;
            done += part;
          }
      }
  }

  void RespondingCell::fall_to(const base::Vector6 &strain)
  {
    relax(strain);
    near_by.reset();
    way.reset();
    if (parameters.keeps_its_way)
      fallen = trial;
  }

  bool RespondingCell::attempt(const base::Vector6 &strain, const LinkStiffness stiffness, const bool limited)
  {
    const LoadedMotion before = trial.motion;
    LoadedMotion       correction;
    ++answer.iterations;
    bool done = system->solve(trial.links.stiffness(stiffness), trial.unbalanced, strain - before.loads,
                              accuracy_of_first_step, correction);
    if (done)
      {
        trial.motion.particles += correction.particles;
        trial.motion.loads = strain;
        evaluate(trial.motion);
        done = iterate(stiffness == LinkStiffness::onward ? LinkStiffness::consistent : stiffness);
      }
    if (done && (!limited || trial.links.largest_growth() <= parameters.growth_step))
      return true;
    trial.motion = before;
    evaluate(before);
    return false;
  }

  bool RespondingCell::iterate(const LinkStiffness stiffness)
  {
    const int     most             = parameters.max_iterations * (stiffness == LinkStiffness::secant ? 3 : 1);
    constexpr int without_progress = 4;
    double        best             = std::numeric_limits<double>::infinity();
    int           best_at          = 0;
    for (int i = 0; i <= most; ++i)
      {
        const double residual = trial.unbalanced.residual;
        if (residual <= parameters.tolerance)
          return true;
        if (residual < 0.7 * best)
          {
            best    = residual;
            best_at = i;
          }
        if (!std::isfinite(residual) || i - best_at > without_progress)
          return false;
        LoadedMotion correction;
        ++answer.iterations;
        if (!system->solve(trial.links.stiffness(stiffness), trial.unbalanced, base::Vector6::Zero(),
                           accuracy_of_step(residual, parameters.tolerance), correction))
          return false;
        trial.motion.particles += correction.particles;
        evaluate(trial.motion);
      }
    return false;
  }

  void RespondingCell::go_on_from_here()
  {
    trial.links.forget_growth();
    trial.links.commit();
    evaluate(trial.motion);
  }

  void RespondingCell::relax(const base::Vector6 &strain)
  {
    LinkRelaxationParameters p = parameters.relaxation;
    p.tolerance                = parameters.tolerance;
    trial.links.forget_growth();
    const LinkRelaxationReport report = relax_links(*cell, trial.links, trial.motion, strain - trial.motion.loads, p);
    if (!report.converged)
      {
        std::ostringstream message;
        message << "cell: no equilibrium at the strain " << strain.transpose() << " within " << report.steps
                << " steps of relaxation, residual " << report.residual
                << ". Raise the tolerance, or remove particles that nothing holds.";
        throw base::NumericalError(message.str());
      }
    trial.motion.loads = strain; // the ramp sums it up with rounding
    evaluate(trial.motion);
    answer.relaxation_steps += report.steps;
    trial.external_work += report.external_work;
    trial.damped += report.damped;
  }

  void RespondingCell::commit()
  {
    go_on_from_here();
    committed = trial;
    begin_step();
  }

  CellEnergy RespondingCell::energy() const
  {
    return {committed.external_work, committed.links.stored(), committed.links.damage_work(),
            committed.links.sliding_work(), committed.damped};
  }

  CellEnergy RespondingCell::energy_of_trial() const
  {
    const LinkLosses lost = trial.links.lost_with_trial();
    return {trial.external_work, trial.links.stored_in_trial(), lost.damage, lost.sliding, trial.damped};
  }

  void RespondingCell::visit_state(base::StateVisitor &visitor)
  {
    committed.links.visit_state(visitor);
    committed.motion.visit_state(visitor);
    begin_step();
    visitor.scalar("external_work", committed.external_work);
    visitor.scalar("damped", committed.damped);
    visitor.scalar("is_elastic", committed.is_elastic);
    trial = committed;
    evaluate(trial.motion);
    committed = trial;
  }
} // namespace dem

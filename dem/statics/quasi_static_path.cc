#include "dem/statics/quasi_static_path.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

namespace dem
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    constexpr double negligible = 0.03; ///< of the tolerance, for residuals of linear systems

    void check(const QuasiStaticParameters &p)
    {
      const auto require = [](const bool holds, const char *entry, const double value, const char *rule) {
        if (holds)
          return;
        std::ostringstream message;
        message << entry << " = " << value << ": " << rule;
        throw base::InputError(message.str());
      };
      require(p.sign == 1 || p.sign == -1, "Sign", p.sign, "must be 1 for tension or -1 for compression.");
      require(p.strain_step > 0, "Strain step", p.strain_step, "must be above 0.");
      require(p.growth_step > 0 && p.growth_step <= 1, "Growth step", p.growth_step, "must lie in (0, 1].");
      require(p.end_strain >= p.strain_step, "End strain", p.end_strain, "must not be below the strain step.");
      require(p.end_stress >= 0 && p.end_stress < 1, "End stress", p.end_stress, "must lie in [0, 1).");
      require(p.tolerance > 0 && p.tolerance <= 1e-2, "Tolerance", p.tolerance, "must lie in (0, 1e-2].");
      require(p.max_iterations > 1, "Iterations", p.max_iterations, "must be above 1.");
      if (p.leading)
        {
          require(p.leading->step > 0, "Opening step", p.leading->step, "must be above 0.");
          require(p.leading->end >= p.leading->step, "End opening", p.leading->end,
                  "must not be below the opening step.");
          require(!p.leading->group.empty(), "Opening", 0, "no particle is there to measure it at.");
        }
      require(p.relaxation.damping > 0 && p.relaxation.damping < 1, "Damping", p.relaxation.damping,
              "must lie in (0, 1).");
    }

    /** A dead load is put on wholly, and no more than that. */
    bool ends_exactly(const LoadedNetwork &loaded) { return loaded.dead && loaded.driven == loaded.dead->parameter; }

    void move(LoadedMotion &motion, const TangentSystem::Answer &answer, const double step)
    {
      motion.particles += answer.constant.particles + step * answer.per_step.particles;
      motion.loads += answer.constant.loads + step * answer.per_step.loads;
    }
  } // namespace

  double LeadingOpening::of(const LoadedNetwork &loaded, const LoadedMotion &motion) const
  {
    const auto mean = [&](const std::vector<std::size_t> &members) {
      double sum = 0;
      for (const std::size_t i : members)
        sum += motion.particles(axis, static_cast<Eigen::Index>(i)) + loaded.carried[i].row(axis).dot(motion.loads);
      return members.empty() ? 0.0 : sum / static_cast<double>(members.size());
    };
    return mean(group) - mean(other);
  }

  std::string name_of(const StepControl control)
  {
    switch (control)
      {
      case StepControl::strain:
        return "strain";
      case StepControl::opening:
        return "opening";
      case StepControl::leading:
        return "leading";
      case StepControl::relaxed:
        return "relaxed";
      case StepControl::changed:
        return "changed";
      }
    throw std::logic_error("name_of: no such control");
  }

  double QuasiStaticPoint::balance_error() const
  {
    const double largest = std::max(std::fabs(external_work), damage + friction + damped);
    return largest > 0 ? std::fabs(energy_residual()) / largest : 0.0;
  }

  QuasiStaticPath::QuasiStaticPath(const LoadedNetwork         &network,
                                   const LinkMaterials         &materials,
                                   const QuasiStaticParameters &asked)
    : loaded(&network)
    , parameters(asked)
    , bonds(network, materials)
    , system(network, {asked.solver, asked.ranks, negligible * asked.tolerance})
    , now(network.held.size())
    , path(1)
  {
    check(parameters);
    restore(now);
  }

  bool QuasiStaticPath::finished() const
  {
    double peak = 0;
    for (const auto &point : path)
      peak = std::max(peak, parameters.sign * point.stress[loaded->driven]);
    const double     stress = parameters.sign * path.back().stress[loaded->driven];
    constexpr double nearly = 1 - 1e-12;
    return parameters.sign * (driven() - origin) >= parameters.end_strain * nearly ||
           (is_led() && width(now) - width_before >= parameters.leading->end * nearly) ||
           (peak > 0 && stress <= parameters.end_stress * peak);
  }

  const QuasiStaticPoint &QuasiStaticPath::advance()
  {
    constexpr double smallest = 1.0 / 32, patient_below = 1.0 / 16;
    solutions = 0;
    for (; part >= smallest; part /= 2)
      for (const LinkStiffness stiffness : {LinkStiffness::onward, LinkStiffness::secant})
        {
          if (stiffness == LinkStiffness::secant && part > patient_below)
            continue;
          if (!attempt(stiffness, part))
            continue;
          accept(control);
          if (attempt_length <= parameters.max_iterations / 2)
            part = std::min(1.0, 2 * part);
          return path.back();
        }
    constexpr double onward = 0.02; // of a strain step: enough to leave a point of no equilibrium behind
    part                    = 0.25;
    relax(onward);
    return path.back();
  }

  void QuasiStaticPath::go_on_where(const QuasiStaticPath &earlier)
  {
    std::vector<std::optional<std::size_t>> same(bonds.size());
    for (std::size_t i = 0; i < same.size(); ++i)
      same[i] = i;
    bonds.take_over(earlier.bonds, same);
    path       = earlier.path;
    most_borne = earlier.most_borne;
    restore(earlier.now);
    dead_load_work = work_of_dead_loads();
    origin         = driven();
    width_before   = is_led() ? width(now) : 0;
  }

  const QuasiStaticPoint &QuasiStaticPath::go_on_from(const QuasiStaticPath                         &earlier,
                                                      const LoadedMotion                            &start,
                                                      const std::vector<std::optional<std::size_t>> &before)
  {
    bonds.take_over(earlier.bonds, before);
    path         = earlier.path;
    part         = earlier.part;
    most_borne   = earlier.most_borne;
    origin       = earlier.origin;
    width_before = earlier.width_before;
    solutions    = 0;
    bool done    = false;
    for (const LinkStiffness stiffness : {LinkStiffness::consistent, LinkStiffness::secant})
      {
        restore(start);
        done = done || iterate(stiffness, {StepControl::strain, driven(), parameters.growth_step});
        if (done)
          break;
      }
    if (done)
      accept(StepControl::changed);
    else
      {
        restore(start);
        relax(0);
      }
    const auto        energy_of = [](const QuasiStaticPoint &p) { return p.stored + p.damage + p.friction + p.damped; };
    QuasiStaticPoint &point     = path.back();
    point.control               = StepControl::changed;
    point.external_work         = earlier.path.back().external_work;
    point.changed += energy_of(point) - energy_of(earlier.path.back());
    return point;
  }

  void QuasiStaticPath::restore(const LoadedMotion &earlier)
  {
    now = earlier;
    bonds.evaluate(now);
    unbalanced = unbalanced_of(*loaded, now, bonds.forces(), bonds.moments(), system.length_scale(), least_borne());
  }

  double QuasiStaticPath::least_borne() const
  {
    constexpr double part = 1e-3; // of the most that was borne; below, a path has come to its end
    return part * most_borne;
  }

  bool QuasiStaticPath::attempt(const LinkStiffness stiffness, const double of_step)
  {
    const LoadedMotion    before = now;
    TangentSystem::Answer answer;
    ++solutions;
    bool done = system.solve(bonds.stiffness(stiffness), unbalanced, answer);
    if (done)
      {
        const Target target = choose(answer, of_step);
        done                = std::isfinite(target.strain);
        control             = target.control;
        if (done)
          {
            move(now, answer, target.strain - driven());
            restore(now);
            done = iterate(stiffness == LinkStiffness::onward ? LinkStiffness::consistent : stiffness, target);
          }
      }
    // What damage may grow at most holds for strain control as well: beyond, a step may have jumped over a peak.
    constexpr double more = 1.5;
    done                  = done && !(ends_exactly(*loaded) && strain_left() < 0);
    if (done && (control == StepControl::leading || bonds.largest_growth() <= more * parameters.growth_step))
      return true;
    restore(before);
    return false;
  }

  std::pair<double, double> QuasiStaticPath::steps_to(const double growth, const TangentSystem::Answer &answer) const
  {
    std::pair<double, double> steps{-infinity, infinity};
    for (std::size_t i = 0; i < bonds.size(); ++i)
      {
        const ElasticLink    &l    = loaded->network.links[i];
        const Eigen::Vector3d unit = l.direction / l.reference;
        const double          rate = unit.dot(slip_of(*loaded, i, answer.per_step));
        const double          way =
          (1 + growth) * bonds.reached(i) - bonds.normal_strain(i) - unit.dot(slip_of(*loaded, i, answer.constant));
        if (rate > 0)
          steps.second = std::min(steps.second, way / rate);
        else if (rate < 0)
          steps.first = std::max(steps.first, way / rate);
      }
    return steps;
  }

  QuasiStaticPath::Target QuasiStaticPath::choose_by_opening(const TangentSystem::Answer &answer,
                                                             const double                 of_step) const
  {
    // To the next multiple of the step, or a part of the way.
    constexpr double rounding = 1e-6;
    const double     step = parameters.leading->step, before = width(now) - width_before;
    const double     next = (std::floor(before / step + rounding) + 1) * step;
    Target           target{StepControl::leading, 0, 0, width_before + std::min(next, before + of_step * step)};
    target.strain = driven() + correction(target, answer);
    return target;
  }

  QuasiStaticPath::Target QuasiStaticPath::choose(const TangentSystem::Answer &answer, const double of_step) const
  {
    if (is_led())
      return choose_by_opening(answer, of_step);
    const double growth = of_step * parameters.growth_step, longest = of_step * parameters.strain_step;
    double       onward = 0; // growth of the links that grew last, per step of the driven strain
    for (std::size_t i = 0; i < bonds.size(); ++i)
      if (bonds.grew(i))
        onward += loaded->network.links[i].direction.dot(slip_of(*loaded, i, answer.per_step)) /
                  (loaded->network.links[i].reference * bonds.reached(i));
    const auto   steps     = steps_to(growth, answer);
    const double direction = onward == 0 ? parameters.sign : std::copysign(1.0, onward);
    const double step      = direction > 0 ? steps.second : steps.first;
    const double most      = ends_exactly(*loaded) ? std::min(longest, strain_left()) : longest;
    if (direction == parameters.sign && std::fabs(step) > most)
      {
        const double strain = driven() + direction * std::min(longest, strain_left());
        return {StepControl::strain, strain, growth};
      }
    // Back along the strain no further than forwards.
    return {StepControl::opening, std::fabs(step) <= longest ? driven() + step : infinity, growth};
  }

  double QuasiStaticPath::correction(const Target &target, const TangentSystem::Answer &answer) const
  {
    if (target.control == StepControl::strain)
      return target.strain - driven();
    if (target.control == StepControl::leading)
      return (target.width - width(now) - width(answer.constant)) / width(answer.per_step);
    const auto [below, above] = steps_to(target.growth, answer);
    if (below > above) // nowhere as small as required: where it is smallest
      return 0.5 * (below + above);
    return std::fabs(below) < std::fabs(above) ? below : above;
  }

  bool QuasiStaticPath::iterate(const LinkStiffness stiffness, const Target &target)
  {
    const int     most             = parameters.max_iterations * (stiffness == LinkStiffness::secant ? 3 : 1);
    constexpr int without_progress = 6;
    double        best             = infinity;
    int           best_at          = 0;
    for (attempt_length = 1; attempt_length <= most; ++attempt_length)
      {
        if (unbalanced.residual <= parameters.tolerance)
          return target.control != StepControl::opening || bonds.largest_growth() > 0;
        if (unbalanced.residual < 0.7 * best)
          {
            best    = unbalanced.residual;
            best_at = attempt_length;
          }
        if (!std::isfinite(unbalanced.residual) || attempt_length - best_at > without_progress)
          return false;
        TangentSystem::Answer answer;
        ++solutions;
        if (!system.solve(bonds.stiffness(stiffness), unbalanced, answer))
          return false;
        const double step = correction(target, answer);
        if (!std::isfinite(step) ||
            std::fabs(driven() + step - path.back().strain[loaded->driven]) > 4 * parameters.strain_step)
          return false;
        move(now, answer, step);
        restore(now);
      }
    return false;
  }

  /** @param onward step of the driven strain, over the largest one */
  void QuasiStaticPath::relax(const double onward)
  {
    LinkRelaxationParameters p = parameters.relaxation;
    p.tolerance                = parameters.tolerance;
    p.least_borne              = least_borne();
    bonds.forget_growth();
    const double               step = std::min(onward * parameters.strain_step, std::max(0.0, strain_left()));
    const LinkRelaxationReport report =
      relax_links(*loaded, bonds, now, parameters.sign * step * base::Vector6::Unit(loaded->driven), p);
    if (!report.converged)
      {
        std::ostringstream message;
        message << "quasi-static loading: no equilibrium at the strain " << driven() << " within " << report.steps
                << " steps of relaxation, residual " << report.residual
                << ". Raise the tolerance, or look for particles that nothing holds.";
        throw base::NumericalError(message.str());
      }
    restore(now);
    QuasiStaticPoint point;
    point.control          = StepControl::relaxed;
    point.relaxation_steps = report.steps;
    point.external_work    = path.back().external_work + report.external_work + work_of_dead_loads() - dead_load_work;
    point.damped           = path.back().damped + report.damped;
    complete(point);
  }

  void QuasiStaticPath::accept(const StepControl how)
  {
    bonds.forget_growth();
    bonds.commit();
    QuasiStaticPoint point;
    point.control = how;
    point.damped  = path.back().damped;
    restore(now); // as a restart would
    const double load_work_before = dead_load_work;
    complete(point);
    const QuasiStaticPoint &before = path[path.size() - 2];
    path.back().external_work =
      before.external_work + work_of_dead_loads() - load_work_before +
      0.5 * loaded->volume * (before.stress + path.back().stress).dot(path.back().strain - before.strain);
  }

  double QuasiStaticPath::work_of_dead_loads() const
  {
    double work = 0;
    if (loaded->body)
      work += loaded->body->work_of_loads(joints_of(*loaded, now), now.loads[loaded->body->load]);
    if (const auto &dead = loaded->dead)
      work += dead->work(now.particles, now.loads[dead->parameter], now.loads[dead->factor]);
    return work;
  }

  double QuasiStaticPath::stored() const
  {
    double energy = bonds.stored();
    if (loaded->body)
      energy += loaded->body->stored(joints_of(*loaded, now), now.loads[loaded->body->load]);
    if (const auto &dead = loaded->dead)
      energy += dead->stored(now.loads[dead->parameter], now.loads[dead->factor]);
    return energy;
  }

  void QuasiStaticPath::complete(QuasiStaticPoint &point)
  {
    point.strain      = now.loads;
    point.stress      = unbalanced.loads / loaded->volume;
    point.mean_damage = bonds.mean_damage();
    point.stored      = stored();
    point.damage      = bonds.damage_work();
    point.friction    = bonds.sliding_work();
    point.iterations  = solutions;
    point.residual    = unbalanced.residual;
    point.changed     = path.back().changed;
    dead_load_work    = work_of_dead_loads();
    most_borne        = std::max(most_borne, unbalanced.borne);
    path.push_back(point);
  }

  void QuasiStaticPath::visit_state(base::StateVisitor &visitor)
  {
    bonds.visit_state(visitor);
    now.visit_state(visitor);
    visitor.scalar("part", part);
    visitor.scalar("most_borne", most_borne);
    visitor.scalar("origin", origin);
    visitor.scalar("width_before", width_before);
    visit_points(visitor);
    system.visit_state(visitor);
    restore(now);
    dead_load_work = work_of_dead_loads();
  }

  void QuasiStaticPath::visit_points(base::StateVisitor &visitor)
  {
    constexpr std::size_t numbers = 23;
    base::Column          flat;
    for (const QuasiStaticPoint &p : path)
      {
        flat.insert(flat.end(), p.strain.data(), p.strain.data() + 6);
        flat.insert(flat.end(), p.stress.data(), p.stress.data() + 6);
        flat.insert(flat.end(),
                    {p.mean_damage, p.external_work, p.stored, p.damage, p.friction, p.damped, double(int(p.control)),
                     double(p.iterations), double(p.relaxation_steps), p.residual, p.changed});
      }
    visitor.column("points", flat);
    path.resize(flat.size() / numbers);
    for (std::size_t i = 0; i < path.size(); ++i)
      {
        const double     *v = &flat[numbers * i];
        QuasiStaticPoint &p = path[i];
        std::copy_n(v, 6, p.strain.data());
        std::copy_n(v + 6, 6, p.stress.data());
        std::tie(p.mean_damage, p.external_work, p.stored, p.damage, p.friction, p.damped) =
          std::tie(v[12], v[13], v[14], v[15], v[16], v[17]);
        p.control          = static_cast<StepControl>(static_cast<int>(v[18]));
        p.iterations       = static_cast<int>(v[19]);
        p.relaxation_steps = static_cast<std::int64_t>(v[20]);
        p.residual         = v[21];
        p.changed          = v[22];
      }
  }
} // namespace dem

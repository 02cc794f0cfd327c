#include "dem/genesis/genesis.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/genesis/cages.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr double       first_scale   = 0.5;
    constexpr std::int64_t piece         = 25;  ///< steps between two checks
    constexpr std::int64_t calming       = 100; ///< steps between two stops while overlaps are large
    constexpr double       large_overlap = 0.1;
    /** While fewer contacts than particles push nothing can be jammed: an increment is over when they have moved apart. */
    constexpr double loose_overlap         = 0.01;
    constexpr double longest_stress_change = 0.01; ///< of radii in one round
    constexpr double relief                = 0.25; ///< of the stress that a round from far above leaves
    constexpr double far_above             = 10;   ///< the target stress: rounds need not end at rest
    constexpr double enlargement           = 1.3;  ///< of floaters in one round

    void require(const bool fulfilled, const char *what, const double value, const char *rule)
    {
      if (!fulfilled)
        throw base::InputError(std::string("Genesis: ") + what + " = " + base::number_text(value) + ": " + rule);
    }

    double solid_of(const Packing &packing, const int dimension)
    {
      double sum = 0;
      for (const double r : packing.radius)
        sum += dimension == 2 ? M_PI * r * r : 4.0 / 3.0 * M_PI * r * r * r;
      return sum;
    }
  } // namespace

  void GenesisParameters::check() const
  {
    vessel.check();
    if (radii.empty())
      throw base::InputError("Genesis: there is no particle. Check sizes and vessel: metres.");
    require(growth_friction >= 0, "growth friction", growth_friction, "must not be negative.");
    require(increments > 0, "increments", static_cast<double>(increments), "must be above 0.");
    require(increment_ratio > 0, "increment ratio", increment_ratio, "must be above 0.");
    require(ratio > 0, "ratio", ratio, "must be above 0.");
    require(increment_steps > 0, "increment steps", static_cast<double>(increment_steps), "must be above 0.");
    require(solve_steps > 0, "solve steps", static_cast<double>(solve_steps), "must be above 0.");
    require(stress >= 0, "stress", stress, "must not be negative; 0 leaves the radii as they are.");
    require(stress < material.contact.effective_modulus, "stress", stress, "must be far below the modulus.");
    require(stress_tolerance > 0, "stress tolerance", stress_tolerance, "must be above 0.");
    require(material.damping >= 0 && material.damping < 1, "damping", material.damping, "must be in [0, 1).");
    require(vessel.dimension == 3 || material.thickness > 0, "thickness", material.thickness, "must be above 0 m.");
  }

  std::string name_of(const GenesisStage stage)
  {
    switch (stage)
      {
      case GenesisStage::growth:
        return "growth";
      case GenesisStage::settling:
        return "settling";
      case GenesisStage::stress:
        return "stress";
      case GenesisStage::floaters:
        return "floaters";
      default:
        return "done";
      }
  }

  Genesis::Genesis(const GenesisParameters &p, std::shared_ptr<Ranks> ranks, const std::int64_t move_every)
    : parameters(p)
  {
    p.check();
    std::vector<double> half = p.radii;
    for (double &r : half)
      r *= first_scale;
    const Insertion made = insert_at_random(p.vessel, half, p.seed);
    overlapping          = made.overlaps;
    requested            = made.packing.radius;
    for (double &r : requested)
      r /= first_scale;
    longest_change = longest_stress_change;
    assembly       = std::make_unique<GrowingAssembly>(made.packing, p.vessel, p.material);
    assembly->set_friction(p.growth_friction);
    if (ranks)
      assembly->share_among(std::move(ranks), move_every);
  }

  void Genesis::advance(const std::int64_t steps)
  {
    const std::int64_t end = assembly->steps() + steps;
    while (!finished() && assembly->steps() < end)
      take_piece();
  }

  void Genesis::take_piece()
  {
    assembly->advance(piece);
    steps_in_round += piece;
    last = assembly->measure();
    if (!std::isfinite(last.kinetic) || !std::isfinite(last.stored))
      throw base::NumericalError("Genesis, " + name_of(stage) + ": the state is no longer a number.");
    switch (stage)
      {
      case GenesisStage::growth:
        return grow_on(last);
      case GenesisStage::settling:
        return settle(last);
      default:
        return approach_stress(last);
      }
  }

  void Genesis::scale_all(const double factor)
  {
    std::vector<double> radii(requested.size());
    for (std::size_t i = 0; i < radii.size(); ++i)
      radii[i] = factor * assembly->radius(i);
    scale *= factor;
    assembly->set_radii(radii);
    steps_in_round = 0;
  }

  void Genesis::grow_on(const GrowthMeasures &m)
  {
    const bool loose = m.touching < static_cast<std::int64_t>(requested.size());
    const bool over  = m.touching == 0 || m.ratio <= parameters.increment_ratio ||
                      (loose && m.largest_overlap < loose_overlap) || steps_in_round >= parameters.increment_steps;
    if (!over)
      {
        if (steps_in_round % calming == 0 && m.largest_overlap > large_overlap)
          assembly->stop();
        return;
      }
    if (++round > parameters.increments)
      {
        enter(GenesisStage::settling, m, true);
        return assembly->set_friction(parameters.material.contact.friction_coefficient);
      }
    const double wanted =
      first_scale + (1 - first_scale) * static_cast<double>(round) / static_cast<double>(parameters.increments);
    scale_all(wanted / scale);
  }

  bool Genesis::at_rest(const GrowthMeasures &m) const { return m.touching == 0 || m.ratio <= parameters.ratio; }

  void Genesis::settle(const GrowthMeasures &m)
  {
    if (!at_rest(m) && steps_in_round < parameters.solve_steps)
      return;
    if (parameters.stress > 0)
      enter(GenesisStage::stress, m, at_rest(m));
    else
      enter_floaters(m, at_rest(m));
  }

  void Genesis::enter_floaters(const GrowthMeasures &m, const bool reached)
  {
    const bool fits_them =
      parameters.fit_floaters && floaters_of(assembly->contact_numbers()) > parameters.floaters_allowed;
    enter(fits_them ? GenesisStage::floaters : GenesisStage::done, m, reached);
    if (fits_them)
      fit_floaters();
  }

  /**
   * Whether the stress of this round is determined: nearly at rest where it is far above or too low, where rest would only show more of it;
   * more at rest the nearer it is. Particles that are not jammed fly about and come to no such ratio: of these it is enough to know that
   * they do not push.
   */
  bool Genesis::round_is_over(const GrowthMeasures &m) const
  {
    if (parameters.stress == 0)
      return at_rest(m) || steps_in_round >= parameters.solve_steps;
    const double pressure = -m.stress / parameters.stress;
    const double nearly   = std::sqrt(parameters.ratio * parameters.increment_ratio);
    const double enough   = pressure > far_above || pressure < 0.5               ? nearly :
                            std::abs(pressure - 1) > parameters.stress_tolerance ? std::sqrt(parameters.ratio * nearly) :
                                                                                   parameters.ratio;
    const bool   loose    = m.touching < static_cast<std::int64_t>(requested.size()) && pressure < 0.5;
    return m.touching == 0 || m.ratio <= enough ||
           steps_in_round >= (loose ? parameters.increment_steps : parameters.solve_steps);
  }

  void Genesis::change_stress(const GrowthMeasures &m)
  {
    // From far above in a few even ratios: what has come loose once takes long to jam again.
    const bool   far     = -m.stress > far_above * parameters.stress;
    const double aim     = std::max(parameters.stress, (far ? relief : std::sqrt(relief)) * -m.stress);
    const double missing = parameters.stress + m.stress;
    // Assemblies answer softer than their contacts taken one by one, so by what the last round has shown, within reason.
    constexpr double softest = 0.25;
    const double     shown   = last_change == 0 ? m.stress_by_growth : (last_missing - missing) / last_change;
    const double     slope   = std::clamp(shown, softest * m.stress_by_growth, m.stress_by_growth);
    // Past the stress and back: shorter ways.
    longest_change =
      last_missing * missing < 0 ? 0.5 * longest_change : std::min(1.5 * longest_change, longest_stress_change);
    const double wanted = m.touching > 0 ? (aim + m.stress) / slope : longest_change;
    last_missing        = missing;
    last_change         = std::clamp(wanted, -longest_change, longest_change);
    ++round;
    steps_in_round = 0;
    scale *= 1 + last_change;
    assembly->scale_radii(1 + last_change);
  }

  void Genesis::approach_stress(const GrowthMeasures &m)
  {
    if (!round_is_over(m))
      return;
    const bool unstressed = parameters.stress == 0; // radii of floaters have been fitted, and stay as they are
    const bool there      = at_rest(m) && (unstressed || std::abs(parameters.stress + m.stress) <=
                                                      parameters.stress_tolerance * parameters.stress);
    if (!there && !unstressed && round < parameters.stress_rounds)
      return change_stress(m);
    if (stage == GenesisStage::stress)
      return enter_floaters(m, there);
    const bool few = floaters_of(assembly->contact_numbers()) <= parameters.floaters_allowed;
    if (few || fits >= parameters.floater_rounds)
      return enter(GenesisStage::done, m, there && few);
    begin_rounds();
    fit_floaters();
  }

  void Genesis::begin_rounds()
  {
    longest_change = longest_stress_change;
    last_missing   = 0;
    last_change    = 0;
    round          = 0;
    steps_in_round = 0;
  }

  void Genesis::enter(const GenesisStage next, const GrowthMeasures &m, const bool reached)
  {
    const std::vector<int> contacts = assembly->contact_numbers();
    GenesisStageReport     report;
    report.stage           = stage;
    report.reached         = reached;
    report.steps           = assembly->steps() - steps_before_stage;
    report.rounds          = stage == GenesisStage::floaters ? fits : round;
    report.ratio           = m.ratio;
    report.porosity        = porosity();
    report.stress          = m.stress;
    report.floaters        = floaters_of(contacts);
    report.largest_overlap = m.largest_overlap;
    report.scale           = scale;
    double ends = 0, radii = 0, wanted = 0;
    for (std::size_t i = 0; i < requested.size(); ++i)
      {
        ends += contacts[i];
        radii += assembly->radius(i);
        wanted += scale * requested[i];
      }
    report.contact_number  = ends / static_cast<double>(requested.size());
    report.diameter_change = radii / wanted - 1;
    finished_stages.push_back(report);
    stage              = next;
    steps_before_stage = assembly->steps();
    begin_rounds();
  }

  double Genesis::porosity() const
  {
    return 1 - solid_of(assembly->packing(), parameters.vessel.dimension) / parameters.vessel.space();
  }

  double Genesis::floaters_of(const std::vector<int> &contacts) const
  {
    const auto floaters =
      std::count_if(contacts.begin(), contacts.end(), [&](const int n) { return n < parameters.floater_contacts; });
    return static_cast<double>(floaters) / static_cast<double>(contacts.size());
  }

  void Genesis::fit_floaters()
  {
    ++fits;
    const std::vector<int>    contacts = assembly->contact_numbers();
    const std::vector<double> overlaps = assembly->overlap_sums();
    const auto is_floater              = [&](const std::size_t i) { return contacts[i] < parameters.floater_contacts; };
    double     overlap = 0, ends = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (!is_floater(i))
        {
          overlap += overlaps[i];
          ends += contacts[i];
        }
    const double common = ends > 0 ? overlap / ends : 0.0;
    Packing      now    = assembly->packing();
    // Each time less deep: later ones need no force any more, only to touch, and what stress they bring takes others their contacts.
    fit_into_cages(now, parameters.vessel, is_floater, enlargement, common / static_cast<double>(fits));
    assembly->set_radii(now.radius, now.centre);
  }

  double Genesis::done() const
  {
    const auto part = [&](const std::int64_t most) {
      return std::min(1.0, static_cast<double>(round) / static_cast<double>(std::max<std::int64_t>(most, 1)));
    };
    switch (stage)
      {
      case GenesisStage::growth: // denser ones take longer
        return 0.5 * std::pow(part(parameters.increments), 1.5);
      case GenesisStage::settling:
        return 0.5;
      case GenesisStage::stress:
        return 0.55 + 0.2 * part(parameters.stress_rounds);
      case GenesisStage::floaters:
        return 0.75 +
               0.25 * std::min(1.0, static_cast<double>(fits) / static_cast<double>(parameters.floater_rounds + 1));
      default:
        return 1;
      }
  }

  std::string Genesis::details() const
  {
    std::ostringstream text;
    text.precision(3);
    text << name_of(stage) << ", round " << round << ", " << assembly->steps() << " steps, unbalanced ratio "
         << last.ratio << ", mean stress " << 1e-6 * last.stress << " MPa";
    return text.str();
  }

  void Genesis::visit_state(base::StateVisitor &visitor)
  {
    assembly->visit_state(visitor);
    auto at = static_cast<std::int64_t>(stage);
    visitor.scalar("genesis/stage", at);
    stage = static_cast<GenesisStage>(at);
    visitor.scalar("genesis/last_change", last_change);
    visitor.scalar("genesis/round", round);
    visitor.scalar("genesis/steps_in_round", steps_in_round);
    visitor.scalar("genesis/steps_before_stage", steps_before_stage);
    visitor.scalar("genesis/scale", scale);
    visitor.scalar("genesis/longest_change", longest_change);
    visitor.scalar("genesis/last_missing", last_missing);
    visitor.scalar("genesis/fits", fits);
    constexpr std::size_t numbers = 12;
    base::Column          table;
    for (const GenesisStageReport &r : finished_stages)
      table.insert(table.end(), {static_cast<double>(r.stage), r.reached ? 1.0 : 0.0, static_cast<double>(r.steps),
                                 static_cast<double>(r.rounds), r.ratio, r.porosity, r.stress, r.floaters,
                                 r.contact_number, r.largest_overlap, r.diameter_change, r.scale});
    visitor.column("genesis/reports", table);
    finished_stages.clear();
    for (std::size_t i = 0; i + numbers <= table.size(); i += numbers)
      {
        const double *t = &table[i];
        finished_stages.push_back({static_cast<GenesisStage>(static_cast<std::int64_t>(t[0])), t[1] != 0,
                                   static_cast<std::int64_t>(t[2]), static_cast<std::int64_t>(t[3]), t[4], t[5], t[6],
                                   t[7], t[8], t[9], t[10], t[11]});
      }
  }
} // namespace dem

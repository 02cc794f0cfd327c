#include "apps/runs/peridynamics/analysis.h"

#include "apps/runs/peridynamics/motion.h"
#include "apps/runs/peridynamics/rest.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace pd = dem::peridynamics;

  PeridynamicBody::PeridynamicBody(const PeridynamicsModel &model)
    : bonds(model.bonds())
    , loads(model.loads.on(bonds, model.analysis.quiet()))
  {
    if (!model.analysis.quiet())
      return;
    pd::Field acting = bonds.grid().field();
    loads.act.forces(1.0, nullptr, acting);
    const pd::RigidMotions rigid = pd::hold_rigid_motions(bonds, loads.act.held, acting);
    if (rigid.imbalance > 1e-10)
      throw base::InputError(fmt::format("Tractions: do not balance on a body, or on a piece of {} nodes, that nothing "
                                         "holds against them: {:.3g} of their sum is left. "
                                         "Balance them, or hold the body in Displacements.",
                                         rigid.loose, rigid.imbalance));
  }

  double PeridynamicBody::largest_damage() const
  {
    const std::vector<double> damage = bonds.damage();
    return *std::max_element(damage.begin(), damage.end());
  }

  std::string PeridynamicBody::size() const
  {
    return fmt::format("{} nodes, {} bonds", bonds.grid().nodes().size(), bonds.count());
  }

  void FirstBreak::note(const double factor, const double of_limit)
  {
    if (found > 0)
      return;
    if (of_limit >= 1)
      found = before_factor + (factor - before_factor) * (1 - before) / (of_limit - before);
    before_factor = factor;
    before        = of_limit;
  }

  std::optional<double> FirstBreak::factor() const
  {
    if (found > 0)
      return found;
    return before > 0 ? std::optional<double>(before_factor / before) : std::nullopt;
  }

  void FirstBreak::visit_state(RunState &state)
  {
    state.scalar("before_factor", before_factor);
    state.scalar("before", before);
    state.scalar("found", found);
  }

  std::unique_ptr<PeridynamicAnalysis> make_analysis(const PeridynamicsModel &model, PeridynamicBody &body)
  {
    switch (model.analysis.method)
      {
      case PeridynamicAnalysisSection::Method::relaxation:
        return std::make_unique<PeridynamicRelaxation>(model, body);
      case PeridynamicAnalysisSection::Method::statics:
        return std::make_unique<PeridynamicStatics>(model, body);
      default:
        return std::make_unique<PeridynamicMotion>(model, body);
      }
  }
} // namespace apps

#include "apps/runs/continuum/moving_solid.h"

#include "apps/runs/continuum/motion.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/solid.h"
#include "base/entry_path.h"
#include "base/errors.h"
#include "coupling/participants/solid_participant.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    template <int dim>
    class Moving : public MovingSolid
    {
    public:
      explicit Moving(const ContinuumModel &model)
        : solid(make_solid<dim>(model))
        , motion(make_motion(*solid, model))
        , participant(*solid, *motion)
        , own_nodes(nodes_of(*solid, *motion, participant))
        , probes(*solid, model)
        , follows(model.solid.large_displacement)
        , length(model.motion.end_time / static_cast<double>(steps_of(model.motion, motion->step())))
      {
      }

      SolidNodes       &nodes() override { return *own_nodes; }
      const SolidNodes &nodes() const override { return *own_nodes; }
      double            longest_step() const override { return motion->step(); }
      double            time() const override { return motion->time(); }
      void              clear_forces() override { motion->clear_forces(); }

      double next_step(const double rest) const override
      {
        constexpr double rounding = 1e-9; // of sums of steps
        if (follows)
          return step_towards(rest, motion->step());
        return rest > length * (1 - rounding) ? length : rest;
      }

      void advance(const double step) override
      {
        constexpr double rounding = 1e-12;
        if (!(step > 0 && step <= motion->step() * (1 + rounding)))
          throw base::InputError(
            fmt::format("time step = {:g} s: must be above 0, and is stable up to {:g} s now.", step, motion->step()));
        try
          {
            motion->advance(step);
          }
        catch (const fem::MaterialFailure &failure)
          {
            throw base::NumericalError(failure.what());
          }
        if (const std::string invalid = solid->end_of_validity(); !invalid.empty())
          throw base::NumericalError(invalid);
      }

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        std::vector<postprocess::SeriesColumn> all;
        for (const ProbeColumn &probe : probes.columns())
          all.push_back(probe.column);
        for (const char *term : {"kinetic", "damped", "start", "external", "internal", "residual"})
          all.push_back({std::string("energy_") + term, "J"});
        all.push_back({"energy_balance_error", "-"});
        return all;
      }

      std::vector<double> row() const override
      {
        const fem::ExplicitEnergy e      = motion->energy();
        ContinuumEnergy           energy = energy_of(e);
        std::vector<double>       values =
          probes.read({&motion->displacement(), &motion->internal_force(), &motion->external_force()}, energy);
        values.insert(values.end(), {e.kinetic, e.damped, e.start, e.external, e.internal, energy.residual(),
                                     energy.balance_error()});
        return values;
      }

    private:
      std::unique_ptr<fem::Solid<dim>>          solid;
      std::unique_ptr<fem::ExplicitSolver<dim>> motion;
      coupling::SolidParticipant<dim>           participant;
      std::unique_ptr<SolidNodes>               own_nodes;
      ContinuumProbes<dim>                      probes;
      bool                                      follows; ///< the step, the deformation
      double                                    length;  ///< of a step where it does not [s]
    };
  } // namespace

  std::unique_ptr<MovingSolid> make_moving_solid(const ContinuumModel &model)
  {
    if (model.is_static())
      throw base::EntryError({"Model"}, "Analysis", "only a solid in motion is advanced step by step: explicit.");
    if (model.precice.given())
      throw base::EntryError({"preCICE"}, "Participant",
                             "a solid that is moved step by step is coupled by the program that moves it.");
    if (!model.contacts.empty())
      throw base::EntryError({"Contacts"}, "",
                             "bodies in contact with each other are moved by a run alone, not step by step.");
    if (!model.motion.rigid.empty())
      throw base::EntryError({"Motion"}, "Rigid bodies", "bodies that do not deform are moved by a run alone.");
    if (model.solid.dimension == 2)
      return std::make_unique<Moving<2>>(model);
    return std::make_unique<Moving<3>>(model);
  }
} // namespace apps

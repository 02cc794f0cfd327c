#include "apps/runs/continuum/motion_analysis.h"

namespace apps
{
  namespace
  {
    template <int dim>
    class ExplicitAnalysis : public MotionAnalysis<dim>
    {
      using MotionAnalysis<dim>::solver;
      using MotionAnalysis<dim>::steps;

    public:
      ExplicitAnalysis(fem::Solid<dim> &moved, const ContinuumModel &model)
        : MotionAnalysis<dim>(moved, model)
        , steps_in_all(steps_of(model.motion, solver.step()))
        , length(model.motion.end_time / static_cast<double>(steps_in_all))
        , steps_per_sample(std::max<std::int64_t>(1, steps_in_all / model.output.samples))
        , follows(model.solid.large_displacement)
        , samples_in_all(model.output.samples)
        , end_time(model.motion.end_time)
      {
      }

      bool finished() const override { return follows ? samples >= samples_in_all : steps >= steps_in_all; }

      bool advance() override
      {
        if (follows)
          return advance_by_deformation();
        const std::int64_t sample = std::min((steps / steps_per_sample + 1) * steps_per_sample, steps_in_all);
        return this->take_steps([&] {
          solver.advance(length);
          return steps + 1 == sample;
        });
      }

      double coordinate() const override { return follows ? solver.time() : length * static_cast<double>(steps); }

      void visit_state(base::StateVisitor &visitor) override
      {
        MotionAnalysis<dim>::visit_state(visitor);
        if (follows)
          visitor.scalar("samples", samples);
      }

    private:
      double step() const override { return follows ? solver.step() : length; }

      /** To the next sample, in steps as long as the elements allow as they are deformed. */
      bool advance_by_deformation()
      {
        constexpr double rounding = 1e-12;
        const double     sample   = end_time * (static_cast<double>(samples + 1) / static_cast<double>(samples_in_all));
        const bool       there    = this->take_steps([&] {
          solver.advance(step_towards(sample - solver.time(), solver.step()));
          return solver.time() >= sample * (1 - rounding);
        });
        samples += there ? 1 : 0;
        return there;
      }

      std::int64_t steps_in_all;
      double       length;
      std::int64_t steps_per_sample;
      bool         follows; ///< the step, the deformation
      std::int64_t samples_in_all, samples = 0;
      double       end_time;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    if (model.precice.given())
      return make_precice_analysis(solid, model);
    if (!model.contacts.empty() || !model.motion.rigid.empty())
      return make_contact_analysis(solid, model);
    return std::make_unique<ExplicitAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_explicit_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_explicit_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps

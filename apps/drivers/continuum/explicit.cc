#include "apps/drivers/continuum/motion_analysis.h"

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
        , steps_in_all(this->count_steps(solver.step()))
        , length(model.motion.end_time / static_cast<double>(steps_in_all))
        , steps_per_sample(std::max<std::int64_t>(1, steps_in_all / model.output.samples))
      {
      }

      bool finished() const override { return steps >= steps_in_all; }

      bool advance() override
      {
        const std::int64_t sample = std::min((steps / steps_per_sample + 1) * steps_per_sample, steps_in_all);
        return this->take_steps([&] {
          solver.advance(length);
          return steps + 1 == sample;
        });
      }

      double coordinate() const override { return length * static_cast<double>(steps); }

    private:
      double step() const override { return length; }

      std::int64_t steps_in_all;
      double       length;
      std::int64_t steps_per_sample;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    if (!model.contacts.empty() || !model.motion.rigid.empty())
      return make_contact_analysis(solid, model);
    return std::make_unique<ExplicitAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_explicit_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_explicit_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps

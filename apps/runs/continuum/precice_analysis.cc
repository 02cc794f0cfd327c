#include "apps/runs/continuum/motion_analysis.h"
#include "base/entry_path.h"
#include "coupling/participants/solid_participant.h"
#include "coupling/participants/window.h"

namespace apps
{
  namespace
  {
    /** A solid that counts the steps it takes. */
    template <int dim>
    class CountingParticipant : public coupling::SolidParticipant<dim>
    {
    public:
      CountingParticipant(fem::Solid<dim> &solid, fem::ExplicitSolver<dim> &motion_, std::int64_t &steps_)
        : coupling::SolidParticipant<dim>(solid, motion_)
        , motion(motion_)
        , steps(steps_)
      {
      }

      void advance(const double window, const int at_least) override
      {
        coupling::walk_window(*this, window, at_least, [&](const double step) {
          motion.advance(step);
          ++steps;
        });
        motion.clear_forces();
      }

    private:
      fem::ExplicitSolver<dim> &motion;
      std::int64_t             &steps;
    };

    /** A solid in motion beside other programs: from time window to time window of preCICE. */
    template <int dim>
    class PreciceAnalysis : public MotionAnalysis<dim>
    {
      using MotionAnalysis<dim>::solver;
      using MotionAnalysis<dim>::motion;

    public:
      PreciceAnalysis(fem::Solid<dim> &moved, const ContinuumModel &what)
        : MotionAnalysis<dim>(moved, what)
        , model(what)
        , participant(moved, solver, this->steps)
        , exchange(model.precice.couple(participant, vertices(moved)))
      {
      }

      bool finished() const override { return exchange->is_over() || samples >= model.output.samples; }

      double coordinate() const override { return solver.time(); }

      bool advance() override
      {
        constexpr double      rounding = 1e-12;
        const double          apart    = motion.end_time / static_cast<double>(model.output.samples);
        const base::Stopwatch watch;
        exchange->advance();
        this->seconds += watch.seconds();
        const auto passed =
          static_cast<std::int64_t>(solver.time() / apart * (1 + rounding)); // a window may hold several
        const bool there = exchange->is_over() || passed > samples;
        samples          = passed;
        return there;
      }

      std::map<std::string, double> cost() const override
      {
        std::map<std::string, double> all = MotionAnalysis<dim>::cost();
        all["windows"]                    = static_cast<double>(exchange->windows());
        all["iterations"]                 = static_cast<double>(exchange->iterations());
        return all;
      }

      std::string ended_by() const override { return exchange->is_over() ? "coupling" : ""; }
      std::string warning() const override { return model.precice.left_early(*exchange, solver.time()); }

      void visit_state(base::StateVisitor &visitor) override
      {
        MotionAnalysis<dim>::visit_state(visitor);
        exchange->visit_state(visitor);
        visitor.scalar("samples", samples);
      }

    private:
      double step() const override { return solver.step(); }

      /** Nodes of the boundary. @throws base::InputError where the scene itself prescribes the motion of driven ones */
      std::vector<std::size_t> vertices(const fem::Solid<dim> &solid) const
      {
        std::vector<std::size_t> found;
        const bool               driven = model.precice.reads.force.empty();
        for (const auto first : solid.boundary_dofs(model.precice.vertices, 0))
          {
            found.push_back(participant.carrier_of(first));
            for (const auto dof : participant.displacements(found.back()))
              if (driven && solid.constraints().is_constrained(dof))
                throw base::EntryError({"preCICE"}, "Boundary",
                                       model.precice.vertices + " has nodes whose displacement the scene prescribes: "
                                                                "they cannot be driven by another program as well.");
          }
        std::sort(found.begin(), found.end());
        return found;
      }

      const ContinuumModel                      &model;
      CountingParticipant<dim>                   participant;
      std::unique_ptr<coupling::PreciceExchange> exchange;
      std::int64_t                               samples = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_precice_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    return std::make_unique<PreciceAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_precice_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_precice_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps

#include "apps/runs/continuum/contacts.h"
#include "apps/runs/continuum/motion_analysis.h"
#include "coupling/contact/contact_motion.h"

namespace apps
{
  namespace
  {
    template <int dim>
    class ContactAnalysis : public MotionAnalysis<dim>
    {
      using MotionAnalysis<dim>::solver;
      using MotionAnalysis<dim>::motion;

    public:
      ContactAnalysis(fem::Solid<dim> &moved, const ContinuumModel &what)
        : MotionAnalysis<dim>(moved, what)
        , model(what)
        , participant(moved, solver)
        , bodies(moved, solver, participant, what.motion.rigid)
        , contacts(what.contacts, bodies.contacts())
      {
        steps_of(motion, bodies.step()); // refuses too many
      }

      bool   finished() const override { return samples >= model.output.samples; }
      double coordinate() const override { return solver.time(); }

      bool advance() override
      {
        constexpr double rounding = 1e-12;
        const double     sample =
          motion.end_time * (static_cast<double>(samples + 1) / static_cast<double>(model.output.samples));
        const bool there = this->take_steps([&] {
          bodies.advance(sample - solver.time());
          contacts.note(figures, solver.time());
          return solver.time() >= sample * (1 - rounding);
        });
        if (there)
          {
            ++samples;
            largest_energy = std::max(largest_energy, energy().largest());
            contacts.require_balance(largest_energy, solver.time());
          }
        return there;
      }

      ContinuumEnergy energy() const override
      {
        ContinuumEnergy       all  = MotionAnalysis<dim>::energy();
        const ContactEnergies held = contacts.energies();
        all.external -= held.work;
        all.contacts = held.held;
        return all;
      }

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        std::vector<postprocess::SeriesColumn> all = MotionAnalysis<dim>::columns();
        for (const auto &more : {contacts.force_columns(), contacts.columns()})
          all.insert(all.end(), more.begin(), more.end());
        for (const char *quantity : {"momentum_", "angular_momentum_"})
          for (const char axis : {'x', 'y', 'z'})
            all.push_back({std::string(quantity) + axis, quantity[0] == 'm' ? "N s" : "N m s"});
        return all;
      }

      std::vector<double> values() const override
      {
        std::vector<double> all = MotionAnalysis<dim>::values();
        for (const auto &more : {contacts.forces(), contacts.values()})
          all.insert(all.end(), more.begin(), more.end());
        const coupling::Momentum now = coupling::momentum_of(participant);
        for (const Eigen::Vector3d &each : {now.linear, now.angular})
          all.insert(all.end(), each.data(), each.data() + 3);
        return all;
      }

      const ContactFigures *contact_figures() const override { return model.contacts.empty() ? nullptr : &figures; }

      void visit_state(base::StateVisitor &visitor) override
      {
        MotionAnalysis<dim>::visit_state(visitor);
        bodies.visit_state(visitor);
        figures.visit_state(visitor);
        visitor.scalar("samples", samples);
        visitor.scalar("largest_energy", largest_energy);
      }

    private:
      double step() const override { return bodies.step(); }

      const ContinuumModel           &model;
      coupling::SolidParticipant<dim> participant;
      coupling::ContactMotion<dim>    bodies;
      ObservedContacts<dim>           contacts;
      ContactFigures                  figures;
      std::int64_t                    samples        = 0;
      double                          largest_energy = 0; ///< at any sample so far [J]
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_contact_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    return std::make_unique<ContactAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_contact_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_contact_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps

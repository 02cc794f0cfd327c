#include "apps/runs/coupled/body.h"

#include "apps/process/mpi_session.h"
#include "apps/results/run_work.h"
#include "apps/runs/continuum/contacts.h"
#include "apps/runs/continuum/motion.h"
#include "apps/runs/continuum/picture.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/snapshot.h"
#include "apps/runs/continuum/solid.h"
#include "apps/runs/coupled/energy_watch.h"
#include "apps/runs/coupled/pictures.h"
#include "apps/runs/coupled/placed_handshakes.h"
#include "apps/runs/coupled/series.h"
#include "apps/runs/coupled/taken_places.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "dem/facets/surface.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace apps
{
  using Eigen::Vector3d;

  namespace
  {
    template <int dim>
    class Body : public CoupledBody
    {
    public:
      Body(const CoupledModel &what, const dem::Packing &packing, const ParticleMedia &known)
        : model(what)
        , material_names(packing.material_names)
        , body(what.particles, packing)
        , solid(make_solid<dim>(what.continuum, taken_by(what.handshakes)))
        , motion(make_motion(*solid, what.continuum, what.particles.gravity.acceleration))
        , participant(*solid, *motion)
        , both(
            body.specimen(), *solid, *motion, participant, [this] { drive(); }, what.continuum.motion.rigid)
        , handshakes(*solid, *motion, known)
        , own_nodes(nodes_of(*solid, *motion, participant))
        , touching(what.continuum.contacts, both.contacts())
        , probes(*solid, what.continuum)
        , series({what, body, *motion, participant, both, touching, probes})
        , energies(what, both, touching)
      {
        both.set_drive_of_solid([this] {
          for (const auto &[node, force] : outside.nodes)
            participant.add_force(node, force);
        });
        both.set_largest_ratio(static_cast<int>(what.largest_ratio));
        both.set_sub_cycling_loss(what.sub_cycling_loss);
        if (what.checked_windows)
          both.check_windows([this](base::StateVisitor &visitor) { body.visit_drive_state(visitor); });
        for (const HandshakeSection &handshake : model.handshakes.handshakes)
          {
            coupling::VolumeCouplingParameters made = handshakes.place(handshake, body.specimen());
            made.others                             = model.handshakes.others_of(handshake);
            both.add_volume(made);
          }
        std::vector<std::string> boundaries;
        for (const auto &boundary : solid->mesh().boundaries)
          boundaries.push_back(boundary.first);
        model.refuse_unknown_boundaries(boundaries);
        for (const CouplingSection &coupling : model.couplings.couplings)
          both.add_surface({coupling.name,
                            coupling.boundaries,
                            coupling.contact.materials(),
                            coupling.pressure,
                            coupling.skin,
                            coupling.particles(body.all_groups()),
                            {coupling.bond.within, coupling.bond.links(what.particles.physics)},
                            coupling.spreading});
        model.couplings.refuse_shared(body.all_groups(), [this](const std::string &a, const std::string &b) {
          return solid->mesh().boundary(a) == solid->mesh().boundary(b);
        });
        model.check_columns(columns(), reported());
      }

      StaticStart start() override
      {
        const StaticStart found = body.start();
        body.specimen().partners().find_surface_forces(); // refuses particles that lie in the solid
        return found;
      }

      void advance_to(const double end, const std::int64_t most) override
      {
        std::int64_t taken = 0;
        do
          step(end - time());
        while (++taken < most && time() < end * (1 - 1e-12) && !interrupted_on_any_rank());
      }

      void advance(const std::int64_t count) override
      {
        for (std::int64_t n = 0; n < count && time() < model.particles.end_time * (1 - 1e-12); ++n)
          step(model.particles.end_time - time());
      }

      std::vector<postprocess::SeriesColumn> columns() const override { return series.columns(); }
      std::vector<postprocess::SeriesColumn> reported() const override { return series.reported(); }

      std::vector<double> row() override
      {
        CoupledRow now = series.row(time());
        of_last_row    = now.energies;
        return std::move(now.values);
      }

      void watch() override { energies.update(of_last_row); }

      void push(const OutsideForces &forces) override
      {
        outside = forces;
        body.specimen().partners().clear_forces(); // the scene's are entered anew in every step
      }

      ParticlesBody       &particles() override { return body; }
      const ParticlesBody &particles() const override { return body; }
      SolidNodes          &nodes() override { return *own_nodes; }
      const SolidNodes    &nodes() const override { return *own_nodes; }
      double               time() const override { return motion->time(); }
      CoupledSteps         steps() const override
      {
        const coupling::WindowSteps next = both.next_window(model.particles.end_time);
        return {next.window, both.solid_step(), both.particle_step(), next.particles, next.solid};
      }
      std::size_t           elements() const override { return solid->mesh().triangulation->n_global_active_cells(); }
      std::size_t           unknowns() const override { return solid->dofs().n_dofs(); }
      std::int64_t          windows() const override { return window_count; }
      std::int64_t          windows_taken_back() const override { return both.taken_back(); }
      const ContactFigures &interface() const override { return figures; }

      double solid_mass_within(const double time) const override
      {
        double all = 0, fastest = 0, densest = 0;
        for (std::size_t i = 0; i < participant.carriers(); ++i)
          all += participant.mass(i);
        for (const auto &[group, number] : solid->mesh().materials)
          {
            const auto &d = solid->material(number).elastic_stiffness();
            fastest =
              std::max(fastest, d.template topLeftCorner<3, 3>().diagonal().maxCoeff() / motion->density(number));
            densest = std::max(densest, motion->density(number));
          }
        const double reach = std::sqrt(fastest) * time,
                     room  = dim == 3 ? 2.0 / 3 * M_PI * reach * reach * reach :
                                        0.5 * M_PI * reach * reach * solid->options().thickness;
        return std::min(all, densest * room);
      }

      std::string text_of_mismatch() const override { return handshakes.text_of_mismatch(); }
      std::string text_of_handshakes() const override { return handshakes.text(both.volumes()); }

      void write_solid(const std::filesystem::path &folder, const std::size_t number) override
      {
        fem::Vector reaction = motion->internal_force();
        reaction -= motion->external_force();
        reaction.update_ghost_values();
        write_whole_solid(*solid, motion->displacement(), reaction, {folder / "solid", "solid", number, time()});
      }

      std::vector<std::string> notes() const override { return solid->notes(); }
      std::vector<std::string> doubts() const override
      {
        std::vector<std::string> all = handshakes.doubts();
        for (const std::string &lost : energies.doubts())
          all.push_back(lost);
        return all;
      }
      std::string end_of_validity() const override { return solid->end_of_validity(); }

      std::string draw_promotion(const std::filesystem::path &file, const std::string &title) override
      {
        return apps::draw_promotion(*solid, motion->displacement(), file, title);
      }

      std::string draw_damage(const std::filesystem::path &file, const std::string &title) override
      {
        return apps::draw_damage(*solid, motion->displacement(), file, title);
      }

      std::string draw(const std::filesystem::path &file,
                       const std::string           &title,
                       const dem::ParticleOutput   &particles) const override
      {
        return draw_solid_and_particles(*solid, motion->displacement(), particles, file, title);
      }

      std::string draw_cracks(const std::filesystem::path &file,
                              const std::string           &title,
                              const dem::ParticleOutput   &particles,
                              const dem::LinkOutput       &links) const override
      {
        return draw_cracks_in_solid(
          *solid, motion->displacement(),
          {particles, links, material_names,
           model.particles.mix.given() ? body.link_classes().of_pairs() : std::vector<std::string>()},
          file, fmt::format("{} at {:.3g} s", title, time()));
      }

      void visit_state(RunState &state) override
      {
        state.group("specimen");
        body.visit_state(state);
        state.group("solid");
        visit_motion(state, *motion, *solid);
        probes.visit_state(state);
        state.group("couplings");
        both.visit_state(state);
        figures.visit_state(state);
        energies.visit_state(state);
        state.scalar("windows", window_count);
      }

    private:
      /** What the particles' next step does, by the scene and from outside. */
      void drive()
      {
        if (!outside.particles.empty())
          body.specimen().partners().clear_forces();
        body.drive_next_step();
        for (const auto &[particle, push] : outside.particles)
          body.specimen().partners().add_force(particle, push.force, push.couple);
      }

      void step(const double rest)
      {
        const double at = body.specimen().time(); // of the forces that the step takes
        try
          {
            both.advance(rest);
          }
        catch (const fem::MaterialFailure &failure)
          {
            throw StoppedShort(failure.what());
          }
        ++window_count;
        touching.note(figures, motion->time());
        for (const auto &coupled : both.surfaces())
          {
            const dem::Surface &surface = body.specimen().surfaces().at(coupled->surface());
            if (surface.touching == 0 && surface.glued == 0)
              continue;
            figures.note(at, surface.total_force.norm());
          }
      }

      const CoupledModel                       &model;
      std::vector<std::string>                  material_names;
      ParticlesBody                             body;
      std::unique_ptr<fem::Solid<dim>>          solid;
      std::unique_ptr<fem::ExplicitSolver<dim>> motion;
      coupling::SolidParticipant<dim>           participant;
      coupling::ConcurrentMotion<dim>           both;
      PlacedHandshakes<dim>                     handshakes;
      std::unique_ptr<SolidNodes>               own_nodes;
      OutsideForces                             outside;
      ObservedContacts<dim>                     touching; ///< between bodies of the solid
      ContinuumProbes<dim>                      probes;
      CoupledSeries<dim>                        series;
      ContactFigures                            figures;
      CoupledEnergies                           of_last_row;
      EnergyWatch<dim>                          energies;
      std::int64_t                              window_count = 0;
    };
  } // namespace

  std::unique_ptr<CoupledBody>
  make_coupled_body(const CoupledModel &model, const dem::Packing &packing, const ParticleMedia &media)
  {
    give_media(model.continuum.materials, media);
    if (model.dimension() == 2)
      return std::make_unique<Body<2>>(model, packing, media);
    return std::make_unique<Body<3>>(model, packing, media);
  }
} // namespace apps

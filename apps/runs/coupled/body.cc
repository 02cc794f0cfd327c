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
#include "apps/runs/coupled/taken_places.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "coupling/volume/overlap_medium.h"
#include "dem/facets/surface.h"
#include "fem/mesh/point_in_space.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace apps
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr const char *axes[3] = {"_x", "_y", "_z"};

    /** Energy that different media reflect, beyond which a scene is doubted. */
    constexpr double largest_mismatch = 0.01;
    /** Of what an overlap should be wide, likewise: rounding apart. */
    constexpr double narrowest = 0.99;

    template <int dim>
    class Body : public CoupledBody
    {
    public:
      Body(const CoupledModel &what, const dem::Packing &packing, const ParticleMedia &known)
        : model(what)
        , media(known)
        , material_names(packing.material_names)
        , body(what.particles, packing)
        , solid(make_solid<dim>(what.continuum, taken_by(what.handshakes)))
        , motion(make_motion(*solid, what.continuum, what.particles.gravity.acceleration))
        , participant(*solid, *motion)
        , both(
            body.specimen(), *solid, *motion, participant, [this] { drive(); }, what.continuum.motion.rigid)
        , own_nodes(nodes_of(*solid, *motion, participant))
        , touching(what.continuum.contacts, both.contacts())
        , probes(*solid, what.continuum)
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
          add(handshake);
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
        model.check_columns(columns(), told());
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

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        std::vector<postprocess::SeriesColumn> all = {{"time", "s"}};
        const auto add = [&](const std::string &name, const char *unit) { all.push_back({name, unit}); };
        for (const postprocess::SeriesColumn &told_one : told())
          all.push_back(told_one);
        for (const char *count : {"links", "broken_links", "contacts"})
          add(count, "");
        for (const CouplingSection &coupling : model.couplings.couplings)
          {
            add(column_name(coupling.name) + "_contacts", "");
            if (coupling.bond.given())
              {
                add(column_name(coupling.name) + "_glued", "");
                add(column_name(coupling.name) + "_torn", "");
              }
            add(column_name(coupling.name) + "_work", "J");
            add(column_name(coupling.name) + "_spurious", "J");
            add(column_name(coupling.name) + "_spurious_of_contacts", "J");
          }
        for (const postprocess::SeriesColumn &column : touching.columns())
          all.push_back(column);
        for (const HandshakeSection &handshake : model.handshakes.handshakes)
          {
            add(column_name(handshake.name) + "_damaged", "");
            for (const char *term : {"_work", "_spurious", "_absorbed", "_double_counted"})
              add(column_name(handshake.name) + term, "J");
          }
        for (const char *quantity : {"momentum", "angular_momentum"})
          for (const char *axis : axes)
            add(std::string(quantity) + axis, quantity[0] == 'm' ? "N s" : "N m s");
        for (const char *term : {"kinetic", "internal", "external", "damped", "start"})
          add(std::string("energy_solid_") + term, "J");
        dem::EnergyAccount().each([&](const std::string &term, double) { add("energy_particles_" + term, "J"); });
        add("energy_residual", "J");
        return all;
      }

      std::vector<postprocess::SeriesColumn> told() const override
      {
        std::vector<postprocess::SeriesColumn> all;
        for (const ProbeColumn &probe : probes.columns())
          all.push_back(of_solid(probe));
        for (const ProbeSection &probe : model.particles.probes.probes)
          all.push_back({probe.name, probe.unit()});
        for (const CouplingSection &coupling : model.couplings.couplings)
          for (int d = 0; d < dim; ++d)
            all.push_back({column_name(coupling.name) + "_force" + axes[d], "N"});
        for (const postprocess::SeriesColumn &force : touching.force_columns())
          all.push_back(force);
        for (const postprocess::SeriesColumn &of_press : model.laboratory.columns())
          all.push_back(of_press);
        return all;
      }

      std::vector<double> row() const override
      {
        const dem::ObservedSpecimen &specimen = body.specimen();
        const fem::ExplicitEnergy    s        = motion->energy();
        const dem::EnergyAccount     p        = specimen.energy();
        std::vector<double>          values   = {time()};
        const auto      add = [&](const auto &list) { values.insert(values.end(), std::begin(list), std::end(list)); };
        ContinuumEnergy continuum;
        continuum.internal = s.internal;
        add(probes.read({&motion->displacement(), &motion->internal_force(), &motion->external_force()}, continuum));
        add(body.probes());
        for (const auto &surface : both.surfaces())
          for (int d = 0; d < dim; ++d)
            values.push_back(specimen.surfaces().at(surface->surface()).total_force[d]);
        add(touching.forces());
        add(model.laboratory.read(columns(), values));
        const dem::Counts counts = specimen.counts();
        add(std::initializer_list<double>{static_cast<double>(counts.links),
                                          static_cast<double>(counts.broken) + static_cast<double>(torn_glue()),
                                          static_cast<double>(counts.contacts + counts.wall_contacts)});
        double made     = touching.energies().spurious();
        auto   coupling = model.couplings.couplings.begin();
        for (const auto &surface : both.surfaces())
          {
            const coupling::SurfaceBalance balance = surface->balance();
            const dem::Surface            &touched = specimen.surfaces().at(surface->surface());
            values.push_back(static_cast<double>(touched.touching));
            if (coupling++->bond.given())
              add(std::initializer_list<double>{static_cast<double>(touched.glued), static_cast<double>(touched.torn)});
            add(std::initializer_list<double>{balance.work_on_solid, balance.spurious(), balance.contacts});
            made += balance.spurious(); // what contacts make, the residual of the particles shows already
          }
        add(touching.values());
        for (const auto &handshake : both.volumes())
          {
            const coupling::VolumeBalance &balance = handshake->balance();
            add(std::initializer_list<double>{static_cast<double>(handshake->damaged_bonds()), balance.work_on_solid,
                                              balance.spurious(), balance.absorbed, balance.double_counted});
            made += balance.spurious(); // what was absorbed is known, and no defect
          }
        const auto [linear, angular] = momentum();
        add(std::initializer_list<double>{linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]});
        add(std::initializer_list<double>{s.kinetic, s.internal, s.external, s.damped, s.start});
        p.each([&](const std::string_view, const double value) { values.push_back(value); });
        // What went into one side by the other is no energy from outside.
        values.push_back(s.external + s.start - s.kinetic - s.internal - s.damped + p.residual() - made);
        return values;
      }

      void watch() override
      {
        ContinuumEnergy continuum;
        continuum.internal = motion->energy().internal;
        probes.read({&motion->displacement(), &motion->internal_force(), &motion->external_force()}, continuum);
        energies.look({time(), motion->energy(), body.specimen().energy(), continuum.dissipated});
      }

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

      std::string text_of_mismatch() const override
      {
        if (media.empty())
          return "";
        coupling::Mismatch worst;
        for (const auto &group : model.continuum.materials.groups)
          {
            const coupling::ParticleMedium *medium = media.of(group->group);
            if (!medium)
              continue;
            const auto               number = solid->mesh().materials.at(group->group);
            const coupling::Mismatch found =
              coupling::reflected_by_mismatch(*medium, solid->material(number).elastic_stiffness(),
                                              motion->density(number), {dim, solid->options().plane});
            worst.compression = std::max(worst.compression, found.compression);
            worst.shear       = std::max(worst.shear, found.shear);
          }
        return fmt::format("impedances reflect {:.2g} of the energy of waves of compression, {:.2g} of shear",
                           worst.compression, worst.shear);
      }

      std::string text_of_handshakes() const override
      {
        std::string text;
        if (!media.empty())
          text += fmt::format("  medium       {}\n", text_of_mismatch());
        auto handshake = model.handshakes.handshakes.begin();
        auto mismatch  = mismatches.begin();
        for (const auto &volume : both.volumes())
          text += fmt::format("  handshake    {}: {} particles and {} bonds in the overlap, {} nodes; {}\n",
                              (handshake++)->name, volume->in_overlap(), volume->bonds(), volume->nodes(),
                              text_of(*mismatch++));
        for (const std::string &doubt : doubtful)
          text += fmt::format("  warning      {}\n", doubt);
        return text;
      }

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
        std::vector<std::string> all = doubtful;
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

      std::string draw(const std::filesystem::path &file, const std::string &title) const override
      {
        return draw_solid_and_particles(*solid, motion->displacement(), body.specimen().particles(), file, title);
      }

      std::string draw_cracks(const std::filesystem::path &file, const std::string &title) const override
      {
        return draw_cracks_in_solid(*solid, motion->displacement(), body.specimen(), material_names, file,
                                    fmt::format("{} at {:.3g} s", title, time()));
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
      void add(const HandshakeSection &handshake)
      {
        // Of the elements whose centre lies in the overlap or within; where it is narrower than they are, of those that reach into it.
        double                  volume = 0, fastest = 0;
        std::size_t             count   = 0;
        const coupling::Overlap overlap = handshake.overlap();
        const auto              enter   = [&](const auto &cell) {
          volume += cell->measure();
          ++count;
          const auto &d = solid->material(cell->material_id()).elastic_stiffness();
          fastest = std::max(fastest, std::sqrt(d.template topLeftCorner<3, 3>().diagonal().maxCoeff() /
                                                               motion->density(cell->material_id())));
        };
        for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
          if (overlap.distance(fem::in_space(cell->center())) <= overlap.width)
            enter(cell);
        const bool narrow = count == 0;
        for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
          if (const auto corners = cell->vertex_indices();
              narrow && std::any_of(corners.begin(), corners.end(), [&](const unsigned int v) {
                return overlap.contains(fem::in_space(cell->vertex(v)));
              }))
            enter(cell);
        if (count == 0)
          throw base::InputError("Handshakes/" + handshake.name +
                                 ": no element of the solid lies in the overlap. Widen it, or look where the mesh is.");
        const double element = std::pow(volume / static_cast<double>(count), 1.0 / dim);
        look_at(handshake, overlap, element);
        coupling::VolumeCouplingParameters made = handshake.parameters(element, fastest);
        made.others                             = model.handshakes.others_of(handshake);
        both.add_volume(made);
      }

      /** Doubts about a handshake, before its particles share. @param element size of the solid's elements there [m] */
      void look_at(const HandshakeSection &said, const coupling::Overlap &overlap, const double element)
      {
        std::vector<double> masses;
        for (std::size_t i = 0; i < body.specimen().counts().particles; ++i)
          masses.push_back(body.specimen().particle(i).mass);
        const coupling::OverlapMedium found =
          coupling::medium_in_overlap(body.specimen().network(), masses, *solid, overlap);
        const std::string name  = "Handshakes/" + said.name;
        const bool        tied  = said.method == coupling::VolumeMethod::multipliers;
        const double      needs = tied ? element : found.longest_bond;
        if (found.density > 0 && said.width < narrowest * needs)
          doubtful.push_back(fmt::format("{}: Overlap = {:g} m is narrower than {}, {:.3g} m", name, said.width,
                                         tied ? "an element there" : "the bonds of its particles are long", needs));
        coupling::Mismatch worst;
        for (const auto &[group, number] : solid->mesh().materials)
          if (const coupling::ParticleMedium *known = media.of(group);
              reaches(number, overlap) && (known || found.density > 0))
            {
              const coupling::ParticleMedium medium =
                known ? *known : coupling::ParticleMedium{found.stiffness, found.density};
              const coupling::Mismatch here =
                coupling::reflected_by_mismatch(medium, solid->material(number).elastic_stiffness(),
                                                motion->density(number), {dim, solid->options().plane});
              worst.compression = std::max(worst.compression, here.compression);
              worst.shear       = std::max(worst.shear, here.shear);
            }
        mismatches.push_back(worst);
        if (std::max(worst.compression, worst.shear) > largest_mismatch)
          doubtful.push_back(fmt::format("{}: the solid's stiffness or density is not that of the particles in the "
                                         "overlap: {}",
                                         name, text_of(worst)));
      }

      static std::string text_of(const coupling::Mismatch &mismatch)
      {
        return fmt::format("impedances reflect about {:.2g} of the energy of waves of compression, {:.2g} of shear",
                           mismatch.compression, mismatch.shear);
      }

      bool reaches(const dealii::types::material_id number, const coupling::Overlap &overlap) const
      {
        for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
          if (cell->material_id() == number &&
              overlap.distance(fem::in_space(cell->center())) <= overlap.width + cell->diameter())
            return true;
        return false;
      }

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

      /** Of all couplings, since the start. */
      std::int64_t torn_glue() const
      {
        std::int64_t torn = 0;
        for (const auto &coupled : both.surfaces())
          torn += body.specimen().surfaces().at(coupled->surface()).torn;
        return torn;
      }

      /** Of all. */
      coupling::Momentum momentum() const
      {
        coupling::Momentum sum   = coupling::momentum_of(participant);
        const std::size_t  count = body.specimen().counts().particles; // counting all is no work for every particle
        for (std::size_t i = 0; i < count; ++i)
          {
            const dem::ParticleState p = body.specimen().particle(i);
            sum.linear += p.mass * p.velocity;
            sum.angular += p.position.cross(p.mass * p.velocity) + p.inertia * p.spin;
          }
        return sum;
      }

      const CoupledModel                       &model;
      ParticleMedia                             media; ///< of the particles
      std::vector<std::string>                  material_names;
      ParticlesBody                             body;
      std::unique_ptr<fem::Solid<dim>>          solid;
      std::unique_ptr<fem::ExplicitSolver<dim>> motion;
      coupling::SolidParticipant<dim>           participant;
      coupling::ConcurrentMotion<dim>           both;
      std::unique_ptr<SolidNodes>               own_nodes;
      OutsideForces                             outside;
      ObservedContacts<dim>                     touching; ///< between bodies of the solid
      ContinuumProbes<dim>                      probes;
      ContactFigures                            figures;
      EnergyWatch<dim>                          energies;
      std::vector<std::string>                  doubtful;   ///< of handshakes
      std::vector<coupling::Mismatch>           mismatches; ///< likewise
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

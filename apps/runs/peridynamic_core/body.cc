#include "apps/runs/peridynamic_core/body.h"

#include "apps/process/interrupt.h"
#include "apps/results/run_work.h"
#include "apps/runs/continuum/motion.h"
#include "apps/runs/continuum/picture.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/snapshot.h"
#include "apps/runs/continuum/solid.h"
#include "base/errors.h"
#include "coupling/volume/particle_medium.h"
#include "coupling/volume/peridynamic_handshake.h"
#include "fem/materials/response.h"
#include "fem/mesh/point_in_space.h"
#include "postprocess/pictures/field_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace apps
{
  namespace pd = dem::peridynamics;
  using Eigen::Vector3d;

  namespace
  {
    /** Energy of waves that different media reflect, beyond which a scene is doubted. */
    constexpr double largest_reflection = 0.01;

    /** The core with its shares, in the words of its section. */
    std::unique_ptr<PeridynamicBody> shared_core(const PeridynamicCoreModel &model)
    try
      {
        auto made = std::make_unique<PeridynamicBody>(model.core);
        coupling::share_with_solid(made->bonds, model.parameters());
        made->loads.held = true; // by the elements: what moves all of it is no free motion, and stays in the results
        return made;
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError("Core/" + std::string(refusal.what()));
      }

    TakenPlaces taken_by(const PeridynamicCoreModel &model)
    {
      TakenPlaces taken;
      taken.whole = [&model](const Vector3d &place) { return model.is_taken(place); };
      taken.share = [overlap = model.parameters().overlap](const std::array<double, 3> &place) {
        return overlap.of_solid(Vector3d(place.data()));
      };
      return taken;
    }

    pd::Field velocity_at_start(const PeridynamicCoreModel &model, const pd::Grid &grid)
    {
      pd::Field v = grid.field();
      for (const std::size_t i : grid.nodes())
        v.add(i, value_of(model.continuum.motion.initial_velocity, grid.position(i), 0));
      return v;
    }

    /** The continuum that the grid is, of one of its materials. */
    coupling::ParticleMedium medium_of(const pd::Bonds &bonds, const pd::Material &material)
    {
      const pd::LatticeConstants &l = bonds.lattice();
      coupling::ParticleMedium    medium;
      medium.density   = material.density;
      const double c11 = l.c11 * material.young_modulus, c12 = l.c12 * material.young_modulus;
      auto        &D = medium.stiffness;
      D.topLeftCorner<3, 3>().setConstant(c12);
      for (int a = 0; a < 3; ++a)
        {
          D(a, a)         = c11;
          D(3 + a, 3 + a) = c12;
        }
      if (bonds.grid().dimension() == 2) // it is that of the plane: nothing out of it takes part
        for (const int c : {2, 3, 4})
          {
            D.row(c).setZero();
            D.col(c).setZero();
            D(c, c) = c11;
          }
      return medium;
    }

    template <int dim>
    class Body : public PeridynamicCoreBody
    {
    public:
      explicit Body(const PeridynamicCoreModel &what)
        : model(what)
        , inner(shared_core(what))
        , solid(make_solid<dim>(what.continuum, taken_by(what)))
        , motion(make_motion(*solid, what.continuum))
        , around(*solid, *motion)
        , middle(inner->bonds,
                 inner->loads.act,
                 {what.core.analysis.kinematics, what.core.analysis.step_factor, what.core.analysis.repulsion},
                 velocity_at_start(what, inner->bonds.grid()))
        , probes(*solid, what.continuum)
      {
        refuse_elements_beside();
        handshake.emplace(middle, *solid, *motion, around, what.parameters());
      }

      void advance_to(const double end) override
      {
        do
          {
            const double rest = end - time();
            take(rest / std::max(1.0, std::ceil(rest / step() * (1 - 1e-12))));
          }
        while (time() < end * (1 - 1e-12) && !interrupted());
      }

      std::int64_t advance(const std::int64_t count) override
      {
        std::int64_t n = 0;
        for (; n < count && time() + step() < model.end_time; ++n)
          take(step());
        return n;
      }

      double       time() const override { return middle.time(); }
      std::int64_t steps() const override { return taken; }
      double       step() const override { return handshake->stable_step(); }

      std::vector<postprocess::SeriesColumn> reported() const override
      {
        std::vector<postprocess::SeriesColumn> all;
        for (const ProbeColumn &probe : probes.columns())
          all.push_back(of_solid(probe));
        for (int d = 0; d < dim; ++d)
          all.push_back({std::string("core_held_") + "xyz"[d], "N"});
        all.push_back({"broken_bonds", ""});
        all.push_back({"damage", "-"});
        return all;
      }

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        std::vector<postprocess::SeriesColumn> all = {{"time", "s"}};
        for (const postprocess::SeriesColumn &one : reported())
          all.push_back(one);
        for (const char *term : {"kinetic", "internal", "external", "damped", "start"})
          all.push_back({std::string("energy_solid_") + term, "J"});
        for (const char *term : {"kinetic", "strain", "repulsion", "released", "external", "start"})
          all.push_back({std::string("energy_core_") + term, "J"});
        for (const char *name :
             {"handshake_work_on_solid", "handshake_work_on_core", "handshake_spurious", "energy_residual"})
          all.push_back({name, "J"});
        return all;
      }

      std::vector<double> row() const override
      {
        ContinuumEnergy     continuum;
        std::vector<double> values = {time()};
        const auto add = [&](const auto &list) { values.insert(values.end(), std::begin(list), std::end(list)); };
        const fem::ExplicitEnergy s = motion->energy();
        continuum.internal          = s.internal;
        add(probes.read({&motion->displacement(), &motion->internal_force(), &motion->external_force()}, continuum));
        const Vector3d held = middle.force_on_held();
        for (int d = 0; d < dim; ++d)
          values.push_back(held[d]);
        add(std::initializer_list<double>{static_cast<double>(inner->bonds.broken()), inner->largest_damage()});
        pd::Motion         now      = middle.motion(); // energies are found with work space of its own
        const pd::Energies e        = now.energies(inner->bonds);
        const double       on_solid = handshake->work_on_solid(), on_core = handshake->work_on_core();
        add(std::initializer_list<double>{s.kinetic, s.internal, s.external - on_solid, s.damped, s.start});
        add(
          std::initializer_list<double>{e.kinetic, e.strain, e.repulsion, e.released, e.external - on_core, e.initial});
        // What ties do is no energy from outside: they give to one side what they take from the other.
        const double made = on_solid + on_core;
        add(std::initializer_list<double>{
          on_solid, on_core, made, s.external + s.start - s.kinetic - s.internal - s.damped - e.residual() - made});
        return values;
      }

      PeridynamicCoreSize size() const override
      {
        PeridynamicCoreSize found;
        found.elements         = solid->mesh().triangulation->n_global_active_cells();
        found.unknowns         = solid->dofs().n_dofs();
        found.nodes            = middle.carriers();
        found.bonds            = inner->bonds.count();
        found.nodes_in_overlap = handshake->in_overlap();
        found.mesh_nodes       = handshake->nodes();
        found.solid_step       = around.stable_step();
        found.core_step        = middle.stable_step();
        return found;
      }

      const PeridynamicBody &core() const override { return *inner; }
      PeridynamicState       state() const override { return {*inner, middle.motion().displacement()}; }
      std::string            first_reaction() const override { return probes.first_reaction(); }

      std::vector<std::string> doubts() const override
      {
        std::vector<std::string> all   = inner->loads.warnings;
        const coupling::Mismatch found = mismatch();
        if (std::max(found.compression, found.shear) > largest_reflection)
          all.push_back("Handshake: " + text_of_mismatch() + ": elements and core are not of one material");
        if (const double element = element_size(); model.handshake.width < 0.99 * element)
          all.push_back(fmt::format("Handshake: Overlap = {:g} m is narrower than an element there, {:.3g} m",
                                    model.handshake.width, element));
        return all;
      }

      std::string text_of_mismatch() const override
      {
        const coupling::Mismatch found = mismatch();
        return fmt::format("impedances reflect {:.2g} of the energy of waves of compression, {:.2g} of shear",
                           found.compression, found.shear);
      }

      void write_solid(const std::filesystem::path &folder, const std::size_t number) override
      {
        fem::Vector reaction = motion->internal_force();
        reaction -= motion->external_force();
        reaction.update_ghost_values();
        apps::write_solid(*solid, motion->displacement(), reaction, {folder / "solid", "solid", number, time()});
      }

      std::string draw(const std::filesystem::path  &file,
                       const std::string            &title,
                       const PeridynamicState::Shown shown) const override
      {
        const PeridynamicState now    = state();
        double                 length = 0;
        for (std::size_t n = 0; n < around.carriers(); ++n)
          length = std::max(length, 2 * around.place(n).cwiseAbs().maxCoeff());
        const double magnify  = now.magnification(length);
        fem::Vector  enlarged = motion->displacement();
        enlarged *= magnify;
        enlarged.update_ghost_values();
        std::vector<postprocess::PictureFacet> facets = cut_of(*solid, enlarged, 2, 0.0).facets;
        for (postprocess::PictureFacet &facet : facets)
          facet.value = shown == PeridynamicState::Shown::damage ? 0 : facet.value / magnify;
        for (const postprocess::PictureFacet &facet : now.facets(shown, magnify))
          facets.push_back(facet);
        return PeridynamicState::draw_facets(file, now.title_of_picture(title, magnify), facets, shown);
      }

      void visit_state(RunState &state) override
      {
        state.group("core");
        middle.visit_state(state);
        state.group("solid");
        visit_motion(state, *motion, *solid);
        probes.visit_state(state);
        state.group("handshake");
        handshake->visit_state(state);
        state.scalar("steps", taken);
      }

    private:
      void take(const double length)
      {
        try
          {
            handshake->advance(length);
          }
        catch (const fem::MaterialFailure &failure)
          {
            throw StoppedShort(failure.what());
          }
        ++taken;
      }

      /** Elements beside the core where it is a side of the whole body. @throws base::InputError */
      void refuse_elements_beside() const
      {
        const coupling::Overlap   overlap = model.parameters().overlap;
        const Eigen::AlignedBox3d room    = model.room();
        for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
          {
            const Vector3d centre = fem::in_space(cell->center());
            if (overlap.distance(centre) < overlap.width && !room.contains(centre))
              throw base::InputError(fmt::format(
                "Handshake/Sides = {}: an element at ({:g}, {:g}, {:g}) m lies beside the core, at a side that is not "
                "named. Name it, or make the core as wide as the solid.",
                fmt::join(model.handshake.sides, ", "), centre.x(), centre.y(), centre.z()));
          }
      }

      /** The worst of all materials of the core and of the elements in the overlap. */
      coupling::Mismatch mismatch() const
      {
        coupling::Mismatch          worst;
        const coupling::Overlap     overlap = model.parameters().overlap;
        const coupling::StressState state{dim, solid->options().plane};
        for (const pd::Material &material : inner->bonds.mixture().materials)
          for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
            if (overlap.contains(fem::in_space(cell->center())))
              {
                const coupling::Mismatch found = coupling::reflected_by_mismatch(
                  medium_of(inner->bonds, material), solid->material(cell->material_id()).elastic_stiffness(),
                  motion->density(cell->material_id()), state);
                worst.compression = std::max(worst.compression, found.compression);
                worst.shear       = std::max(worst.shear, found.shear);
              }
        return worst;
      }

      /** Of the elements in the overlap, the largest [m]. */
      double element_size() const
      {
        const coupling::Overlap overlap = model.parameters().overlap;
        double                  most    = 0;
        for (const auto &cell : solid->mesh().triangulation->active_cell_iterators())
          if (const Vector3d centre = fem::in_space(cell->center()); overlap.distance(centre) <= overlap.width)
            most = std::max(most, std::pow(cell->measure(), 1.0 / dim));
        return most;
      }

      const PeridynamicCoreModel                        &model;
      std::unique_ptr<PeridynamicBody>                   inner;
      std::unique_ptr<fem::Solid<dim>>                   solid;
      std::unique_ptr<fem::ExplicitSolver<dim>>          motion;
      coupling::SolidParticipant<dim>                    around;
      coupling::PeridynamicParticipant                   middle;
      ContinuumProbes<dim>                               probes;
      std::optional<coupling::PeridynamicHandshake<dim>> handshake;
      std::int64_t                                       taken = 0;
    };
  } // namespace

  std::unique_ptr<PeridynamicCoreBody> make_peridynamic_core_body(const PeridynamicCoreModel &model)
  {
    if (model.dimension() == 2)
      return std::make_unique<Body<2>>(model);
    return std::make_unique<Body<3>>(model);
  }
} // namespace apps

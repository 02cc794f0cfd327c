#include "apps/runs/structure/solid.h"

#include "apps/runs/continuum/picture.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/snapshot.h"
#include "apps/runs/coupled/taken_places.h"
#include "coupling/volume/static_handshake.h"
#include "fem/mesh/extent.h"
#include "fem/mesh/point_in_space.h"
#include "fem/solid/point_search.h"
#include "fem/solid/weight.h"

#include <Eigen/Geometry>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <map>
#include <utility>

namespace apps
{
  namespace
  {
    template <int dim>
    class SurroundingSolid : public StructureSolid
    {
    public:
      SurroundingSolid(const StructureModel &model, const HandshakesSection &handshakes, dem::LoadedNetwork particles)
        : solid(made(model, handshakes))
        , weights(weights_of(*solid, model))
        , both(std::move(particles), *solid, parameters(model, handshakes), weights ? &*weights : nullptr)
        , probes(*solid, model.continuum)
      {
        if (weights)
          hinges = dem::unload_hinges(both.network());
        // What is linear neither loses energy nor is damaged.
        const std::vector<ProbeColumn> all = probes.columns();
        for (std::size_t k = 0; k < all.size(); ++k)
          if (const std::string &name = all[k].column.name;
              name != "energy_dissipated" && name.rfind("largest_", 0) != 0)
            reported.push_back(k);
      }

      const dem::LoadedNetwork &network() const override { return both.network(); }

      std::vector<ProbeColumn> columns() const override { return reported_of(probes.columns()); }

      std::vector<double> read(const dem::LoadedMotion &motion) const override
      {
        State           now = state(motion);
        ContinuumEnergy energy;
        energy.internal = 0.5 * (now.displacement * now.internal);
        if (weights)
          now.internal.add(-part_of_weight(motion), *weights); // what is left of it is borne by loads and supports
        now.internal.update_ghost_values();
        return reported_of(probes.read({&now.displacement, &now.internal, &now.external}, energy));
      }

      coupling::PlaceMotions motions_at(const std::vector<Eigen::Vector3d> &places,
                                        const dem::LoadedMotion            &motion) const override
      {
        find(places);
        fem::Vector displacement = both.displacement(motion);
        displacement.update_ghost_values();
        coupling::PlaceMotions motions(places.size());
        for (std::size_t i = 0; i < places.size(); ++i)
          if (found[i])
            motions[i] = motion_of(*found[i], displacement);
        return motions;
      }

      std::vector<Eigen::Vector3d> joint_places() const override { return both.joint_places(); }

      std::vector<Eigen::Vector3d> burdened_nodes() const override
      {
        fem::Vector force = solid->make_vector();
        solid->external_force(1, force);
        std::vector<dealii::Point<dim>> place(solid->dofs().n_dofs());
        dealii::DoFTools::map_dofs_to_support_points(solid->mapping(), solid->dofs(), place);
        std::vector<Eigen::Vector3d> places;
        for (dealii::types::global_dof_index i = 0; i < place.size(); ++i)
          if (solid->constraints().is_constrained(i) || force[i] != 0)
            places.push_back(fem::in_space(place[i]));
        return places;
      }

      std::vector<std::vector<std::size_t>> shared_links() const override { return both.shared_links(); }
      bool                                  is_positive() const override { return both.is_positive(); }
      const std::vector<dem::Mechanism>    &swinging() const override { return hinges; }

      Eigen::Vector3d weight() const override
      {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (unsigned int c = 0; weights && c < dim; ++c)
          for (const auto dof : dealii::DoFTools::extract_dofs(solid->dofs(), component_mask(c)))
            sum[c] += (*weights)[dof];
        return sum;
      }

      std::size_t elements() const override { return solid->mesh().triangulation->n_global_active_cells(); }
      std::size_t unknowns() const override { return solid->dofs().n_dofs(); }
      std::size_t joints() const override { return static_cast<std::size_t>(both.network().body->joints()); }

      double difference_from(const ParticleMedia &media) const override
      {
        double largest = 0;
        for (const auto &[name, number] : solid->mesh().materials)
          if (const coupling::ParticleMedium *medium = media.of(name))
            largest =
              std::max(largest, coupling::difference_of_stiffness(*medium, solid->material(number).elastic_stiffness(),
                                                                  {dim, solid->options().plane}));
        return largest;
      }

      void write(const std::filesystem::path &folder,
                 const std::size_t            number,
                 const double                 time,
                 const dem::LoadedMotion     &motion) const override
      {
        State now = state(motion);
        now.internal -= now.external;
        if (weights)
          now.internal.add(-part_of_weight(motion), *weights);
        now.internal.update_ghost_values();
        write_whole_solid(*solid, now.displacement, now.internal, {folder / "solid", "solid", number, time});
      }

      std::vector<std::vector<Eigen::Vector2d>>
      outlines(const dem::LoadedMotion &motion, const double magnify, int &across) const override
      {
        fem::Vector displacement = both.displacement(motion);
        displacement *= magnify;
        displacement.update_ghost_values();
        const SolidCut cut = cut_of(*solid, displacement, thinnest_axis());
        across             = cut.across;
        std::vector<std::vector<Eigen::Vector2d>> polygons;
        for (const postprocess::PictureFacet &facet : cut.facets)
          {
            auto &corners = polygons.emplace_back();
            for (const auto &corner : facet.corner)
              corners.emplace_back(corner[0], corner[1]);
          }
        return polygons;
      }

    private:
      struct State
      {
        fem::Vector displacement, internal, external;
      };

      /** Elements around places, which are the same ones every time. */
      void find(const std::vector<Eigen::Vector3d> &places) const
      {
        if (looked_for == places)
          return;
        looked_for = places;
        found.clear();
        for (const Eigen::Vector3d &place : places)
          found.push_back(solid->point_search().find(point_of<dim>({place.x(), place.y(), place.z()})));
      }

      static coupling::PlaceMotion motion_of(const fem::PlaceInElement<dim> &at, const fem::Vector &displacement)
      {
        coupling::PlaceMotion motion;
        motion.element = fem::in_space(at.cell->center());
        for (std::size_t k = 0; k < at.nodes.size(); ++k)
          {
            Eigen::Vector3d u = Eigen::Vector3d::Zero(), gradient = u;
            for (int c = 0; c < dim; ++c)
              {
                u[c]        = displacement[at.nodes[k][static_cast<std::size_t>(c)]];
                gradient[c] = at.gradients[k][c];
              }
            motion.displacement += at.weights[k] * u;
            motion.rotation += 0.5 * gradient.cross(u);
          }
        return motion;
      }

      template <typename Value>
      std::vector<Value> reported_of(const std::vector<Value> &all) const
      {
        std::vector<Value> some;
        for (const std::size_t k : reported)
          some.push_back(all[k]);
        return some;
      }

      static std::unique_ptr<fem::Solid<dim>> made(const StructureModel &model, const HandshakesSection &handshakes)
      {
        TakenPlaces taken = taken_by(handshakes);
        taken.holds       = true;
        return make_solid<dim>(model.continuum, taken);
      }

      static std::optional<fem::Vector> weights_of(const fem::Solid<dim> &solid, const StructureModel &model)
      {
        if (!model.gravity.acts())
          return std::nullopt;
        std::map<dealii::types::material_id, double> density;
        for (const auto &group : model.continuum.materials.groups)
          if (const auto found = solid.mesh().materials.find(group->group); found != solid.mesh().materials.end())
            density[found->second] = group->density;
        dealii::Tensor<1, dim> gravity;
        for (unsigned int c = 0; c < dim; ++c)
          gravity[c] = model.gravity.acceleration[c];
        return fem::weight_of(solid, density, gravity);
      }

      double part_of_weight(const dem::LoadedMotion &motion) const
      {
        return motion.loads[both.network().dead->parameter];
      }

      static dealii::ComponentMask component_mask(const unsigned int component)
      {
        dealii::ComponentMask mask(dim, false);
        mask.set(component, true);
        return mask;
      }

      static std::vector<coupling::VolumeCouplingParameters> parameters(const StructureModel    &model,
                                                                        const HandshakesSection &handshakes)
      {
        std::vector<coupling::VolumeCouplingParameters> all;
        for (const HandshakeSection &handshake : handshakes.handshakes)
          {
            all.push_back(handshake.parameters(0, 0)); // nothing is absorbed
            all.back().others = handshakes.others_of(handshake);
            all.back().empty  = [&model](const Eigen::Vector3d &place) { return model.is_void(place); };
          }
        return all;
      }

      /** A beam or a plate is seen from its side. */
      unsigned int thinnest_axis() const
      {
        const auto   extent   = fem::extent_of(solid->mesh());
        unsigned int thinnest = dim - 1;
        for (unsigned int c = dim - 1; c-- > 0;)
          if (extent.high[c] - extent.low[c] < extent.high[thinnest] - extent.low[thinnest])
            thinnest = c;
        return dim == 2 ? 2 : thinnest;
      }

      State state(const dem::LoadedMotion &motion) const
      {
        State now{both.displacement(motion), solid->make_vector(), solid->make_vector()};
        solid->internal_force(now.displacement, now.internal);
        solid->external_force(motion.loads[both.network().driven], now.external);
        return now;
      }

      std::unique_ptr<fem::Solid<dim>> solid;
      std::optional<fem::Vector>       weights; ///< forces by which it is drawn down; none: there is no gravity
      coupling::StaticHandshake<dim>   both;
      ContinuumProbes<dim>             probes;
      std::vector<std::size_t>         reported; ///< of its columns
      std::vector<dem::Mechanism>      hinges;   ///< particles whose weight is left out

      mutable std::vector<Eigen::Vector3d>                         looked_for;
      mutable std::vector<std::optional<fem::PlaceInElement<dim>>> found; ///< of each of these
    };
  } // namespace

  std::unique_ptr<StructureSolid>
  surround(const StructureModel &model, const HandshakesSection &handshakes, dem::LoadedNetwork particles)
  {
    if (model.dimension == 2)
      return std::make_unique<SurroundingSolid<2>>(model, handshakes, std::move(particles));
    return std::make_unique<SurroundingSolid<3>>(model, handshakes, std::move(particles));
  }
} // namespace apps

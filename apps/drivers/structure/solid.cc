#include "apps/drivers/structure/solid.h"

#include "apps/drivers/continuum/gauges.h"
#include "apps/drivers/continuum/picture.h"
#include "apps/drivers/continuum/snapshot.h"
#include "apps/drivers/coupled/taken_places.h"
#include "coupling/volume/static_handshake.h"
#include "fem/mesh/extent.h"

#include <algorithm>
#include <utility>

namespace apps
{
  namespace
  {
    template <int dim>
    class SurroundingSolid : public StructureSolid
    {
    public:
      SurroundingSolid(const StructureModel &model, dem::LoadedNetwork particles)
        : solid(made(model))
        , plane_model(model.continuum.solid)
        , both(std::move(particles), *solid, parameters(model))
        , gauges(*solid, model.continuum)
      {
        // What is linear neither loses energy nor is damaged.
        const std::vector<GaugeColumn> all = gauges.columns();
        for (std::size_t k = 0; k < all.size(); ++k)
          if (const std::string &name = all[k].column.name;
              name != "energy_dissipated" && name.rfind("largest_", 0) != 0)
            told.push_back(k);
      }

      const dem::LoadedNetwork &network() const override { return both.network(); }

      std::vector<GaugeColumn> columns() const override { return told_of(gauges.columns()); }

      std::vector<double> read(const dem::LoadedMotion &motion) const override
      {
        const State     now = state(motion);
        ContinuumEnergy energy;
        energy.internal = 0.5 * (now.displacement * now.internal);
        return told_of(gauges.read({&now.displacement, &now.internal, &now.external}, energy));
      }

      std::vector<std::vector<std::size_t>> shared_links() const override { return both.shared_links(); }
      std::size_t elements() const override { return solid->mesh().triangulation->n_global_active_cells(); }
      std::size_t unknowns() const override { return solid->dofs().n_dofs(); }
      std::size_t joints() const override { return static_cast<std::size_t>(both.network().body->joints()); }

      double difference_from(const ParticleMedia &media) const override
      {
        double largest = 0;
        for (const auto &[name, number] : solid->mesh().materials)
          if (const ParticleMedium *medium = media.of(name))
            largest = std::max(
              largest, difference_of_stiffness(*medium, solid->material(number).elastic_stiffness(), plane_model));
        return largest;
      }

      std::string write(const std::filesystem::path &folder,
                        const std::size_t            number,
                        const double                 time,
                        const dem::LoadedMotion     &motion) const override
      {
        State now = state(motion);
        now.internal -= now.external;
        now.internal.update_ghost_values();
        return write_solid(*solid, now.displacement, now.internal, {folder / "solid", "solid", number, time});
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

      template <typename Value>
      std::vector<Value> told_of(const std::vector<Value> &all) const
      {
        std::vector<Value> some;
        for (const std::size_t k : told)
          some.push_back(all[k]);
        return some;
      }

      static std::unique_ptr<fem::Solid<dim>> made(const StructureModel &model)
      {
        TakenPlaces taken = taken_by(model.handshakes);
        taken.holds       = true;
        return make_solid<dim>(model.continuum, taken);
      }

      static std::vector<coupling::VolumeCouplingParameters> parameters(const StructureModel &model)
      {
        std::vector<coupling::VolumeCouplingParameters> all;
        for (const HandshakeSection &handshake : model.handshakes.handshakes)
          all.push_back(handshake.parameters(0, 0)); // nothing is absorbed
        return all;
      }

      /** A beam or a plate is seen from its side. */
      unsigned int thinnest_axis() const
      {
        const auto   extent = fem::extent_of(solid->mesh());
        unsigned int found  = dim - 1;
        for (unsigned int c = dim - 1; c-- > 0;)
          if (extent.high[c] - extent.low[c] < extent.high[found] - extent.low[found])
            found = c;
        return dim == 2 ? 2 : found;
      }

      State state(const dem::LoadedMotion &motion) const
      {
        State now{both.displacement(motion), solid->make_vector(), solid->make_vector()};
        solid->internal_force(now.displacement, now.internal);
        solid->external_force(motion.loads[both.network().led], now.external);
        return now;
      }

      std::unique_ptr<fem::Solid<dim>> solid;
      SolidSection                     plane_model;
      coupling::StaticHandshake<dim>   both;
      ContinuumGauges<dim>             gauges;
      std::vector<std::size_t>         told; ///< of its columns
    };
  } // namespace

  std::unique_ptr<StructureSolid> surround(const StructureModel &model, dem::LoadedNetwork particles)
  {
    if (model.dimension == 2)
      return std::make_unique<SurroundingSolid<2>>(model, std::move(particles));
    return std::make_unique<SurroundingSolid<3>>(model, std::move(particles));
  }
} // namespace apps

#include "apps/runs/structure/promotion.h"

#include "apps/results/run_work.h"
#include "apps/runs/coupled/element_region.h"
#include "apps/specimens/specimen_packing.h"
#include "coupling/promotion/carried_motion.h"

#include <fmt/format.h>

#include <utility>

namespace apps
{
  Promotion::Promotion(const StructureModel &what, const dem::Packing &all, const ParticleMedia &of_particles)
    : model(what)
    , packing(all)
    , media(of_particles)
  {
    if (model.handshakes.promote())
      regions.emplace(growing_regions());
    now = made();
    if (!regions)
      return;
    // Beside these the overlap would come to a node that something else holds.
    regions->leave_out_around(now->surrounding()->burdened_nodes());
    regions->require_particles(now->surrounding()->motions_at(packing.centre, now->way().motion()));
    whole.emplace(dem::unloaded(model.network(packing)));
    bonds = std::make_unique<dem::DamagingLinks>(*whole, model.materials(packing));
  }

  coupling::GrowingRegions Promotion::growing_regions() const
  {
    std::vector<coupling::GrowingRegion> starts;
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      starts.push_back(
        {handshake.name, handshake.overlap().distance, handshake.width, handshake.promote_at, handshake.reach});
    return {elements_of(model.continuum.mesh, model.dimension), std::move(starts)};
  }

  std::vector<std::size_t> Promotion::promotable() const
  {
    return regions ? regions->growable() : std::vector<std::size_t>();
  }

  HandshakesSection Promotion::handshakes() const
  {
    if (!regions)
      return model.handshakes;
    HandshakesSection made;
    std::size_t       h = 0;
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      made.handshakes.push_back(handshake.around(regions->distance_from(h++)));
    return made;
  }

  StructureParts Promotion::parts()
  {
    StructureParts some;
    some.handshakes   = handshakes();
    some.bears_weight = bears_weight;
    if (!regions)
      {
        some.packing = packing;
        some.groups  = model.groups_in(packing);
        return some;
      }
    awake.clear();
    std::vector<std::size_t> number(packing.size(), packing.size());
    some.packing = particles_where(packing, [&](const std::size_t i) {
      if (!some.handshakes.may_hold(packing.centre[i]))
        return false;
      number[i] = awake.size();
      awake.push_back(i);
      return true;
    });
    if (groups.empty())
      for (const auto &[name, members] : model.groups_in(some.packing))
        for (const std::size_t i : members)
          groups[name].push_back(awake[i]);
    for (const auto &[name, members] : groups)
      for (const std::size_t i : members)
        some.groups[name].push_back(number[i]);
    some.promoted = regions->grown();
    return some;
  }

  std::unique_ptr<Structure> Promotion::made() { return std::make_unique<Structure>(model, parts(), media); }

  dem::LoadedMotion Promotion::motion_of_all()
  {
    const dem::LoadedMotion &of_awake = now->way().motion();
    in_solid                          = now->surrounding()->motions_at(packing.centre, of_awake);
    return coupling::motion_of_all(*whole, {now->network(), awake}, of_awake, in_solid);
  }

  bool Promotion::promote()
  {
    if (!regions || !now->bears_weight()) // the solid bears all that it is given until then
      return false;
    const dem::LoadedMotion motion        = motion_of_all();
    const auto              region_before = regions->now();
    const Numbers           awake_before  = awake;
    bonds->evaluate(motion);
    if (!regions->grow(*bonds, whole->network.links, in_solid))
      return false;
    std::unique_ptr<Structure> before = std::move(now);
    bears_weight                      = true;
    try
      {
        now = made();
      }
    catch (const base::InputError &error)
      {
        now   = std::move(before);
        awake = awake_before;
        regions->set_now(region_before);
        throw StoppedShort(
          fmt::format("Promotion of elements to particles at the load factor {:.6g}: {} Make Promotion "
                      "reach smaller.",
                      now->load_factor(), error.what()));
      }
    go_on_from(*before, awake_before, motion);
    return true;
  }

  void Promotion::go_on_from(const Structure &before, const Numbers &awake_before, const dem::LoadedMotion &motion)
  {
    const coupling::AwakeParticles was{before.network(), awake_before}, is{now->network(), awake};
    const dem::LoadedMotion       &old            = before.way().motion();
    const dem::LoadedMotion        unmoved        = dem::LoadedMotion(is.network.held.size());
    const coupling::PlaceMotions   still_in_solid = now->surrounding()->motions_at(packing.centre, unmoved);
    const coupling::PlaceMotions   joints = before.surrounding()->motions_at(now->surrounding()->joint_places(), old);
    now->way().go_on_from(before.way(), coupling::start_from({was, old, motion, in_solid, joints}, is, still_in_solid),
                          coupling::links_before(was, is));
  }

  void Promotion::visit_state(RunState &state)
  {
    if (!regions)
      return;
    state.group("promotion");
    std::vector<coupling::GrowingRegions::Set> region = regions->now();
    for (std::size_t h = 0; h < region.size(); ++h)
      {
        std::vector<std::int32_t> elements(region[h].begin(), region[h].end());
        state.column(fmt::format("elements_{}", h), elements);
        region[h] = coupling::GrowingRegions::Set(elements.begin(), elements.end());
      }
    regions->set_now(std::move(region));
    if (state.reads() && regions->has_grown())
      {
        bears_weight = true; // before, nothing grows
        now          = made();
      }
  }
} // namespace apps

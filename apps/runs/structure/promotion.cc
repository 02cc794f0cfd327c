#include "apps/runs/structure/promotion.h"

#include "apps/results/run_work.h"
#include "apps/specimens/specimen_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace apps
{
  using Eigen::Index;
  using Eigen::Vector3d;

  namespace
  {
    dem::LoadedMotion own(const dem::LoadedNetwork &network) { return dem::LoadedMotion(network.held.size()); }

    /** What of a motion a carrier can do itself. */
    base::Vector6 free_part(base::Vector6 motion, const dem::HeldMotions held)
    {
      for (int c = 0; c < dem::motions; ++c)
        if ((held & dem::HeldMotions(1u << c)) != 0)
          motion[c] = 0;
      return motion;
    }

    base::Vector6 motion_of(const PlaceMotion &place)
    {
      base::Vector6 motion;
      motion << place.displacement, place.rotation;
      return motion;
    }
  } // namespace

  Promotion::Promotion(const StructureModel &what, const dem::Packing &all, const ParticleMedia &of_particles)
    : model(what)
    , packing(all)
    , media(of_particles)
  {
    if (model.handshakes.promote())
      find_elements();
    now = made();
    if (!mesh)
      return;
    leave_out_burdened();
    refuse_empty();
    whole.emplace(dem::unloaded(model.network(packing)));
    bonds = std::make_unique<dem::DamagingLinks>(*whole, model.material.materials());
  }

  void Promotion::leave_out_burdened()
  {
    // Not those either beside which the overlap would come to a node that something else holds.
    const std::vector<Vector3d> burdened = now->surrounding()->burdened_nodes();
    auto                        of_one   = may.begin();
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      {
        for (const unsigned int element : mesh->around(burdened, handshake.width))
          of_one->erase(element);
        ++of_one;
      }
  }

  void Promotion::refuse_empty()
  {
    coupling::MeshElements::Set filled;
    for (const auto &place : now->surrounding()->motions_at(packing.centre, now->way().motion()))
      if (place)
        filled.insert(mesh->with_centre(place->element));
    auto of_one = may.begin();
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      {
        for (const unsigned int element : *of_one)
          if (filled.count(element) == 0)
            {
              const Vector3d centre = mesh->centre_of(element);
              throw base::InputError(fmt::format(
                "Handshakes/{}: Promotion reach = {:g}: no particle of the specimen lies in the element around "
                "({:g}, {:g}, {:g}), which could not become particles. The specimen has to fill what the reach "
                "has, with elements of two particles and more.",
                handshake.name, handshake.reach, centre.x(), centre.y(), centre.z()));
            }
        ++of_one;
      }
  }

  void Promotion::find_elements()
  {
    mesh = elements_of(model.continuum.mesh, model.dimension);
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      {
        const auto lie_within = [this, overlap = handshake.overlap()](const double reach) {
          return mesh->within([&](const Vector3d &place) {
            constexpr double rounding = 1e-9;
            return overlap.distance(place) <= reach + rounding * (1 + place.cwiseAbs().maxCoeff());
          });
        };
        first.push_back(mesh->filled(lie_within(0)));
        may.emplace_back();
        if (handshake.promotes())
          {
            const auto reached = lie_within(handshake.reach);
            std::set_difference(reached.begin(), reached.end(), first.back().begin(), first.back().end(),
                                std::inserter(may.back(), may.back().end()));
          }
      }
    region = first;
  }

  std::vector<std::size_t> Promotion::promotable() const
  {
    std::vector<std::size_t> counted;
    for (const coupling::MeshElements::Set &of_one : may)
      counted.push_back(of_one.size());
    return counted;
  }

  HandshakesSection Promotion::handshakes() const
  {
    if (!mesh)
      return model.handshakes;
    HandshakesSection made;
    std::size_t       h = 0;
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      made.handshakes.push_back(handshake.around(mesh->distance_from(region[h++], handshake.name)));
    return made;
  }

  StructureParts Promotion::parts()
  {
    StructureParts some;
    some.handshakes = handshakes();
    if (!mesh)
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
    for (std::size_t h = 0; h < region.size(); ++h)
      some.promoted.push_back(region[h].size() - first[h].size());
    return some;
  }

  std::unique_ptr<Structure> Promotion::made() { return std::make_unique<Structure>(model, parts(), media); }

  dem::LoadedMotion Promotion::motion_of_all()
  {
    const dem::LoadedMotion &of_awake = now->way().motion();
    in_solid                          = now->surrounding()->motions_at(packing.centre, of_awake);
    dem::LoadedMotion motion          = own(*whole);
    for (std::size_t i = 0; i < packing.size(); ++i)
      if (in_solid[i])
        motion.particles.col(static_cast<Index>(i)) = motion_of(*in_solid[i]);
    const std::vector<Vector3d> displacement = dem::displacements_of(now->network(), of_awake);
    for (std::size_t k = 0; k < awake.size(); ++k)
      {
        auto column = motion.particles.col(static_cast<Index>(awake[k]));
        column << displacement[k], of_awake.particles.col(static_cast<Index>(k)).tail<3>();
      }
    return motion;
  }

  bool Promotion::add_elements(const dem::LoadedMotion &motion)
  {
    bonds->evaluate(motion);
    const std::vector<coupling::MeshElements::Set> before = region;
    for (std::size_t l = 0; l < bonds->size(); ++l)
      for (const std::int32_t end : {whole->network.links[l].first, whole->network.links[l].second})
        {
          if (!in_solid[static_cast<std::size_t>(end)])
            continue;
          const double exertion = bonds->exertion(l);
          std::size_t  h        = 0;
          for (const HandshakeSection &handshake : model.handshakes.handshakes)
            {
              if (handshake.promotes() && exertion >= handshake.promote_at)
                if (const unsigned int element = mesh->with_centre(in_solid[static_cast<std::size_t>(end)]->element);
                    may[h].count(element) != 0)
                  region[h].insert(element);
              ++h;
            }
        }
    for (std::size_t h = 0; h < region.size(); ++h)
      region[h] = mesh->filled(region[h]);
    return region != before;
  }

  bool Promotion::promote()
  {
    if (!mesh)
      return false;
    const dem::LoadedMotion motion        = motion_of_all();
    const auto              region_before = region;
    const Numbers           awake_before  = awake;
    if (!add_elements(motion))
      return false;
    std::unique_ptr<Structure> before = std::move(now);
    try
      {
        now = made();
      }
    catch (const base::InputError &error)
      {
        now    = std::move(before);
        region = region_before;
        awake  = awake_before;
        throw StoppedShort(
          fmt::format("Promotion of elements to particles at the load factor {:.6g}: {} Make Promotion "
                      "reach smaller.",
                      now->load_factor(), error.what()));
      }
    go_on_from(*before, awake_before, motion);
    return true;
  }

  std::vector<std::optional<std::size_t>> Promotion::links_before(const Structure &before,
                                                                  const Numbers   &awake_before) const
  {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> number;
    const auto                                                &old = before.network().network.links;
    const auto key = [](const dem::ElasticLink &link, const Numbers &of_packing) {
      return std::pair{of_packing[static_cast<std::size_t>(link.first)],
                       of_packing[static_cast<std::size_t>(link.second)]};
    };
    for (std::size_t l = 0; l < old.size(); ++l)
      number.emplace(key(old[l], awake_before), l);
    std::vector<std::optional<std::size_t>> found;
    for (const dem::ElasticLink &link : now->network().network.links)
      {
        const auto at = number.find(key(link, awake));
        found.push_back(at == number.end() ? std::nullopt : std::optional(at->second));
      }
    return found;
  }

  void Promotion::go_on_from(const Structure &before, const Numbers &awake_before, const dem::LoadedMotion &motion)
  {
    const dem::LoadedNetwork &network = now->network();
    const dem::LoadedMotion  &old     = before.way().motion();
    dem::LoadedMotion         start   = own(network);
    start.loads                       = old.loads;
    const auto still_in_solid         = now->surrounding()->motions_at(packing.centre, start);
    for (std::size_t k = 0; k < awake.size(); ++k)
      {
        // Particles in elements move as these do, so that the ties are obeyed from the start.
        const std::size_t i     = awake[k];
        const auto        was   = std::lower_bound(awake_before.begin(), awake_before.end(), i);
        const bool        known = was != awake_before.end() && *was == i;
        start.particles.col(static_cast<Index>(k)) =
          still_in_solid[i] ? free_part(motion_of(*in_solid[i]), network.held[k]) :
          known             ? base::Vector6(old.particles.col(was - awake_before.begin())) :
                              free_part(motion.particles.col(static_cast<Index>(i)), network.held[k]);
      }
    const auto joints = before.surrounding()->motions_at(now->surrounding()->joint_places(), old);
    for (std::size_t j = 0; j < joints.size(); ++j)
      {
        const std::size_t carrier = awake.size() + j;
        base::Vector6     moved   = motion_of(*joints[j]);
        moved.tail<3>().setZero();
        start.particles.col(static_cast<Index>(carrier)) = free_part(moved, network.held[carrier]);
      }
    now->way().go_on_from(before.way(), start, links_before(before, awake_before));
  }

  void Promotion::visit_state(RunState &state)
  {
    if (!mesh)
      return;
    state.group("promotion");
    for (std::size_t h = 0; h < region.size(); ++h)
      {
        std::vector<std::int32_t> elements(region[h].begin(), region[h].end());
        state.column(fmt::format("elements_{}", h), elements);
        region[h] = coupling::MeshElements::Set(elements.begin(), elements.end());
      }
    if (state.reads() && region != first)
      now = made();
  }
} // namespace apps

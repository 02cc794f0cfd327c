#include "dem/facets/surface_contacts.h"

#include "base/errors.h"
#include "dem/kernels/kinematics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dem
{
  namespace
  {
    /** Particles that one thread looks at in a row. */
    constexpr std::size_t particles_per_piece = 32;

    Vec<double, 3>  plain(const Eigen::Vector3d &v) { return {{v[0], v[1], v[2]}}; }
    Eigen::Vector3d vector(const Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }

    Eigen::Vector3d record(const base::Column &column, const std::int32_t particle, const int from)
    {
      return Eigen::Vector3d(
        &column[record_size * static_cast<std::size_t>(particle) + static_cast<std::size_t>(from)]);
    }

    [[noreturn]] void refuse_sunk(const Particles &p, const std::int32_t i, const Surface &surface)
    {
      std::ostringstream message;
      message << "particle " << p.number[static_cast<std::size_t>(i)] + 1 << " has sunk into wall " << surface.name
              << " by its radius. Raise the wall's Effective modulus, or lower the load or Time/Step factor.";
      throw base::NumericalError(message.str());
    }
  } // namespace

  struct SurfaceContacts::Block
  {
    std::vector<SurfaceContact> contacts;
    std::vector<VertexPart>     parts;
    std::vector<NearPoint>      near;  ///< kept for its memory, as is the next
    std::vector<SurfaceContact> fresh; ///< of one particle and surface, without history
    SpreadContact               spread;
    std::int32_t                sunk = -1, sunk_into = 0;
  };

  Eigen::Vector3d SurfaceContact::moment() const
  {
    const Eigen::Vector3d branch = distance * direction, sheared = force - push;
    return branch.cross(sheared);
  }

  std::size_t SurfaceContacts::add(const SurfaceParameters &parameters,
                                   const int                dimension,
                                   const bool               friction,
                                   std::vector<bool>        meets)
  {
    check_facets(parameters.mesh, parameters.name, dimension);
    all.emplace_back(parameters, friction, std::move(meets));
    forget_places();
    return all.size() - 1;
  }

  const std::vector<std::int32_t> &SurfaceContacts::find_forces(const Particles &particles, const ParticleShape &shape)
  {
    born.clear();
    if (found)
      return born;
    clear_forces();
    if (!contacts.empty() || near.can_touch())
      {
        if (near.can_touch())
          near.look(particles, all);
        find_contacts(particles, shape);
        hand_out(particles, shape);
      }
    find_bonds(particles);
    found = true;
    return born;
  }

  void SurfaceContacts::clear_forces()
  {
    for (Surface &surface : all)
      surface.clear_totals();
    for (const SurfaceContact &contact : contacts)
      {
        std::fill_n(&records[record_size * static_cast<std::size_t>(contact.particle)], record_size, 0.0);
        for_parts(contact, [&](Surface &surface, const std::size_t vertex, const VertexPart &) {
          surface.force[vertex].setZero();
          surface.stiffness[vertex] = 0;
        });
      }
    for (const SurfaceBonds &glue : glues)
      {
        Surface &surface = all[static_cast<std::size_t>(glue.surface())];
        for (std::size_t b = 0; b < glue.count() && !records.empty(); ++b)
          std::fill_n(&records[record_size * static_cast<std::size_t>(glue.particle_of(b))], record_size, 0.0);
        for (const VertexPart &part : glue.parts())
          {
            surface.force[static_cast<std::size_t>(part.vertex)].setZero();
            surface.stiffness[static_cast<std::size_t>(part.vertex)] = 0;
          }
      }
  }

  bool SurfaceContacts::holding() const
  {
    return std::any_of(glues.begin(), glues.end(), [](const SurfaceBonds &glue) { return glue.holds(); });
  }

  std::vector<std::int32_t> SurfaceContacts::glue(const std::size_t              surface,
                                                  const double                   within,
                                                  std::shared_ptr<const LinkLaw> law,
                                                  const Particles               &particles,
                                                  const ParticleShape           &shape,
                                                  const bool                     rotations)
  {
    const Surface &to = all.at(surface);
    if (to.mesh.is_plane())
      throw base::InputError("wall " + to.name + ": nothing is glued to an unbounded plane. Take a plate of facets.");
    glues.emplace_back(static_cast<std::int32_t>(surface), all, particles, shape, within, std::move(law), rotations);
    std::vector<std::int32_t> glued;
    for (std::size_t b = 0; b < glues.back().count(); ++b)
      {
        glued.push_back(glues.back().particle_of(b));
        let_meet(surface, glued.back(), false, particles.count);
      }
    all[surface].glued += static_cast<std::int64_t>(glued.size());
    return glued;
  }

  void SurfaceContacts::let_meet(const std::size_t  surface,
                                 const std::int32_t particle,
                                 const bool         meets,
                                 const std::size_t  particles)
  {
    std::vector<bool> &those = all[surface].meets;
    if (those.empty())
      those.assign(particles, true);
    those[static_cast<std::size_t>(particle)] = meets;
    near.forget();
  }

  void SurfaceContacts::find_bonds(const Particles &particles)
  {
    if (holding() && records.empty())
      records.assign(record_size * particles.count, 0.0);
    for (SurfaceBonds &glue : glues)
      {
        const auto s = static_cast<std::size_t>(glue.surface());
        for (const std::int32_t i : glue.find_forces(particles, all[s]))
          let_meet(s, i, true, particles.count);
        if (!records.empty())
          glue.hand_out(records, all[s]);
      }
  }

  void SurfaceContacts::check_start(const Particles &particles)
  {
    near.look(particles, all);
    for (std::size_t k = 0; k < near.particles().size(); ++k)
      for (const NearFacet *pair = near.begin(k); pair != near.end(k); ++pair)
        {
          const auto     i       = static_cast<std::size_t>(near.particles()[k]);
          const Surface &surface = all[static_cast<std::size_t>(pair->surface)];
          const double   radius  = particles.radius_of(i),
                       inside =
                         radius - surface.distance(static_cast<std::size_t>(pair->facet), particles.position_of(i));
          if (inside <= 0.5 * radius)
            continue;
          std::ostringstream message;
          message << "wall " << surface.name << ": particle " << particles.number[i] + 1 << " at ("
                  << particles.position_of(i).transpose() << ") m lies in it";
          if (surface.mesh.is_plane() && inside > radius)
            message << " or behind it, by " << inside;
          else
            message << " by " << inside;
          message << " m; up to half its radius (" << radius << " m) is taken. Move one of the two.";
          throw base::InputError(message.str());
        }
  }

  void SurfaceContacts::find_contacts(const Particles &particles, const ParticleShape &shape)
  {
    std::vector<std::size_t> active;
    for (std::size_t k = 0; k < near.particles().size(); ++k)
      if (near.within_reach(k))
        active.push_back(k);
    std::vector<Block> blocks((active.size() + particles_per_piece - 1) / particles_per_piece);
    const auto         pieces = static_cast<std::ptrdiff_t>(blocks.size());
#pragma omp parallel for schedule(static) if (pieces > 1)
    for (std::ptrdiff_t b = 0; b < pieces; ++b)
      {
        const std::size_t from = static_cast<std::size_t>(b) * particles_per_piece,
                          to   = std::min(from + particles_per_piece, active.size());
        for (std::size_t k = from; k < to; ++k)
          touch(particles, shape, active[k], blocks[static_cast<std::size_t>(b)]);
      }
    std::vector<SurfaceContact> now;
    vertex_parts.clear();
    for (const Block &block : blocks)
      {
        if (block.sunk >= 0)
          refuse_sunk(particles, block.sunk, all[static_cast<std::size_t>(block.sunk_into)]);
        const auto shift = static_cast<std::int32_t>(vertex_parts.size());
        for (SurfaceContact contact : block.contacts)
          {
            contact.parts_begin += shift;
            contact.parts_end += shift;
            now.push_back(contact);
          }
        vertex_parts.insert(vertex_parts.end(), block.parts.begin(), block.parts.end());
      }
    settle(std::move(now), particles, shape);
  }

  namespace
  {
    /** Nearest points within reach of the facets of one surface; false where the centre is on or behind one. */
    bool points_within(const Surface          &surface,
                       const NearFacets       &lists,
                       const NearFacet        *from,
                       const NearFacet        *to,
                       const Eigen::Vector3d  &centre,
                       const double            radius,
                       std::vector<NearPoint> &points)
    {
      const double look = surface.look(radius);
      points.clear();
      for (; from != to; ++from)
        {
          if (!lists.within_reach(*from))
            continue;
          const auto            facet  = static_cast<std::size_t>(from->facet);
          const FacetPoint      point  = closest_on_facet(surface.mesh, surface.place, facet, centre);
          const Eigen::Vector3d branch = point.place - centre;
          const double          distance =
            surface.mesh.is_plane() ? surface.mesh.normal.dot(centre - surface.place[0]) : branch.norm();
          if (distance >= look)
            continue;
          if (!(distance > 1e-9 * radius))
            return false;
          points.push_back({from->facet, point, distance,
                            surface.mesh.is_plane() ? Eigen::Vector3d(-surface.mesh.normal) : branch / distance});
        }
      return true;
    }
  } // namespace

  void SurfaceContacts::touch(const Particles     &particles,
                              const ParticleShape &shape,
                              const std::size_t    listed,
                              Block               &block) const
  {
    const std::int32_t    i      = near.particles()[listed];
    const Eigen::Vector3d centre = particles.position_of(static_cast<std::size_t>(i));
    const double          radius = particles.radius_of(static_cast<std::size_t>(i));
    auto                  before = std::lower_bound(contacts.begin(), contacts.end(), i,
                                                    [](const SurfaceContact &c, const std::int32_t p) { return c.particle < p; });
    for (const NearFacet *from = near.begin(listed), *end = near.end(listed); from != end;)
      {
        const std::int32_t s  = from->surface;
        const NearFacet   *to = from;
        while (to != end && to->surface == s)
          ++to;
        const Surface &surface = all[static_cast<std::size_t>(s)];
        const bool     outside = points_within(surface, near, from, to, centre, radius, block.near);
        from                   = to;
        if (!outside)
          {
            block.sunk      = i;
            block.sunk_into = s;
            return;
          }
        if (block.near.empty())
          continue;
        while (before != contacts.end() && before->particle == i && before->surface < s)
          ++before;
        auto before_end = before;
        while (before_end != contacts.end() && before_end->particle == i && before_end->surface == s)
          ++before_end;
        block.fresh.clear();
        if (surface.skin > 0)
          add_patch(surface, shape, radius, centre, block);
        else
          add_zones(surface, shape, radius, centre, block);
        std::vector<bool> taken(static_cast<std::size_t>(before_end - before), false);
        for (SurfaceContact &now : block.fresh)
          {
            now.particle = i;
            now.surface  = s;
            // History goes with the zone that lies nearest to where it was: over edges, from facet to facet.
            const SurfaceContact *same = nullptr;
            double                most = 0.5; // within 60 degrees
            for (auto old = before; old != before_end; ++old)
              if (!taken[static_cast<std::size_t>(old - before)] && old->direction.dot(now.direction) > most)
                {
                  most = old->direction.dot(now.direction);
                  same = &*old;
                }
            if (same)
              taken[static_cast<std::size_t>(same - &*before)] = true;
            follow(particles, shape, same, now, block.parts);
            block.contacts.push_back(now);
          }
      }
  }

  void SurfaceContacts::add_zones(const Surface         &surface,
                                  const ParticleShape   &shape,
                                  const double           radius,
                                  const Eigen::Vector3d &centre,
                                  Block                 &block) const
  {
    const auto   corners = static_cast<std::size_t>(surface.mesh.corners);
    const double look    = surface.look(radius);
    for (ContactZone &zone : contact_zones(block.near, centre, look))
      {
        zone.overlap -= look - radius;
        const bool spread = surface.footprint.given() &&
                            surface.footprint.spread(surface.mesh, surface.place, zone, radius, block.spread);
        if (spread)
          {
            zone.overlap   = block.spread.overlap;
            zone.place     = block.spread.place;
            zone.distance  = (zone.place - centre).norm();
            zone.direction = (zone.place - centre) / zone.distance;
          }
        if (!(zone.overlap > 0)) // looked for further than it reaches
          continue;
        SurfaceContact now{};
        now.facet       = zone.facet;
        now.place       = zone.place;
        now.direction   = zone.direction;
        now.distance    = zone.distance;
        now.share       = zone.share;
        now.overlap     = zone.overlap;
        now.stiffness   = now.area(shape, radius) * surface.contact.normal / radius;
        now.pressing    = now.stiffness * now.overlap;
        now.push        = -now.pressing * now.direction;
        now.spring      = 0.5 * now.pressing * now.overlap;
        now.parts_begin = static_cast<std::int32_t>(block.parts.size());
        const auto add  = [&](const std::int32_t vertex, const double weight) {
          if (weight != 0)
            block.parts.push_back({vertex, weight, -weight * now.push, weight * now.stiffness});
        };
        if (spread)
          for (const VertexWeight &part : block.spread.weights)
            add(part.vertex, part.weight);
        else
          for (const ContactZone::Part &part : zone.parts)
            for (std::size_t c = 0; c < corners; ++c)
              add(surface.mesh.facet[static_cast<std::size_t>(part.facet)][c], part.weight[c]);
        now.parts_end = static_cast<std::int32_t>(block.parts.size());
        block.fresh.push_back(now);
      }
  }

  void SurfaceContacts::add_patch(const Surface         &surface,
                                  const ParticleShape   &shape,
                                  const double           radius,
                                  const Eigen::Vector3d &centre,
                                  Block                 &block) const
  {
    SurfaceContact now{};
    now.parts_begin          = static_cast<std::int32_t>(block.parts.size());
    const double       thick = surface.mesh.corners == 2 ? shape.link_area(radius, radius) / (2 * radius) : 1.0;
    const PressedPatch patch = press(surface, block.near, centre, radius, thick, block.parts);
    if (!patch.touches())
      return;
    now.facet     = patch.facet;
    now.place     = patch.place;
    now.distance  = (patch.place - centre).norm();
    now.direction = (patch.place - centre) / now.distance;
    now.share     = patch.stiffness * radius / (shape.link_area(radius, radius) * surface.contact.normal);
    now.overlap   = patch.deepest;
    now.stiffness = patch.stiffness;
    now.pressing  = patch.total;
    now.push      = patch.push;
    now.spring    = patch.spring;
    now.parts_end = static_cast<std::int32_t>(block.parts.size());
    block.fresh.push_back(now);
  }

  void SurfaceContacts::follow(const Particles         &particles,
                               const ParticleShape     &shape,
                               const SurfaceContact    *before,
                               SurfaceContact          &now,
                               std::vector<VertexPart> &parts_of_now) const
  {
    const std::int32_t    i       = now.particle;
    const Surface        &surface = all[static_cast<std::size_t>(now.surface)];
    const double          radius  = particles.radius_of(static_cast<std::size_t>(i));
    const Eigen::Vector3d moved = record(particles.motion, i, 0), turn = record(particles.motion, i, 3),
                          arm_turn = record(particles.pose, i, 3);
    Eigen::Vector3d carried_along  = Eigen::Vector3d::Zero();
    for (std::int32_t k = now.parts_begin; k < now.parts_end; ++k)
      carried_along += parts_of_now[static_cast<std::size_t>(k)].weight *
                       surface.motion[static_cast<std::size_t>(parts_of_now[static_cast<std::size_t>(k)].vertex)];
    // As of a link from the sphere, with all of its length as arm, to the point of the surface (doc/theory/facets.md, 3).
    const Eigen::Vector3d branch = now.distance * now.direction, opening = carried_along - moved,
                          middle = branch - 0.5 * opening, slip = opening - arm_turn.cross(middle);
    const Vec<double, 3> n1 = plain(now.direction);
    Vec<double, 3>       n0 = n1, shear = {{0, 0, 0}};
    Eigen::Vector3d      mean = now.direction;
    if (before)
      {
        const Vec<double, 3> mean_turn = plain(0.5 * (turn + surface.turn_of(static_cast<std::size_t>(now.facet))));
        const auto           c         = rotation_coefficients(dot(mean_turn, mean_turn));
        n0                             = rotate(c, mean_turn, plain(before->direction));
        shear                          = rotate(c, mean_turn, plain(before->shear));
        mean                           = (now.direction + before->direction).normalized();
      }
    const Eigen::Vector3d across = slip - mean.dot(slip) * mean;
    const Vec<double, 3>  added  = (1 / radius) * transport(plain(mean), n1, plain(across));
    const double          area   = now.area(shape, radius);
    double                lost   = 0;
    if (before && surface.skin > 0)
      {
        // A patch that grows pulls no more for that, and what is gone of it takes its pull along: shear can only lose energy.
        const double grown = now.share / before->share, spring = 0.5 * area * radius * surface.contact.shear;
        const double was = spring / grown * dot(shear, shear);
        if (grown > 1)
          shear = (1 / grown) * shear;
        lost = was - spring * dot(shear, shear);
      }
    shear = carried(n0, n1, shear, added);

    // The overlap that presses as much at a point.
    const double     strain = -now.pressing / (area * surface.contact.normal);
    LinkWork<double> work;
    const auto answer = linear_contact_force<LinearContactConstants, double, 3>(surface.contact, strain, area, radius,
                                                                                added, shear, work);
    now.shear         = vector(shear);
    now.force         = now.push + vector(answer.shear);
    now.dissipated    = work.friction + lost;
    for (std::int32_t k = now.parts_begin; k < now.parts_end; ++k)
      {
        VertexPart &part = parts_of_now[static_cast<std::size_t>(k)];
        part.force -= part.weight * vector(answer.shear);
      }
  }

  void
  SurfaceContacts::settle(std::vector<SurfaceContact> &&now, const Particles &particles, const ParticleShape &shape)
  {
    // Both lists are sorted alike: by particle and surface. What is there fewer times now has let go.
    const auto same = [](const SurfaceContact &a, const SurfaceContact &b) {
      return a.particle == b.particle && a.surface == b.surface;
    };
    const auto before = [](const SurfaceContact &a, const SurfaceContact &b) {
      return a.particle != b.particle ? a.particle < b.particle : a.surface < b.surface;
    };
    auto old = contacts.begin();
    for (auto next = now.begin(); next != now.end() || old != contacts.end();)
      {
        if (next == now.end() || (old != contacts.end() && before(*old, *next)))
          {
            SurfaceContact gone = *old++;
            gone.spring         = 0; // only shear is left
            let_go += stored(gone, shape, particles);
          }
        else if (old == contacts.end() || !same(*old, *next))
          {
            if (born.empty() || born.back() != next->particle)
              born.push_back(next->particle);
            ++next;
          }
        else
          {
            if (next->stiffness > old->stiffness && all[static_cast<std::size_t>(next->surface)].skin > 0 &&
                (born.empty() || born.back() != next->particle))
              born.push_back(next->particle);
            ++old, ++next;
          }
      }
    contacts = std::move(now);
    for (const SurfaceContact &contact : contacts)
      slid += contact.dissipated;
  }

  void SurfaceContacts::hand_out(const Particles &particles, const ParticleShape &shape)
  {
    if (!contacts.empty() && records.empty())
      records.assign(record_size * particles.count, 0.0);
    for (const SurfaceContact &contact : contacts)
      {
        Surface     &surface = all[static_cast<std::size_t>(contact.surface)];
        const double radius  = particles.radius_of(static_cast<std::size_t>(contact.particle));
        const double normal = contact.stiffness, shear = contact.area(shape, radius) * surface.contact.shear / radius;
        double      *sum             = &records[record_size * static_cast<std::size_t>(contact.particle)];
        const Eigen::Vector3d branch = contact.distance * contact.direction, sheared = contact.force - contact.push;
        const Eigen::Vector3d moment = contact.moment();
        for (int c = 0; c < 3; ++c)
          {
            sum[c] += contact.force[c];
            sum[3 + c] += moment[c];
          }
        for_parts(contact, [&](Surface &of, const std::size_t vertex, const VertexPart &part) {
          of.force[vertex] += part.force;
          of.stiffness[vertex] += std::max(part.stiffness, part.weight * shear);
        });
        surface.total_force -= contact.force;
        surface.total_moment -= contact.place.cross(sheared) + (contact.place - branch).cross(contact.push);
        const double along = contact.direction.dot(surface.servo.direction), squared = along * along;
        surface.along += squared * normal + (surface.servo.direction.squaredNorm() - squared) * shear;
        ++surface.touching;
      }
  }

  void SurfaceContacts::rest()
  {
    for (Surface &surface : all)
      {
        std::fill(surface.motion.begin(), surface.motion.end(), Eigen::Vector3d::Zero());
        surface.turn.setZero();
      }
  }

  double SurfaceContacts::advance(const double step)
  {
    double largest = 0;
    for (Surface &surface : all)
      {
        surface.serve(step);
        largest = std::max(largest, surface.advance(step));
      }
    found = false;
    return largest;
  }
} // namespace dem

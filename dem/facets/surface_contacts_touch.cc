// Where particles touch surfaces, how hard, and with what history.

#include "dem/facets/crossing.h"
#include "dem/facets/surface_contacts.h"
#include "dem/kernels/kinematics.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Particles that one thread treats in a row. */
    constexpr std::size_t particles_per_piece = 32;
    /** Vertices of most contacts: a triangle's. */
    constexpr std::size_t corners_of_most = 3;

    Vec<double, 3>  plain(const Eigen::Vector3d &v) { return {{v[0], v[1], v[2]}}; }
    Eigen::Vector3d vector(const Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }

    Eigen::Vector3d record(const base::Column &column, const std::int32_t particle, const int from)
    {
      return Eigen::Vector3d(
        &column[record_size * static_cast<std::size_t>(particle) + static_cast<std::size_t>(from)]);
    }

    /** Of the point of a surface on which a contact is, in the last step [m]. */
    Eigen::Vector3d
    motion_under(const SurfaceContact &contact, const std::vector<VertexPart> &parts, const Surface &surface)
    {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::int32_t k = contact.parts_begin; k < contact.parts_end; ++k)
        {
          const VertexPart &part = parts[static_cast<std::size_t>(k)];
          sum += part.weight * surface.motion[static_cast<std::size_t>(part.vertex)];
        }
      return sum;
    }
  } // namespace

  /** Memory that a thread uses again for every particle. */
  struct SurfaceContacts::Room
  {
    std::vector<NearPoint>      near;
    double                      cut = 0; ///< off the particle that is treated [m]
    ZoneRoom                    zones;
    SpreadRoom                  spread;
    std::vector<StandingSphere> standing;           ///< the particle, then those beside it
    Known                       before, before_end; ///< its contacts with the surface in the step before
    std::vector<SurfaceContact> fresh;              ///< of one particle and surface, without history
    std::vector<char>           taken;              ///< which of those before go on in one of them

    /** Where the contact of a zone stood on its flat face in the step before. */
    FacePoint stood(const Surface &surface, const ContactZone &zone, const double radius) const
    {
      constexpr double same    = 0.25; // over the radius; further away it is another contact
      double           nearest = same * radius;
      FacePoint        stands;
      for (Known old = before; old != before_end; ++old)
        if (surface.footprint.share_face(old->stands.facet, zone.facet) && (old->place - zone.place).norm() < nearest)
          {
            nearest = (old->place - zone.place).norm();
            stands  = old->stands;
          }
      return stands;
    }
  };

  struct SurfaceContacts::Block
  {
    Room                       *room = nullptr; ///< of the thread
    std::vector<SurfaceContact> contacts;
    std::vector<VertexPart>     parts;
    Sunk                        sunk;
  };

  void SurfaceContacts::find_contacts(const Particles      &particles,
                                      const ParticleShape  &shape,
                                      const SharedSurfaces &with_others)
  {
    std::vector<std::size_t> active;
    for (std::size_t k = 0; k < near.particles().size(); ++k)
      if (near.within_reach(k) && with_others.owns(near.particles()[k]))
        active.push_back(k);
    std::vector<Block> blocks((active.size() + particles_per_piece - 1) / particles_per_piece);
    const auto         pieces = static_cast<std::ptrdiff_t>(blocks.size());
#pragma omp parallel if (pieces > 1)
    {
      Room room;
#pragma omp for schedule(static)
      for (std::ptrdiff_t b = 0; b < pieces; ++b)
        {
          Block            &block = blocks[static_cast<std::size_t>(b)];
          const std::size_t from  = static_cast<std::size_t>(b) * particles_per_piece,
                            to    = std::min(from + particles_per_piece, active.size());
          block.room              = &room;
          block.contacts.reserve(to - from);
          block.parts.reserve(corners_of_most * (to - from));
          for (std::size_t k = from; k < to; ++k)
            touch(particles, shape, active[k], block);
        }
    }
    const auto sunk =
      std::find_if(blocks.begin(), blocks.end(), [](const Block &block) { return block.sunk.particle >= 0; });
    take(gathered(blocks), sunk == blocks.end() ? Sunk() : sunk->sunk, particles, shape, with_others);
  }

  std::vector<SurfaceContact> SurfaceContacts::gathered(const std::vector<Block> &blocks)
  {
    std::size_t count = 0, parts = 0;
    for (const Block &block : blocks)
      {
        count += block.contacts.size();
        parts += block.parts.size();
      }
    std::vector<SurfaceContact> now;
    now.reserve(count);
    vertex_parts.clear();
    vertex_parts.reserve(parts);
    for (const Block &block : blocks)
      {
        const auto shift = static_cast<std::int32_t>(vertex_parts.size());
        for (const SurfaceContact &contact : block.contacts)
          {
            now.push_back(contact);
            now.back().parts_begin += shift;
            now.back().parts_end += shift;
          }
        vertex_parts.insert(vertex_parts.end(), block.parts.begin(), block.parts.end());
      }
    return now;
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
      const double search = surface.search_radius(radius);
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
          if (distance >= search)
            continue;
          if (!(distance > 1e-9 * radius))
            return false;
          points.push_back({from->facet, point, distance,
                            surface.mesh.is_plane() ? Eigen::Vector3d(-surface.mesh.normal) : branch / distance});
        }
      return true;
    }

    /**
     * Which side of the surface a centre is on. Within a body, what counts is the nearest point alone, at a negative distance and with
     * the direction that it had outside; false where the centre has gone through facets that let nothing pass.
     *
     * @param was_within after the step before @param points within reach, of all facets
     */
    bool finds_side(const Surface          &surface,
                    const Eigen::Vector3d  &centre,
                    const Eigen::Vector3d  &moved,
                    const bool              was_within,
                    std::vector<NearPoint> &points)
    {
      if (points.empty())
        return !was_within;
      if (!was_within && !goes_through(surface, points, centre, moved))
        return true;
      if (!surface.holds_from_within())
        return false;
      NearPoint nearest = *std::min_element(points.begin(), points.end(), [](const NearPoint &a, const NearPoint &b) {
        return a.distance != b.distance ? a.distance < b.distance : a.facet < b.facet;
      });
      if (!lies_behind(surface, points, nearest, centre))
        return true;
      nearest.distance *= -1;
      nearest.direction *= -1;
      points.assign(1, nearest);
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
        while (before != contacts.end() && before->particle == i && before->surface < s)
          ++before;
        auto before_end = before;
        while (before_end != contacts.end() && before_end->particle == i && before_end->surface == s)
          ++before_end;
        const bool was_within = std::any_of(before, before_end, [](const SurfaceContact &c) { return c.distance < 0; });
        const bool holds      = points_within(surface, near, from, to, centre, radius, block.room->near) &&
                           finds_side(surface, centre, record(particles.motion, i, 0), was_within, block.room->near);
        from = to;
        if (!holds)
          {
            block.sunk = {i, s};
            return;
          }
        if (block.room->near.empty())
          continue;
        block.room->fresh.clear();
        block.room->cut        = surface.cut_of(i);
        block.room->before     = before;
        block.room->before_end = before_end;
        if (surface.footprint.given())
          gather_beside(particles, listed, surface, block);
        if (surface.skin > 0)
          add_patch(surface, shape, radius, centre, block);
        else
          add_zones(surface, shape, radius, centre, block);
        for (SurfaceContact &now : block.room->fresh)
          {
            now.particle = i;
            now.surface  = s;
          }
        go_on(particles, shape, block);
      }
  }

  void SurfaceContacts::go_on(const Particles &particles, const ParticleShape &shape, Block &block) const
  {
    const Known        before = block.room->before, before_end = block.room->before_end;
    std::vector<char> &taken = block.room->taken;
    taken.assign(static_cast<std::size_t>(before_end - before), 0);
    for (SurfaceContact &now : block.room->fresh)
      {
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
          taken[static_cast<std::size_t>(same - &*before)] = 1;
        follow(particles, shape, same, now, block.parts);
        block.contacts.push_back(now);
      }
    if (!block.room->fresh.empty() && before != before_end)
      block.contacts.back().made = made_by_last(block.room->fresh.size(), particles, block);
  }

  double SurfaceContacts::made_by_last(const std::size_t count, const Particles &particles, const Block &block) const
  {
    const Surface &surface = all[static_cast<std::size_t>(block.contacts.back().surface)];
    if (surface.skin > 0) // pressure is a slope
      return 0;
    const Eigen::Vector3d moved = record(particles.motion, block.contacts.back().particle, 0);
    // Either push works on both sides over half of the step, each by its own weights.
    const auto worked = [&](const SurfaceContact &contact, const std::vector<VertexPart> &parts) {
      return 0.5 * contact.push.dot(moved - motion_under(contact, parts, surface));
    };
    double made = 0;
    for (auto old = block.room->before; old != block.room->before_end; ++old)
      made += worked(*old, vertex_parts) - old->spring;
    for (auto now = block.contacts.end() - static_cast<std::ptrdiff_t>(count); now != block.contacts.end(); ++now)
      made += worked(*now, block.parts) + now->spring;
    return made;
  }

  void SurfaceContacts::gather_beside(const Particles  &particles,
                                      const std::size_t listed,
                                      const Surface    &surface,
                                      Block            &block) const
  {
    const auto sphere = [&](const std::int32_t i) {
      return StandingSphere{particles.position_of(static_cast<std::size_t>(i)),
                            particles.radius_of(static_cast<std::size_t>(i))};
    };
    block.room->standing = {sphere(near.particles()[listed])};
    for (const std::int32_t *other = beside.begin(listed); other != beside.end(listed); ++other)
      if (surface.meets_particle(*other))
        block.room->standing.push_back(sphere(*other));
  }

  namespace
  {
    /** Pressure at rest, its slope, and what it stores. */
    void press(const Surface &surface, const ParticleShape &shape, const double radius, SurfaceContact &now)
    {
      if (const auto &linear = surface.law.linear())
        {
          now.stiffness = now.area(shape, radius) * linear->normal / radius;
          now.pressing  = now.stiffness * now.overlap;
          now.spring    = 0.5 * now.pressing * now.overlap;
          return;
        }
      const FaceContact  face  = now.of_law(shape, radius);
      const FacePressure found = surface.law.press(face, surface.law.begin(radius, face.area, 0));
      now.stiffness            = found.stiffness;
      now.pressing             = found.force;
      now.spring               = found.stored;
    }
  } // namespace

  void SurfaceContacts::add_zones(const Surface         &surface,
                                  const ParticleShape   &shape,
                                  const double           radius,
                                  const Eigen::Vector3d &centre,
                                  Block                 &block) const
  {
    const auto   corners = static_cast<std::size_t>(surface.mesh.corners);
    const double search  = surface.search_radius(radius);
    if (surface.footprint.given())
      surface.footprint.keep_own(surface.mesh, surface.place, centre, block.room->near);
    contact_zones(block.room->near, centre, search, block.room->zones);
    for (ContactZone &zone : block.room->zones.zones)
      {
        zone.overlap -= search - radius + block.room->cut;
        const bool spread =
          surface.footprint.given() && surface.footprint.spread(surface.mesh, surface.place, zone,
                                                                {block.room->standing, radius - block.room->cut,
                                                                 block.room->stood(surface, zone, radius)},
                                                                block.room->spread);
        const SpreadContact &mean = block.room->spread.found;
        if (spread)
          {
            zone.overlap   = mean.overlap;
            zone.place     = mean.place;
            zone.distance  = (zone.place - centre).norm();
            zone.direction = (zone.place - centre) / zone.distance;
          }
        if (!(zone.overlap > 0)) // sought further than it reaches
          continue;
        SurfaceContact now{};
        now.facet     = zone.facet;
        now.place     = zone.place;
        now.direction = zone.direction;
        now.distance  = zone.distance;
        now.share     = zone.share;
        now.overlap   = zone.overlap;
        press(surface, shape, radius, now);
        now.push        = -now.pressing * now.direction;
        now.parts_begin = static_cast<std::int32_t>(block.parts.size());
        const auto add  = [&](const std::int32_t vertex, const double weight) {
          if (weight != 0)
            block.parts.push_back({vertex, weight, -weight * now.push, weight * now.stiffness});
        };
        if (spread)
          {
            now.stands = mean.stands;
            for (const VertexWeight &part : mean.weights)
              add(part.vertex, part.weight);
          }
        else
          for (const ContactZone::Part &part : zone.parts)
            for (std::size_t c = 0; c < corners; ++c)
              add(surface.mesh.facet[static_cast<std::size_t>(part.facet)][c], part.weight[c]);
        now.parts_end = static_cast<std::int32_t>(block.parts.size());
        block.room->fresh.push_back(now);
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
    const PressedPatch patch = press(surface, block.room->near, centre, radius, thick, block.parts);
    if (!patch.touches())
      return;
    now.facet     = patch.facet;
    now.place     = patch.place;
    now.distance  = (patch.place - centre).norm();
    now.direction = (patch.place - centre) / now.distance;
    now.share     = patch.stiffness * radius / (shape.link_area(radius, radius) * surface.law.linear()->normal);
    now.overlap   = patch.deepest;
    now.stiffness = patch.stiffness;
    now.pressing  = patch.total;
    now.push      = patch.push;
    now.spring    = patch.spring;
    now.parts_end = static_cast<std::int32_t>(block.parts.size());
    block.room->fresh.push_back(now);
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
                          arm_turn      = record(particles.pose, i, 3);
    const Eigen::Vector3d carried_along = motion_under(now, parts_of_now, surface);
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
        const double grown = now.share / before->share, spring = 0.5 * area * radius * surface.law.linear()->shear;
        const double was = spring / grown * dot(shear, shear);
        if (grown > 1)
          shear = (1 / grown) * shear;
        lost = was - spring * dot(shear, shear);
      }
    now.shear                     = vector(carried(n0, n1, 1 / (1 + dot(n0, n1)), shear, added));
    const Eigen::Vector3d besides = answer(particles, shape, before, added, now.direction.dot(opening), lost, now);
    now.force                     = now.push + besides;
    for (std::int32_t k = now.parts_begin; k < now.parts_end; ++k)
      {
        VertexPart &part = parts_of_now[static_cast<std::size_t>(k)];
        part.force -= part.weight * besides;
      }
  }

  Eigen::Vector3d SurfaceContacts::answer(const Particles      &particles,
                                          const ParticleShape  &shape,
                                          const SurfaceContact *before,
                                          const Vec<double, 3> &added,
                                          const double          opening,
                                          const double          lost,
                                          SurfaceContact       &now) const
  {
    const auto        i      = static_cast<std::size_t>(now.particle);
    const SurfaceLaw &law    = all[static_cast<std::size_t>(now.surface)].law;
    const double      radius = particles.radius_of(i);
    if (const auto &linear = law.linear())
      {
        // The overlap that presses as much at a point.
        const double     area = now.area(shape, radius), strain = -now.pressing / (area * linear->normal);
        Vec<double, 3>   shear = plain(now.shear);
        LinkWork<double> work;
        const auto       sheared =
          linear_contact_force<LinearContactConstants, double, 3>(*linear, strain, area, radius, added, shear, work);
        now.shear      = vector(shear);
        now.dissipated = work.friction + lost;
        return vector(sheared.shear);
      }
    const FaceContact face = now.of_law(shape, radius, before ? before->overlap : now.overlap + opening);
    now.memory =
      before ? before->memory : law.begin(radius, face.area, shape.denser(particles, i) * shape.mass(radius));
    const FaceAnswer besides =
      law.follow(face, now.pressing, now.direction, vector(added), rate, now.shear, now.memory);
    now.dissipated = besides.friction + lost;
    now.viscous    = besides.viscous;
    now.dashpot    = besides.dashpot;
    return besides.force;
  }
} // namespace dem

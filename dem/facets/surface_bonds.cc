#include "dem/facets/surface_bonds.h"

#include "base/errors.h"
#include "dem/facets/facet_spin.h"
#include "dem/facets/glue_output.h"
#include "dem/integrators/stable_step.h"
#include "dem/measures/link_measures.h"
#include "dem/model/materials.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  using Eigen::Vector3d;

  SurfaceBonds::SurfaceBonds(const std::int32_t             number,
                             const std::vector<Surface>    &surfaces,
                             const Particles               &particles,
                             const ParticleShape           &shape,
                             const double                   within,
                             std::shared_ptr<const LinkLaw> law_of_bonds,
                             const bool                     rotations)
    : surface_number(number)
    , law(std::move(law_of_bonds))
    , pass(law->pass(law->several() ? Mixture::materials : Mixture::radii))
  {
    find_anchors(surfaces, particles, within);
    make_bodies(particles);
    follow(particles, surfaces[static_cast<std::size_t>(number)]);
    make_bonds(shape, rotations);
  }

  void SurfaceBonds::find_anchors(const std::vector<Surface> &surfaces, const Particles &particles, const double within)
  {
    const Surface &surface = surfaces[static_cast<std::size_t>(surface_number)];
    NearFacets     near;
    near.search_around(particles, surfaces, within);
    for (std::size_t k = 0; k < near.particles().size(); ++k)
      {
        const std::int32_t i      = near.particles()[k];
        const double       radius = particles.radius_of(static_cast<std::size_t>(i));
        double             least  = std::numeric_limits<double>::infinity();
        Anchor             found{-1, {}};
        for (const NearFacet *pair = near.begin(k); pair != near.end(k); ++pair)
          {
            const Vector3d centre = particles.position_of(static_cast<std::size_t>(i));
            const auto     facet  = static_cast<std::size_t>(pair->facet);
            if (pair->surface != surface_number)
              continue;
            const double gap = surface.distance(facet, centre) - radius;
            if (gap >= std::min(least, std::nextafter(within, 2 * within)))
              continue;
            least = gap;
            found = {pair->facet, closest_on_facet(surface.mesh, surface.place, facet, centre).weight};
          }
        if (found.facet < 0)
          continue;
        if (least < -0.5 * radius)
          {
            std::ostringstream message;
            message << "surface " << surface.name << ": particle " << particles.number[static_cast<std::size_t>(i)] + 1
                    << " is to be glued to it, but lies in it by " << -least << " m; up to half its radius (" << radius
                    << " m) is taken. Move one of the two.";
            throw base::InputError(message.str());
          }
        particle.push_back(i);
        anchor.push_back(found);
      }
    if (!particle.empty())
      return;
    std::ostringstream message;
    message << "wall " << surface.name << ": no particle is within " << within
            << " m of it, none is glued. Raise the distance, or check places and units (metres).";
    throw base::InputError(message.str());
  }

  void SurfaceBonds::make_bodies(const Particles &particles)
  {
    const std::size_t n = count();
    bodies.count        = 2 * n;
    for (base::Column *column : {&bodies.pose, &bodies.motion})
      column->assign(record_size * (bodies.count + 2), 0.0);
    bodies.pose[record_size * (bodies.count + 1)] = 1; // a unit apart, for the links that only fill up a pack
    bodies.mass.assign(bodies.count, 0.0);
    bodies.inertia.assign(bodies.count, 0.0);
    for (std::size_t b = 0; b < n; ++b)
      {
        const auto i      = static_cast<std::size_t>(particle[b]);
        bodies.mass[b]    = particles.mass[i];
        bodies.inertia[b] = particles.inertia[i];
        if (law->several())
          bodies.material.push_back(particles.material[i]);
      }
  }

  void SurfaceBonds::make_bonds(const ParticleShape &shape, const bool rotations)
  {
    const std::size_t n = count();
    links.shape_for(*law, false, law->several());
    links.alive = n;
    links.resize(n, bodies.count);
    std::vector<double> row(links.history.size());
    for (std::size_t b = 0; b < n; ++b)
      {
        links.first[b]  = static_cast<std::int32_t>(b);
        links.second[b] = static_cast<std::int32_t>(n + b);
        if (links.several_pairs)
          links.pair[b] = material_pair(bodies.material[b], bodies.material[b]);
        NewLink fresh; // its second end has no radius: it ends on the face
        fresh.distance     = (bodies.position_of(n + b) - bodies.position_of(b)).norm();
        fresh.first_radius = bodies.radius_of(b);
        fresh.area         = shape.link_area(fresh.first_radius, fresh.first_radius);
        fresh.thickness    = shape.dimension == 3 ? 0 : shape.thickness;

        links.reference_length[b] = law->reference_length(links.pair_of(b), fresh);
        links.area[b]             = fresh.area;
        links.living[b]           = fresh.area > 0;
        std::fill(row.begin(), row.end(), 0.0);
        law->begin(links.pair_of(b), fresh, row.data());
        links.set_history(b, row);
        // By the difference of the radii the contact point is where it shall be: at the anchor.
        bodies.pose[record_size * (n + b) + 6] = fresh.first_radius - fresh.distance;
      }
    links.tabulate(bodies.count);
    LinkReader reader(bodies, links, *law);
    for (std::size_t b = 0; b < n; ++b)
      {
        const double step =
          stable_step_of(bodies, {{links, *law}}, rotations, static_cast<std::int32_t>(b)); // sqrt(2 m / kappa)
        seen.push_back(2 * bodies.mass[b] / (step * step));
        reader.read(b, Geometry::present);
        const LinkStiffnesses s = reader.closed_stiffness();
        pulling.push_back(links.area[b] / links.reference_length[b] * std::max(s.normal, s.shear));
        turning.push_back(rotations ? std::max(s.bending, s.twist) : 0.0);
      }
  }

  void SurfaceBonds::follow(const Particles &particles, const Surface &surface)
  {
    const std::size_t n = count(), corners = static_cast<std::size_t>(surface.mesh.corners);
    for (std::size_t b = 0; b < n; ++b)
      {
        const auto from = record_size * static_cast<std::size_t>(particle[b]);
        std::copy_n(&particles.pose[from], record_size, &bodies.pose[record_size * b]);
        std::copy_n(&particles.motion[from], record_size, &bodies.motion[record_size * b]);
        const auto              facet = static_cast<std::size_t>(anchor[b].facet);
        std::array<Vector3d, 3> moved;
        Vector3d                place = Vector3d::Zero(), motion = Vector3d::Zero();
        for (std::size_t c = 0; c < corners; ++c)
          {
            const auto v = static_cast<std::size_t>(surface.mesh.facet[facet][c]);
            moved[c]     = surface.motion[v];
            place += anchor[b].weight[c] * surface.place[v];
            motion += anchor[b].weight[c] * moved[c];
          }
        const Vector3d turn  = FacetSpin(surface, facet, 0.5).turn(moved); // 2 tan(angle/2), as poses have it
        const double   half  = 0.5 * turn.norm();
        const Vector3d angle = half > 0 ? Vector3d(std::atan(half) / half * turn) : turn;
        double        *pose = &bodies.pose[record_size * (n + b)], *motions = &bodies.motion[record_size * (n + b)];
        std::copy_n(place.data(), 3, pose);
        std::copy_n(turn.data(), 3, pose + 3);
        std::copy_n(motion.data(), 3, motions);
        std::copy_n(angle.data(), 3, motions + 3);
      }
  }

  std::vector<std::int32_t> SurfaceBonds::find_forces(const Particles &particles, const Surface &surface)
  {
    std::vector<std::int32_t> off;
    broken.clear();
    if (!holds())
      return off;
    follow(particles, surface);
    pass(links, bodies, *law, links.whole());
    for (std::size_t block = 0; block < links.blocks(); ++block)
      if (links.accounts[block].event)
        {
          links.accounts[block].event = false;
          for (std::size_t b = block * links_per_block; b < std::min((block + 1) * links_per_block, links.count); ++b)
            if (links.is_alive(b))
              tear_off(b, off);
        }
    share_out(surface);
    return off;
  }

  void SurfaceBonds::note_breaks(const std::size_t b, const LinkReader &reader)
  {
    for (const BrokenElement &element : reader.broken_elements())
      {
        Break event;
        event.ends    = {particle[b], -1};
        event.surface = surface_number;
        event.pair    = static_cast<std::int32_t>(links.pair_of(b));
        event.element = element.element;
        event.mode    = element.mode;
        event.place   = bodies.position_of(count() + b) + element.offset;
        event.normal  = reader.view().direction;
        event.area    = links.area[b] * element.share;
        broken.push_back(event);
      }
  }

  void SurfaceBonds::tear_off(const std::size_t b, std::vector<std::int32_t> &off)
  {
    LinkReader reader(bodies, links, *law);
    reader.read(b, Geometry::present);
    const LinkPhase phase = reader.phase();
    if (!links.is_broken(b))
      note_breaks(b, reader);
    if (phase == LinkPhase::whole)
      return;
    if (!links.is_broken(b))
      ++torn_count;
    if (links.logs_breaks)
      links.noted[b] = 1;
    if (phase == LinkPhase::broken)
      return; // stays as a contact until it opens
    torn_damage += reader.damage_dissipation();
    let_go += std::max(reader.stored() - work_not_taken_up(bodies, links, reader.view(), b), 0.0);
    links.remove(b);
    off.push_back(particle[b]);
  }

  void SurfaceBonds::share_out(const Surface &surface)
  {
    const auto corners = static_cast<std::size_t>(surface.mesh.corners);
    vertex_parts.clear();
    for (std::size_t b = 0; b < count(); ++b)
      {
        if (!links.is_alive(b))
          continue;
        const auto      facet  = static_cast<std::size_t>(anchor[b].facet);
        const Vector3d  pulled = -force(b);
        const FacetSpin spin(surface, facet);
        const auto      turned = spin.forces(couple_on_anchor(b));
        for (std::size_t c = 0; c < corners; ++c)
          vertex_parts.push_back({surface.mesh.facet[facet][c], anchor[b].weight[c],
                                  anchor[b].weight[c] * pulled + turned[c],
                                  anchor[b].weight[c] * pulling[b] + spin.stiffness(c, turning[b])});
      }
  }

  Vector3d SurfaceBonds::force(const std::size_t b) const { return Vector3d(&links.force[record_size * b]); }

  Vector3d SurfaceBonds::branch(const std::size_t b) const
  {
    return bodies.position_of(count() + b) - bodies.position_of(b);
  }

  // A link's record holds half of branch x force, and by how much the contact point lies off the middle.
  Vector3d SurfaceBonds::couple_on_particle(const std::size_t b) const
  {
    const double *record = &links.force[record_size * b];
    return (1 + record[6]) * Vector3d(record + 3) + moment(b);
  }

  Vector3d SurfaceBonds::couple_on_anchor(const std::size_t b) const
  {
    const double *record = &links.force[record_size * b];
    return (1 - record[6]) * Vector3d(record + 3) - moment(b);
  }

  Vector3d SurfaceBonds::moment(const std::size_t b) const { return links.moment_of(b); }

  void SurfaceBonds::hand_out(base::Column &records, Surface &surface) const
  {
    for (std::size_t b = 0; b < count(); ++b)
      {
        if (!links.is_alive(b))
          continue;
        const Vector3d pull = force(b), turn = couple_on_particle(b), place = bodies.position_of(count() + b);
        double        *sum = &records[record_size * static_cast<std::size_t>(particle[b])];
        for (int c = 0; c < 3; ++c)
          {
            sum[c] += pull[c];
            sum[3 + c] += turn[c];
          }
        surface.total_force -= pull;
        surface.total_moment += couple_on_anchor(b) - place.cross(pull);
        if (!links.is_broken(b))
          ++surface.glued;
      }
    for (const VertexPart &part : vertex_parts)
      {
        surface.force[static_cast<std::size_t>(part.vertex)] += part.force;
        surface.stiffness[static_cast<std::size_t>(part.vertex)] += part.stiffness;
      }
    surface.torn = torn_count;
  }

  template <typename Quantity>
  double SurfaceBonds::sum_of_living(const Quantity &quantity) const
  {
    LinkReader reader(bodies, links, *law);
    double     sum = 0;
    for (std::size_t b = 0; b < count(); ++b)
      if (links.is_alive(b))
        {
          reader.read(b, Geometry::present);
          sum += quantity(reader);
        }
    return sum;
  }

  void SurfaceBonds::show(GlueOutput &out, const Particles &particles, const Surface &surface) const
  {
    LinkReader reader(bodies, links, *law);
    for (std::size_t b = 0; b < count(); ++b)
      {
        Vector3d now = Vector3d::Zero(), then = now;
        for (std::size_t c = 0; c < static_cast<std::size_t>(surface.mesh.corners); ++c)
          {
            const auto v = static_cast<std::size_t>(surface.mesh.facet[static_cast<std::size_t>(anchor[b].facet)][c]);
            now += anchor[b].weight[c] * surface.place[v];
            then += anchor[b].weight[c] * surface.mesh.vertex[v];
          }
        const bool whole  = links.is_alive(b) && !links.is_broken(b);
        double     normal = 0, shear = 0, strain = 0, damage = 1, area = 1;
        if (links.is_alive(b))
          {
            reader.read(b);
            const LinkView &view = reader.view();
            normal               = view.force.dot(view.direction);
            shear                = (view.force - normal * view.direction).norm();
            strain               = view.strain;
            area                 = links.area[b];
            damage               = whole ? reader.damage().stiffness : 1.0;
          }
        out.particle.push_back(static_cast<std::size_t>(particles.number[static_cast<std::size_t>(particle[b])]));
        out.surface.push_back(surface_number);
        out.anchor.push_back(now);
        out.moved.push_back(now - then);
        out.torn.push_back(whole ? 0 : 1);
        out.normal_force.push_back(normal);
        out.shear_force.push_back(shear);
        out.normal_stress.push_back(normal / area);
        out.shear_stress.push_back(shear / area);
        out.normal_strain.push_back(strain);
        out.damage.push_back(damage);
      }
  }

  double SurfaceBonds::stored() const
  {
    return sum_of_living([](const LinkReader &bond) { return bond.stored(); });
  }

  double SurfaceBonds::damage() const
  {
    double sum = torn_damage;
    for (const LinkBlockAccount &account : links.accounts)
      sum += account.damage;
    return sum + sum_of_living([](const LinkReader &bond) { return bond.damage_dissipation(); });
  }

  double SurfaceBonds::friction() const { return plastic_dissipation(links); }
  double SurfaceBonds::released() const { return let_go + released_in_place(links); }

  void SurfaceBonds::visit_state(base::StateVisitor &visitor, const std::string &group, const Surface &surface)
  {
    visitor.column(group + "/pose", bodies.pose);
    visitor.column(group + "/motion", bodies.motion);
    links.visit_state(visitor, group + "/links", bodies.count);
    visitor.scalar(group + "/torn", torn_count);
    visitor.scalar(group + "/torn_damage", torn_damage);
    visitor.scalar(group + "/released", let_go);
    share_out(surface); // to the bits that it had: all it depends on is there
  }
} // namespace dem

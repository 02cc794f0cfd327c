// Walls and other surfaces of a specimen: how they are added and moved, and what they do in a step.

#include "dem/specimen/surfaces.h"

#include "base/errors.h"
#include "dem/specimen/core.h"
#include "dem/specimen/glide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    std::string too_fast(const Particles &p, const std::size_t i, const double distance)
    {
      std::ostringstream message;
      message << "particle " << p.number[i] + 1 << " moves by " << distance << " m in a step, more than its radius ("
              << p.radius_of(i)
              << " m): it could pass a wall or another one unseen. Lower Time/Step factor or the speed.";
      return message.str();
    }

    /** @throws base::InputError */
    void check_speeds(const Particles &p, const double step)
    {
      for (std::size_t i = 0; i < p.count; ++i)
        {
          const double distance = step * Eigen::Vector3d(&p.velocity[record_size * i]).norm();
          if (distance > p.radius_of(i))
            throw base::InputError(too_fast(p, i, distance));
        }
    }

    /** Shows surfaces a motion of particles other than that of the last step, as long as it lives. */
    class UnseenMotion
    {
    public:
      /** @param motion to show; nullptr or empty: that of the last step */
      UnseenMotion(Particles &all, base::Column *motion)
        : particles(all)
        , unseen(motion && !motion->empty() ? motion : nullptr)
      {
        if (!unseen)
          return;
        pose = particles.pose;
        for (std::size_t i = 0; i < particles.count; ++i)
          set_arm_turn(&particles.pose[record_size * i], &(*unseen)[record_size * i]);
        std::swap(particles.motion, *unseen);
      }
      UnseenMotion(const UnseenMotion &)            = delete;
      UnseenMotion &operator=(const UnseenMotion &) = delete;
      ~UnseenMotion()
      {
        if (!unseen)
          return;
        std::swap(particles.motion, *unseen);
        std::swap(particles.pose, pose);
      }

    private:
      Particles    &particles;
      base::Column *unseen;
      base::Column  pose;
    };
  } // namespace

  void SpecimenCore::find_surface_forces()
  {
    const bool glides = gliding.under_way && gliding.seen < gliding.glided;
    if (gliding.under_way)
      gather_wall_contacts();
    if (glides) // forces that were found before have worked until here, and new ones from half of the way on
      gliding.pushes.add_work(surfaces, particles.motion);
    if (surfaces.near_facets().reads_all())
      gather_places();
    const UnseenMotion shown(particles, gliding.under_way ? nullptr : &unseen);
    const double       per_second = last_step > 0 ? 1 / last_step : 0.0;
    shorten_step_for(surfaces.find_forces(particles, shape, per_second, surfaces_with_others()));
    time_step = std::min(time_step, longest_step);
    log_torn_glue();
    if (gliding.under_way)
      gather_wall_contacts();
    if (glides)
      gliding.pushes.add_work(surfaces, particles.motion);
    gliding.seen = gliding.glided;
  }

  std::vector<std::int32_t> SpecimenCore::read_by_surfaces() const
  {
    std::vector<std::int32_t> some = surfaces.standing_beside();
    if (gliding.under_way) // what touches takes work and impulses on the way, which all add up
      some.insert(some.end(), surfaces.near_facets().particles().begin(), surfaces.near_facets().particles().end());
    for (const SurfaceBonds &glue : surfaces.bonds())
      for (std::size_t b = 0; b < glue.count(); ++b)
        some.push_back(glue.particle_of(b));
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    return some;
  }

  void SpecimenCore::log_torn_glue()
  {
    for (const SurfaceBonds &glue : surfaces.bonds())
      for (Break event : glue.breaks())
        {
          event.time = time;
          event.step = step_count;
          cracks.log(event);
        }
  }

  double SpecimenCore::begin_surfaces()
  {
    surfaces.check_start(particles);
    check_speeds(particles, time_step);
    find_surface_forces();
    double energy = surfaces.stored(shape, particles);
    if (surfaces.touching())
      for (std::size_t at = 0; at < record_size * particles.count; ++at)
        energy += 0.5 * time_step * particles.velocity[at] * surfaces.on_particles()[at];
    return energy;
  }

  void SpecimenCore::advance_surfaces(const StepHalves &halves)
  {
    const SharedSurfaces with_others = surfaces_with_others();
    surfaces.collect_impulses(halves.before + halves.after, with_others);
    book.work.now += surfaces.add_work_of_last_motion(with_others);
    const double of_vertices = surfaces.advance(time_step);
    book.work.after += surfaces.add_work_of_last_motion(with_others);
    refuse_too_fast(largest_displacement(), of_vertices);
    surfaces.moved(largest_displacement(), of_vertices);
  }

  void SpecimenCore::refuse_too_fast(const double of_particles, const double of_surfaces)
  {
    if (of_particles + of_surfaces < smallest_radius)
      return;
    gather_places();
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const double distance = Eigen::Vector3d(&particles.motion[record_size * i]).norm() + of_surfaces;
        if (distance > particles.radius_of(i))
          throw base::NumericalError(too_fast(particles, i, distance));
      }
  }

  void SpecimenCore::glue(const std::size_t number, const SurfaceGlue &glue)
  {
    const std::string name = surfaces.surface(number).name;
    if (step_count > 0)
      throw base::InputError("wall " + name + ": particles are glued to it before the first step.");
    if (!(glue.within > 0 && std::isfinite(glue.within)))
      throw base::InputError("wall " + name + ": particles are glued within a distance above 0 m.");
    const auto law = glue.law ? glue.law : bond_law;
    if (!law->kinds().empty())
      throw base::InputError("wall " + name + ": links of the particles obey several laws (" + law->name() +
                             "). Choose the one of what is glued.");
    if (!law->bonds())
      throw base::InputError("wall " + name + ": links of law " + law->name() +
                             " carry no tension. Take another law for what is glued.");
    for (const std::int32_t i : surfaces.glue(number, glue.within, law, particles, shape, parameters.physics.rotations))
      longest_step = std::min(longest_step, parameters.step_factor * stable(i));
    time_step = std::min(time_step, longest_step);
  }

  void SpecimenCore::find_forces_of_surfaces()
  {
    if (step_count == 0 && !gliding.under_way)
      {
        surfaces.check_start(particles);
        check_speeds(particles, time_step);
      }
    find_surface_forces();
  }

  const Surface &SurfaceReadings::at(const std::size_t number) const { return core->surfaces.surfaces().at(number); }
  std::size_t    SurfaceReadings::size() const { return core->surfaces.surfaces().size(); }

  std::vector<WallContact> SurfaceReadings::contacts() const
  {
    core->gather_wall_contacts();
    std::vector<WallContact> out;
    for (const SurfaceContact &contact : core->surfaces.list())
      {
        const auto i = static_cast<std::size_t>(contact.particle);
        out.push_back({static_cast<std::size_t>(core->particles.number[i]), static_cast<std::size_t>(contact.surface),
                       contact.place, contact.force, contact.overlap});
      }
    return out;
  }

  std::array<std::int64_t, 2> SurfaceReadings::searches() const
  {
    return {core->surfaces.near_facets().searches(), core->surfaces.near_facets().tested()};
  }

  std::size_t Surfaces::add(const SurfaceParameters &surface)
  {
    if (core->parameters.physics.periodic)
      throw base::InputError("wall " + surface.name + ": a periodic cell has no place for walls.");
    std::vector<bool> meets(surface.particles.empty() ? 0 : core->particles.count, false);
    for (const std::size_t number : surface.particles)
      {
        if (number >= core->slot.size())
          throw base::InputError("wall " + surface.name + ": there is no particle " + std::to_string(number + 1) + ".");
        meets[static_cast<std::size_t>(core->slot[number])] = true;
      }
    const std::size_t added = core->surfaces.add(surface, core->parameters.physics, std::move(meets));
    if (surface.glue.within != 0)
      core->glue(added, surface.glue);
    return added;
  }

  void Surfaces::set_motion(const std::size_t      number,
                            const Eigen::Vector3d &velocity,
                            const Eigen::Vector3d &spin,
                            const Eigen::Vector3d &about)
  {
    Surface &surface = core->surfaces.surface(number);
    if (surface.mesh.is_plane() && !spin.isZero(0))
      throw base::InputError("wall " + surface.name + ": an unbounded plane does not spin. Take a plate of facets.");
    surface.driven   = Surface::Driven::rigidly;
    surface.velocity = velocity;
    surface.spin     = spin;
    surface.centre   = about;
  }

  void Surfaces::hold_at_force(const std::size_t number, const ForceServo &servo)
  {
    Surface &surface = core->surfaces.surface(number);
    if (!(servo.direction.norm() > 0 && servo.largest_speed > 0 && servo.gain > 0 && servo.gain <= 1 &&
          std::isfinite(servo.force)))
      throw base::InputError(
        "wall " + surface.name +
        ": a servo needs a direction, a finite force, a largest speed above 0 m/s and a gain in (0, 1].");
    surface.driven          = Surface::Driven::by_force;
    surface.servo           = servo;
    surface.servo.direction = servo.direction.normalized();
    surface.spin.setZero();
  }

  void Surfaces::set_vertex_velocities(const std::size_t number, const std::vector<Eigen::Vector3d> &velocity)
  {
    Surface &surface = core->surfaces.surface(number);
    if (surface.mesh.is_plane())
      throw base::InputError("wall " + surface.name + ": the vertices of an unbounded plane do not move one by one.");
    if (velocity.size() != surface.place.size())
      throw base::InputError("wall " + surface.name + " of " + std::to_string(surface.place.size()) +
                             " vertices: velocities of " + std::to_string(velocity.size()) + " were given.");
    surface.driven = Surface::Driven::by_vertex;
    surface.rate   = velocity;
  }

  void Surfaces::cut_off(const std::size_t number)
  {
    if (core->step_count > 0)
      throw base::InputError("wall " + at(number).name + ": particles are cut off at it before the first step.");
    core->find_forces_of_surfaces();
    core->surfaces.cut_off_at(number, core->particles, core->shape);
  }
} // namespace dem

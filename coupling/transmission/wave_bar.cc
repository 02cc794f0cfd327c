#include "coupling/transmission/wave_bar.h"

#include "base/errors.h"
#include "base/stopwatch.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "coupling/transmission/wave_course.h"
#include "coupling/transmission/wave_handshake.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/elastic_links.h"
#include "dem/network/elastic_network.h"
#include "dem/packing/compaction.h"
#include "dem/packing/tiling.h"
#include "dem/specimen/specimen.h"
#include "fem/materials/anisotropic_elastic.h"
#include "fem/mesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double neighbours_within = 1.5;  // of links, over the sum of radii
    constexpr double touching          = 1;    // a side, of centres from it over the diameter
    constexpr double amplitude_of_bar  = 1e-8; // of velocities over the wave's speed: linear

    /** A periodic cell of the packing, and the continuum that it is as a whole. */
    struct BarMedium
    {
      explicit BarMedium(const WaveCase &wave)
        : width(static_cast<double>(wave.medium.width * wave.element) * wave.medium.spacing)
      {
        dem::CompactionParameters p;
        p.radius      = 0.5 * wave.medium.spacing;
        p.seed        = static_cast<std::uint64_t>(wave.medium.seed);
        p.proportions = {longer, 1, 1};
        p.friction    = 0; // the densest that has no order scatters least
        p.count       = dem::count_to_fill({longer * width, width, width}, p.radius, p.friction);
        cell          = wave.compact(p).packing;
        dem::NetworkParameters links;
        links.interaction_ratio = neighbours_within;
        links.normal_modulus    = wave.medium.modulus;
        links.shear_ratio       = wave.medium.shear_ratio;
        const auto relaxed      = dem::relaxed_stiffness(dem::make_network(cell, links));
        if (relaxed.resisted < 6)
          throw base::InputError("Medium = bar: the packing does not resist every strain.");
        stiffness = relaxed.stiffness;
        packed    = dem::solid_volume(cell) / cell.periodic_cell->prod();
        speed     = std::sqrt(stiffness(0, 0) / wave.medium.density);
      }

      static constexpr double longer = 3; // than wide
      double                  width;      ///< of the bar of particles [m]
      dem::Packing            cell;
      base::Stiffness         stiffness;  ///< [Pa]
      double                  packed = 0; ///< solid volume over volume
      double                  speed  = 0; ///< of plane waves of compression along x [m/s]
    };

    /** Half lengths along x; the packet starts in the middle. */
    struct BarCourse
    {
      BarCourse(const WaveCase &wave, const BarMedium &medium)
      {
        constexpr double away = 3.2; // over the width, where a packet has ended
        const double     h    = static_cast<double>(wave.element) * wave.medium.spacing;
        spacing               = wave.medium.spacing;
        packet.width          = 1.5 * wave.wavelength;
        packet.start          = Vector3d::Zero();
        packet.direction      = Vector3d::UnitX();
        own                   = h * std::ceil(away * packet.width / h);
        overlap               = static_cast<double>(wave.overlap) * h;
        const double way      = own + overlap + away * packet.width;
        end                   = h * std::ceil((way + packet.width) / h);
        packet.duration       = way / medium.speed;
      }

      WaveCourse packet;
      double     own = 0, overlap = 0, end = 0; ///< of the particles' own region; width of the overlap; of all [m]
      double     spacing = 0;                   ///< [m]
    };

    struct BarPart
    {
      dem::Packing             packing;
      std::vector<std::size_t> numbers; ///< of its spheres in the whole bar, ascending
    };

    /** The part of a bar between -x and x, cut from the middle of the same row of cells, whatever x. @param longest of all */
    BarPart bar_of(const BarMedium &medium, const double x, const double longest)
    {
      const dem::Packing bar = dem::tile_and_crop(medium.cell, {2 * longest, medium.width, medium.width}).packing;
      BarPart            part;
      for (std::size_t i = 0; i < bar.size(); ++i)
        {
          const Vector3d centre = bar.centre[i] - Vector3d(longest, 0, 0);
          if (std::fabs(centre.x()) > x)
            continue;
          part.packing.centre.push_back(centre);
          part.packing.radius.push_back(bar.radius[i]);
          part.numbers.push_back(i);
        }
      return part;
    }

    /** Width at which a continuum weighs as much as the spheres that lie in the bar; all of their centres are in it. */
    double filled_width(const BarMedium &medium, const dem::Packing &all, const double length)
    {
      constexpr double rounding = 1e-6;
      return std::max(medium.width - (2 - rounding) * all.radius.front(),
                      std::sqrt(dem::solid_volume(all) / medium.packed / length));
    }

    dem::Specimen
    spheres_of(const WaveCase &wave, const BarMedium &medium, const BarCourse &course, const dem::Packing &packing)
    {
      dem::SpecimenParameters p;
      p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.density                                                  = wave.medium.density / medium.packed;
      p.interaction_ratio                                        = neighbours_within;
      p.step_factor                                              = wave.step_factor;
      dem::Specimen specimen(packing, p, dem::elastic_links(wave.medium.modulus, wave.medium.shear_ratio));
      for (const int axis : {1, 2})
        {
          dem::Grip sliding;
          sliding.prescribed[static_cast<std::size_t>(axis)] = true;
          for (std::size_t i = 0; i < packing.size(); ++i)
            {
              const double side = packing.centre[i][axis];
              if (std::min(side, medium.width - side) < touching * wave.medium.spacing)
                sliding.particles.push_back(i);
            }
          specimen.grips().add(sliding);
        }
      for (std::size_t i = 0; i < packing.size(); ++i)
        specimen.set_velocity(i,
                              amplitude_of_bar * medium.speed * packet_velocity(wave, course.packet, packing.centre[i]),
                              Vector3d::Zero());
      return specimen;
    }

    WaveContinuum<3> continua_of(const WaveCase  &wave,
                                 const BarMedium &medium,
                                 const BarCourse &course,
                                 const double     filled,
                                 const Overlap   &overlap)
    {
      const double     h = static_cast<double>(wave.element) * wave.medium.spacing;
      fem::BodiesShape shape;
      for (const bool left : {true, false})
        {
          fem::NamedBox box;
          box.name     = left ? "left" : "right";
          box.material = continuum_name;
          box.corner = {left ? -course.end : course.own, 0.5 * (medium.width - filled), 0.5 * (medium.width - filled)};
          box.size   = {course.end - course.own, filled, filled};
          box.divisions = {static_cast<unsigned int>(std::lround((course.end - course.own) / h)),
                           static_cast<unsigned int>(wave.medium.width), static_cast<unsigned int>(wave.medium.width)};
          shape.boxes.push_back(box);
        }
      std::vector<SlidingSide> sides;
      for (const std::string body : {"left", "right"})
        for (const auto &[side, axis] :
             {std::pair<const char *, unsigned int>{" bottom", 1}, {" top", 1}, {" back", 2}, {" front", 2}})
          sides.push_back({body + side, axis});
      return {shape,
              fem::make_points(fem::AnisotropicElastic(medium.stiffness), fem::Plane::strain),
              wave.medium.density,
              sides,
              wave,
              overlap};
    }

    double energy_of_motion(const dem::ParticleState &p)
    {
      return 0.5 * (p.mass * p.velocity.squaredNorm() + p.inertia * p.spin.squaredNorm());
    }

    /** Both runs of a packet: with continua, and the packing alone. Energies are those of motion at two times, a quarter of a period apart, added
        up: that of waves of one frequency, whatever their phase. */
    class BarRuns
    {
    public:
      BarRuns(const BarCourse             &course_,
              const BarPart               &part,
              const BarPart               &whole,
              const dem::ObservedSpecimen &handshaking,
              const dem::ObservedSpecimen &alone_)
        : course(course_)
        , coupled(handshaking)
        , alone(alone_)
      {
        std::size_t k = 0;
        for (const std::size_t number : part.numbers)
          {
            while (whole.numbers[k] != number)
              ++k;
            same.push_back(k);
          }
      }

      void add_up()
      {
        const double rim = course.own - 2 * course.spacing;
        for (std::size_t i = 0; i < same.size(); ++i)
          {
            dem::ParticleState       one   = coupled.particle(i);
            const dem::ParticleState other = alone.particle(same[i]);
            if (std::fabs(one.position.x()) >= rim)
              continue;
            left_behind += energy_of_motion(one);
            left_behind_alone += energy_of_motion(other);
            one.velocity -= other.velocity;
            one.spin -= other.spin;
            reflected += energy_of_motion(one);
          }
        for (std::size_t i = 0; i < alone.counts().particles; ++i)
          {
            const dem::ParticleState p = alone.particle(i);
            if (std::fabs(p.position.x()) > course.own + course.overlap)
              unhindered += energy_of_motion(p);
          }
      }

      double reflected = 0, unhindered = 0, left_behind = 0, left_behind_alone = 0; ///< [J]

    private:
      const BarCourse             &course;
      const dem::ObservedSpecimen &coupled, &alone;
      std::vector<std::size_t>     same; ///< of each coupled particle, in the longer bar
    };
  } // namespace

  WaveAnswer transmit_in_bar(const WaveCase &wave)
  {
    const BarMedium medium(wave);
    const BarCourse course(wave, medium);
    const Overlap   overlap{[&](const Vector3d &place) { return std::fabs(place.x()) - course.own; }, course.overlap};
    const BarPart   whole   = bar_of(medium, course.end, course.end),
                  part      = bar_of(medium, course.own + course.overlap, course.end);
    dem::Specimen particles = spheres_of(wave, medium, course, part.packing),
                  alone     = spheres_of(wave, medium, course, whole.packing);
    const double packet     = particles.energy().kinetic;

    const double        filled    = filled_width(medium, whole.packing, 2 * course.end);
    WaveContinuum<3>    continuum = continua_of(wave, medium, course, filled, overlap);
    ConcurrentMotion<3> both(particles, continuum.solid, *continuum.motion, *continuum.participant);
    const auto         &handshake = both.add_volume(coupling_of(wave, overlap, medium.speed));

    const double step  = std::min({both.particle_step(), both.solid_step(), alone.longest_step()});
    const auto   steps = static_cast<std::int64_t>(std::ceil(course.packet.duration / step)),
               quarter = static_cast<std::int64_t>(std::lround(0.25 * wave.wavelength / medium.speed / step));
    alone.set_time_step(step);
    BarRuns runs(course, part, whole, particles, alone);
    double  coupled = 0, by_themselves = 0;
    for (const std::int64_t some : {steps - quarter, quarter})
      {
        const double began = base::processor_seconds();
        for (std::int64_t s = 0; s < some; ++s)
          both.advance(step);
        coupled += base::processor_seconds() - began;
        const double then = base::processor_seconds();
        alone.advance(some);
        by_themselves += base::processor_seconds() - then;
        runs.add_up();
      }
    WaveAnswer answer;
    answer.reflected         = runs.reflected / packet;
    answer.unhindered        = runs.unhindered / packet;
    answer.left_behind       = runs.left_behind / packet;
    answer.left_behind_alone = runs.left_behind_alone / packet;
    answer.transmitted       = continuum.energy() / packet;
    answer.absorbed          = handshake.balance().absorbed / packet;
    answer.made              = handshake.balance().spurious() / packet;
    answer.balance_error = std::max(particles.energy().balance_error(), continuum.participant->energy().balance_error);
    answer.cost =
      coupled * static_cast<double>(whole.packing.size()) / (by_themselves * static_cast<double>(part.packing.size()));
    answer.steps     = steps;
    answer.particles = static_cast<std::int64_t>(part.packing.size());
    return answer;
  }
} // namespace coupling

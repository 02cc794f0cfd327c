#include "coupling/transmission/wave_case.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "base/stopwatch.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "coupling/transmission/wave_bar.h"
#include "coupling/transmission/wave_course.h"
#include "coupling/transmission/wave_handshake.h"
#include "dem/laws/elastic_links.h"
#include "fem/materials/isotropic_elastic.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Vector3d;
  using Lattice = WaveMedium::Lattice;

  namespace
  {
    constexpr double central   = 1e-9; // shear over normal stiffness of links that are springs between centres
    constexpr double amplitude = 1e-8; // of velocities over the wave's speed: linear

    /** Particles from the left end to x. Those of a longer one begin with those of a shorter one. */
    dem::Packing packing_of(const WaveMedium &medium, const WaveCourse &course, const double end)
    {
      dem::Packing     packing;
      const double     a = medium.spacing, pitch = hexagonal_row_pitch * a;
      constexpr double rounding = 1e-9;
      const auto       first    = static_cast<std::int64_t>(std::ceil(course.bottom / pitch - rounding)),
                 last           = static_cast<std::int64_t>(std::floor(course.top / pitch + rounding));
      const auto add            = [&](const double from, const double to) {
        for (std::int64_t row = first; row <= last; ++row)
          {
            const double shift = row % 2 == 0 ? 0.0 : 0.5;
            for (auto n = static_cast<std::int64_t>(std::ceil(from / a - shift - rounding));
                 (static_cast<double>(n) + shift) * a <= to + rounding * a; ++n)
              packing.centre.emplace_back((static_cast<double>(n) + shift) * a, pitch * static_cast<double>(row), 0);
          }
      };
      add(course.left, course.overlap_end);
      if (end > course.overlap_end)
        add(course.overlap_end + 0.25 * a, end);
      packing.radius.assign(packing.size(), 0.5 * a);
      return packing;
    }

    /** What of its stiffness a link has that acts at a place. */
    double stiffness_of_link(const WaveMedium &medium, const Vector3d &place)
    {
      return medium.share_across(place.y()) * medium.stiffness_at(place);
    }

    /** What lies on lines of symmetry counts half; stiffness is scattered. @param stiffest that links have before */
    void share(const WaveMedium &medium, const dem::Packing &packing, const double stiffest, dem::Specimen &specimen)
    {
      std::vector<double> masses;
      for (const Vector3d &place : packing.centre)
        masses.push_back(medium.share_across(place.y()));
      specimen.partners().share([&](const Vector3d &place) { return stiffness_of_link(medium, place) / stiffest; },
                                masses);
    }

    /** Particles on a line of symmetry move along it, in a shear wave across it; those of a row along it. */
    void guide(const WaveCase &wave, const dem::Packing &packing, dem::Specimen &specimen)
    {
      dem::Grip guided;
      guided.prescribed[wave.shear ? 0 : 1] = true;
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (wave.medium.lattice == Lattice::chain || wave.medium.share_across(packing.centre[i].y()) < 1)
          guided.particles.push_back(i);
      specimen.grips().add(guided);
    }

    dem::Specimen specimen_of(const WaveCase &wave, const WaveCourse &course, const dem::Packing &packing)
    {
      const WaveMedium       &medium = wave.medium;
      const double            a      = medium.spacing;
      dem::SpecimenParameters p;
      p.physics.dimension = 2;
      p.physics.rotations = p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.thickness                                                                      = 1;
      // A disc stands for its cell of the lattice.
      const double cell      = medium.lattice == Lattice::chain ? a * medium.height() : a * hexagonal_row_pitch * a;
      p.density              = medium.density * cell / (0.25 * M_PI * a * a);
      p.interaction_ratio    = 1.1;
      p.step_factor          = wave.step_factor;
      const double  stiffest = 1 + medium.scatter;
      dem::Specimen specimen(packing, p, dem::elastic_links(stiffest * medium.modulus, central));
      share(medium, packing, stiffest, specimen);
      if (medium.lattice != Lattice::plane)
        guide(wave, packing, specimen);
      const double speed = amplitude * medium.wave_speed(wave.shear);
      for (std::size_t i = 0; i < packing.size(); ++i)
        specimen.set_velocity(i, speed * packet_velocity(wave, course, packing.centre[i]), Vector3d::Zero());
      return specimen;
    }

    /** The continuum from where particles stop being alone. */
    WaveContinuum<2> continuum_of(const WaveCase &wave, const WaveCourse &course, const Overlap &overlap)
    {
      const double  h = static_cast<double>(wave.element) * wave.medium.spacing, height = course.top - course.bottom;
      fem::NamedBox box;
      box.name = box.material = continuum_name;
      box.corner[1]           = course.bottom;
      box.size                = {course.right, height, 1};
      box.divisions           = {static_cast<unsigned int>(std::lround(course.right / h)),
                                 static_cast<unsigned int>(std::max(1.0, std::round(height / h))), 1};
      fem::BodiesShape shape;
      shape.boxes = {box};
      std::vector<SlidingSide> sides;
      for (const std::string side : {" bottom", " top"})
        if (wave.medium.lattice != Lattice::plane)
          sides.push_back({continuum_name + side, wave.shear ? 0u : 1u});
      fem::IsotropicElasticParameters elastic;
      elastic.young_modulus = wave.medium.young();
      elastic.poisson_ratio = wave.medium.poisson();
      return {
        shape,  fem::make_points(fem::IsotropicElastic(elastic), fem::Plane::strain), wave.medium.density, sides, wave,
        overlap};
    }

    /**
     * Energy of the difference of two motions of the same first particles, as far as it lies to the left of x: the one that central
     * differences keep, of velocities half a step back and of the product of stretches at both ends of the step.
     */
    double energy_of_difference(const WaveMedium            &medium,
                                const dem::ObservedSpecimen &one,
                                const dem::ObservedSpecimen &other,
                                const double                 end)
    {
      const std::size_t     count = std::min(one.counts().particles, other.counts().particles);
      std::vector<Vector3d> apart(count), faster(count);
      double                energy = 0;
      for (std::size_t i = 0; i < count; ++i)
        {
          const dem::ParticleState p = one.particle(i);
          apart[i]                   = one.displacement(i) - other.displacement(i);
          faster[i]                  = p.velocity - other.particle(i).velocity;
          if (p.position.x() < end)
            energy += 0.5 * p.mass * faster[i].squaredNorm();
        }
      const double          stiffness = medium.modulus; // sections as wide as links are long, of unit thickness
      const dem::LinkOutput links     = one.links();
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          const auto [first, second] = links.ends[l];
          const dem::LinkLoad &load  = links.load[l];
          if (load.contact.x() >= end)
            continue;
          const Vector3d along = load.branch.normalized();
          const double   now   = along.dot(apart[second] - apart[first]),
                       before  = now - one.time_step() * along.dot(faster[second] - faster[first]);
          energy += 0.5 * stiffness_of_link(medium, load.contact) * stiffness * now * before;
        }
      return energy;
    }

    /** Of a packet under way, half of what it has. */
    double kinetic_beyond(const dem::ObservedSpecimen &specimen, const double begin)
    {
      double energy = 0;
      for (std::size_t i = 0; i < specimen.counts().particles; ++i)
        {
          const dem::ParticleState p = specimen.particle(i);
          if (p.position.x() > begin)
            energy += 0.5 * p.mass * p.velocity.squaredNorm();
        }
      return energy;
    }
  } // namespace

  double wave_cost(const WaveCase &wave)
  {
    const WaveCourse course = course_of(wave);
    const double     rows   = (course.top - course.bottom) / wave.medium.spacing;
    return rows * (course.right - course.left) / wave.medium.spacing * course.duration;
  }

  WaveAnswer transmit(const WaveCase &wave)
  {
    const double a = wave.medium.spacing;
    if (!(wave.wavelength >= 4 * a))
      throw base::InputError("Wavelength " + base::number_text(wave.wavelength) + " m: particles " +
                             base::number_text(a) + " m apart carry waves of four of that at least.");
    if (wave.medium.lattice == Lattice::bar)
      return transmit_in_bar(wave);
    const WaveCourse course = course_of(wave);
    const Overlap    overlap{[](const Vector3d &place) { return place.x(); }, course.overlap_end};

    const dem::Packing alone_packing = packing_of(wave.medium, course, course.right),
                       packing       = packing_of(wave.medium, course, 0);
    dem::Specimen alone = specimen_of(wave, course, alone_packing), particles = specimen_of(wave, course, packing);
    const double  packet = 0.5 * particles.energy().kinetic; // one half runs to the left

    const WaveContinuum<2> continuum = continuum_of(wave, course, overlap);
    ConcurrentMotion<2>    both(particles, continuum.solid, *continuum.motion, *continuum.participant);
    const auto            &handshake = both.add_volume(coupling_of(wave, overlap, wave.medium.wave_speed(false)));

    const double step  = std::min({both.particle_step(), both.solid_step(), alone.longest_step()});
    const auto   steps = static_cast<std::int64_t>(std::ceil(course.duration / step));
    alone.set_time_step(step);
    const double began = base::processor_seconds();
    for (std::int64_t s = 0; s < steps; ++s)
      both.advance(step);
    const double coupled = base::processor_seconds() - began;
    alone.advance(steps);
    const double by_themselves = base::processor_seconds() - began - coupled;

    const ParticipantEnergy solid = continuum.participant->energy();
    WaveAnswer              answer;
    answer.reflected     = energy_of_difference(wave.medium, particles, alone, -2 * a) / packet;
    answer.transmitted   = (solid.kinetic + solid.internal) / packet;
    answer.unhindered    = 2 * kinetic_beyond(alone, course.overlap_end) / packet;
    answer.absorbed      = handshake.balance().absorbed / packet;
    answer.made          = handshake.balance().spurious() / packet;
    answer.balance_error = std::max(particles.energy().balance_error(), solid.balance_error);
    answer.cost =
      coupled * static_cast<double>(alone_packing.size()) / (by_themselves * static_cast<double>(packing.size()));
    answer.steps     = steps;
    answer.particles = static_cast<std::int64_t>(packing.size());
    return answer;
  }
} // namespace coupling

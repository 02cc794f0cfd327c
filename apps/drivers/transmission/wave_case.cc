#include "apps/drivers/transmission/wave_case.h"

#include "apps/process/stopwatch.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "dem/laws/elastic_links.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/mesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace apps
{
  using Eigen::Vector3d;
  using Lattice = WaveMedium::Lattice;

  namespace
  {
    constexpr double row_pitch   = 0.8660254037844386; // sqrt(3)/2, of hexagonal rows over the spacing
    constexpr double shear_ratio = 1e-9;               // links are central springs
    constexpr double amplitude   = 1e-8;               // of velocities over the wave's speed: linear
    // Of the packet's centre from the overlap, over its width. Near the cut-off of a mesh packets are slow: they have to get away.
    constexpr double packet_start = 4.2, packet_end = 7.5;

    /** Half of what lies on a line of symmetry is in the strip. */
    double share_across(const WaveMedium &medium, const double y)
    {
      constexpr double rounding = 1e-9;
      const bool       on_line  = medium.lattice == Lattice::strip &&
                           (y < rounding * medium.spacing || y > medium.height() - rounding * medium.spacing);
      return on_line ? 0.5 : 1.0;
    }

    /** The packet's place and length, and the lattice around it. */
    struct Course
    {
      double width, start, left, interface, overlap_end,
        right;         ///< sigma; x of the centre; of the lattice's and mesh's ends [m]
      double duration; ///< until the packet would have passed [s]
    };

    Course course_of(const WaveCase &wave)
    {
      const double a = wave.medium.spacing, k = 2 * M_PI / wave.wavelength, h = static_cast<double>(wave.element) * a;
      Course       course{};
      course.width       = (wave.wavelength > 48 * a ? 2 : 3) * wave.wavelength;
      course.interface   = 0;
      course.overlap_end = static_cast<double>(wave.overlap) * h;
      course.start       = -packet_start * course.width;
      // What runs to the left comes back too late to matter. Steps in time make short waves faster, by a third at most.
      constexpr double faster = 4.0 / 3.0;
      course.left =
        -a * std::ceil((packet_start + faster * (0.5 * (packet_start + packet_end) + 2)) * course.width / a);
      course.right    = h * std::ceil((faster * (packet_end + 3.5) * course.width + 20 * h) / h);
      course.duration = (packet_start + packet_end) * course.width / wave.medium.group_speed(wave.shear, k);
      return course;
    }

    /** Particles from the left end to x. Those of a longer one begin with those of a shorter one. */
    dem::Packing packing_of(const WaveMedium &medium, const Course &course, const double end)
    {
      dem::Packing     packing;
      const double     a        = medium.spacing;
      constexpr double rounding = 1e-9;
      const auto       add      = [&](const double from, const double to) {
        const std::int64_t rows = medium.lattice == Lattice::strip ? medium.rows : 0;
        for (std::int64_t row = 0; row <= rows; ++row)
          {
            const double shift = row % 2 == 0 ? 0.0 : 0.5;
            for (auto n = static_cast<std::int64_t>(std::ceil(from / a - shift - rounding));
                 (static_cast<double>(n) + shift) * a <= to + rounding * a; ++n)
              packing.centre.emplace_back((static_cast<double>(n) + shift) * a,
                                                     row_pitch * a * static_cast<double>(row), 0);
          }
      };
      add(course.left, course.overlap_end);
      if (end > course.overlap_end)
        add(course.overlap_end + 0.25 * a, end);
      packing.radius.assign(packing.size(), 0.5 * a);
      return packing;
    }

    dem::Specimen specimen_of(const WaveCase &wave, const Course &course, const dem::Packing &packing)
    {
      const WaveMedium       &medium = wave.medium;
      const double            a      = medium.spacing;
      dem::SpecimenParameters p;
      p.physics.dimension = 2;
      p.physics.rotations = p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.thickness                                                                      = 1;
      // A disc stands for its cell of the lattice.
      const double cell   = medium.lattice == Lattice::chain ? a * medium.height() : a * row_pitch * a;
      p.density           = medium.density * cell / (0.25 * M_PI * a * a);
      p.interaction_ratio = 1.1;
      p.step_factor       = wave.step_factor;
      dem::Specimen       specimen(packing, p, dem::elastic_links(medium.modulus, shear_ratio));
      const auto          across = [&](const Vector3d &place) { return share_across(medium, place.y()); };
      std::vector<double> masses;
      for (const Vector3d &centre : packing.centre)
        masses.push_back(across(centre));
      specimen.share(across, masses);
      dem::Grip guided; // along the lines of symmetry, in a shear wave across them
      guided.prescribed[wave.shear ? 0 : 1] = true;
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (medium.lattice == Lattice::chain || across(packing.centre[i]) < 1)
          guided.particles.push_back(i);
      specimen.add_grip(guided);
      const double k = 2 * M_PI / wave.wavelength, speed = amplitude * medium.wave_speed(wave.shear);
      for (std::size_t i = 0; i < packing.size(); ++i)
        {
          const double away = packing.centre[i].x() - course.start, relative = away / course.width;
          Vector3d     velocity        = Vector3d::Zero();
          velocity[wave.shear ? 1 : 0] = speed * std::exp(-relative * relative) *
                                         (std::cos(k * away) - 2 * relative / (k * course.width) * std::sin(k * away));
          specimen.set_velocity(i, velocity, Vector3d::Zero());
        }
      return specimen;
    }

    /** The continuum from where particles stop being alone. */
    struct Continuum
    {
      Continuum(const WaveCase &wave, const Course &course, const coupling::Overlap &overlap)
        : solid(mesh_of(wave, course), options_of(wave, overlap))
      {
        fem::IsotropicElasticParameters elastic;
        elastic.young_modulus = wave.medium.young();
        elastic.poisson_ratio = wave.medium.poisson();
        solid.assign("continuum", fem::make_points(fem::IsotropicElastic(elastic), fem::Plane::strain));
        fem::Loads<2> loads;
        loads.may_move_freely    = true;
        const unsigned int fixed = wave.shear ? 0 : 1;
        for (const char *side : {"continuum bottom", "continuum top"})
          loads.displacements.push_back({side, fixed, [](const dealii::Point<2> &, double) { return 0.0; }});
        solid.set_loads(loads);
        fem::ExplicitOptions explicitly;
        explicitly.density = {{"continuum", wave.medium.density}};
        motion             = std::make_unique<fem::ExplicitSolver<2>>(solid, explicitly);
        participant        = std::make_unique<coupling::SolidParticipant<2>>(solid, *motion);
      }

      static fem::Mesh<2> mesh_of(const WaveCase &wave, const Course &course)
      {
        const double  h = static_cast<double>(wave.element) * wave.medium.spacing, height = wave.medium.height();
        fem::NamedBox box;
        box.name = box.material = "continuum";
        box.corner[1]           = wave.medium.lattice == Lattice::chain ? -0.5 * height : 0.0;
        box.size                = {course.right, height, 1};
        box.divisions           = {static_cast<unsigned int>(std::lround(course.right / h)),
                                   static_cast<unsigned int>(std::max(1.0, std::round(height / h))), 1};
        fem::BodiesShape shape;
        shape.boxes = {box};
        return fem::make_shape<2>(shape, {fem::ElementFamily::hypercube, 0, MPI_COMM_SELF});
      }

      static fem::SolidOptions options_of(const WaveCase &wave, const coupling::Overlap &overlap)
      {
        fem::SolidOptions options;
        if (wave.method.method == coupling::VolumeMethod::multipliers)
          options.share = [overlap](const std::array<double, 3> &place) {
            return overlap.of_solid(Vector3d(place.data()));
          };
        return options;
      }

      fem::Solid<2>                                  solid;
      std::unique_ptr<fem::ExplicitSolver<2>>        motion;
      std::unique_ptr<coupling::SolidParticipant<2>> participant;
    };

    coupling::VolumeCouplingParameters coupling_of(const WaveCase &wave, const coupling::Overlap &overlap)
    {
      const double                       h = static_cast<double>(wave.element) * wave.medium.spacing;
      coupling::VolumeCouplingParameters p;
      p.name          = "interface";
      p.overlap       = overlap;
      p.method        = wave.method.method;
      p.compatibility = wave.method.compatibility;
      p.lumped        = wave.method.lumped;
      p.sharpness     = wave.method.sharpness;
      if (wave.method.absorbs)
        coupling::set_absorber(p, wave.method.proportions, h, wave.medium.wave_speed(false));
      return p;
    }

    /**
     * Energy of the difference of two motions of the same first particles, as far as it lies to the left of x: the one that central
     * differences keep, of velocities half a step back and of the product of stretches at both ends of the step.
     */
    double energy_of_difference(const WaveMedium    &medium,
                                const dem::Specimen &one,
                                const dem::Specimen &other,
                                const double         end)
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
          energy += 0.5 * share_across(medium, load.contact.y()) * stiffness * now * before;
        }
      return energy;
    }
  } // namespace

  double WaveMedium::height() const
  {
    return lattice == Lattice::chain ? spacing : row_pitch * spacing * static_cast<double>(rows);
  }

  double WaveMedium::young() const
  {
    return lattice == Lattice::chain ? modulus : 2.5 * std::sqrt(3) / 4 * modulus; // lambda = mu = sqrt(3)/4 k
  }

  double WaveMedium::poisson() const { return lattice == Lattice::chain ? 0.0 : 0.25; }

  double WaveMedium::wave_speed(const bool shear) const
  {
    if (lattice == Lattice::chain)
      return std::sqrt(modulus / density);
    return std::sqrt((shear ? 1 : 3) * std::sqrt(3) / 4 * modulus / density);
  }

  double WaveMedium::frequency(const bool shear, const double k) const
  {
    const double a = spacing, half = 0.5 * k * a;
    if (lattice == Lattice::chain)
      return 2 * std::sqrt(modulus / density) / a * std::sin(half);
    // Plane waves along the rows of a hexagonal lattice of central springs k = E, masses m = rho a^2 sqrt(3)/2.
    const double mass = density * row_pitch * a * a, inclined = 4 * std::pow(std::sin(0.5 * half), 2);
    const double along = shear ? 0.0 : 4 * std::pow(std::sin(half), 2);
    return std::sqrt(modulus / mass * (along + (shear ? 0.75 : 0.25) * 2 * inclined));
  }

  double WaveMedium::group_speed(const bool shear, const double k) const
  {
    const double small = 1e-5 * k;
    return (frequency(shear, k + small) - frequency(shear, k - small)) / (2 * small);
  }

  double edge_to_edge_reflection(const std::int64_t element, const double wavelength)
  {
    using Complex  = std::complex<double>;
    const auto   n = static_cast<double>(element);
    const double q = 2 * M_PI / wavelength, omega = 2 * std::sin(0.5 * q), sine = 0.5 * n * omega;
    // In the mesh e^(ip) with omega = (2/n) sin(p/2); beyond its cut-off the decaying one.
    const Complex next =
      sine <= 1 ? std::exp(Complex(0, 2 * std::asin(sine))) : Complex(-std::exp(-2 * std::acosh(sine)));
    const Complex node = 0.5 * (n + 1) * omega * omega + (next - 1.0) / n;
    const Complex wave = std::exp(Complex(0, q));
    return std::norm((node - (1.0 - std::conj(wave))) / (-node + (1.0 - wave)));
  }

  double wave_cost(const WaveCase &wave)
  {
    const Course course = course_of(wave);
    const double rows   = wave.medium.lattice == Lattice::strip ? static_cast<double>(wave.medium.rows + 1) : 1.0;
    return rows * (course.right - course.left) / wave.medium.spacing * course.duration;
  }

  WaveAnswer transmit(const WaveCase &wave)
  {
    const double a = wave.medium.spacing;
    if (!(wave.wavelength >= 4 * a))
      throw base::InputError("Wavelength " + base::number_text(wave.wavelength) + " m: particles " +
                             base::number_text(a) + " m apart carry waves of four of that at least.");
    const Course            course = course_of(wave);
    const coupling::Overlap overlap{[&](const Vector3d &place) { return place.x() - course.interface; },
                                    course.overlap_end - course.interface};

    const dem::Packing alone_packing = packing_of(wave.medium, course, course.right),
                       packing       = packing_of(wave.medium, course, 0);
    dem::Specimen alone = specimen_of(wave, course, alone_packing), particles = specimen_of(wave, course, packing);
    const double  packet = 0.5 * particles.energy().kinetic; // one half runs to the left

    Continuum                     continuum(wave, course, overlap);
    coupling::ConcurrentMotion<2> both(particles, continuum.solid, *continuum.motion, *continuum.participant);
    const auto                   &handshake = both.add_volume(coupling_of(wave, overlap));

    const double step  = std::min({both.particle_step(), both.solid_step(), alone.longest_step()});
    const auto   steps = static_cast<std::int64_t>(std::ceil(course.duration / step));
    alone.set_time_step(step);
    const double began = processor_seconds();
    for (std::int64_t s = 0; s < steps; ++s)
      both.advance(step);
    const double coupled = processor_seconds() - began;
    alone.advance(steps);
    const double by_themselves = processor_seconds() - began - coupled;

    const coupling::ParticipantEnergy solid = continuum.participant->energy();
    WaveAnswer                        answer;
    answer.reflected     = energy_of_difference(wave.medium, particles, alone, course.interface - 2 * a) / packet;
    answer.transmitted   = (solid.kinetic + solid.internal) / packet;
    answer.absorbed      = handshake.balance().absorbed / packet;
    answer.made          = handshake.balance().made() / packet;
    answer.balance_error = std::max(particles.energy().balance_error(), solid.balance_error);
    answer.cost =
      coupled * static_cast<double>(alone_packing.size()) / (by_themselves * static_cast<double>(packing.size()));
    answer.steps     = steps;
    answer.particles = static_cast<std::int64_t>(packing.size());
    return answer;
  }
} // namespace apps

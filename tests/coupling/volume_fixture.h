#pragma once

#include "coupling/concurrent/concurrent_motion.h"
#include "dem/laws/elastic_links.h"
#include "dem/packing/lattice.h"
#include "fem/materials/anisotropic_elastic.h"
#include "tests/fem/solid_fixture.h"

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** A bar of particles that goes over into one of elements, for tests of the volume coupling. */
namespace volume
{
  using Eigen::Vector3d;

  constexpr double spacing = 0.01, modulus = 25e9, density = 2400;

  template <int dim, int width = 4>
  struct Bar;

  template <int dim, int width = 4>
  struct BarOptions
  {
    double                         step_factor       = 0.8;
    int                            largest_ratio     = 1;   ///< steps of particles in one of the solid
    double                         softer            = 1;   ///< the solid than the particles
    double                         interaction_ratio = 1.5; ///< diagonals too: a square alone has no shear stiffness
    std::optional<dem::Packing>    packing;                 ///< bonded; else a lattice
    std::optional<base::Stiffness> stiffness;               ///< of the solid [Pa]; else isotropic
    std::function<void(Bar<dim, width> &)>    hold;         ///< before both are coupled
    bool                                      turns    = false; ///< displacements of the solid are large
    unsigned int                              degree   = 1;     ///< of its elements
    std::function<Vector3d(const Vector3d &)> velocity = {}; ///< of all from the start, before both are coupled [m/s]
    Vector3d                                  spin     = Vector3d::Zero(); ///< of particles, likewise [rad/s]
  };

  /**
   * A bar of particles from x = 0 on that goes over into one of elements: three elements of two spacings in the overlap.
   * @tparam width in spacings
   */
  template <int dim, int width>
  struct Bar
  {
    static constexpr double element = 2 * spacing, overlap_width = 3 * element, own_length = 10 * spacing;
    static constexpr int    across         = width; // particles
    static constexpr int    elements_along = 8;

    static coupling::Overlap overlap()
    {
      return {[](const Vector3d &place) { return place.x() - own_length; }, overlap_width};
    }

    static dem::Packing packing()
    {
      const int    along   = static_cast<int>(std::lround((own_length + overlap_width) / spacing));
      dem::Packing lattice = dem::make_lattice(dim == 3 ? dem::Lattice::simple_cubic : dem::Lattice::square,
                                               spacing / 2, {along, across, dim == 3 ? across : 1});
      lattice.periodic_cell.reset();
      return lattice;
    }

    static dem::Specimen specimen(const BarOptions<dim, width> &options)
    {
      dem::SpecimenParameters p;
      p.physics.dimension = dim;
      p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.density                                                  = density;
      p.thickness                                                = spacing;
      p.interaction_ratio                                        = options.interaction_ratio;
      p.step_factor                                              = options.step_factor;
      return dem::Specimen(options.packing ? *options.packing : packing(), p, dem::elastic_links(modulus, 0.3));
    }

    static fem::Solid<dim>
    elements(const coupling::Overlap &overlap, const bool shared, const BarOptions<dim, width> &options_)
    {
      dealii::Point<dim>        low, high;
      std::vector<unsigned int> divisions(dim, across / 2);
      low[0]       = own_length;
      high[0]      = own_length + elements_along * element;
      divisions[0] = elements_along;
      for (int d = 1; d < dim; ++d)
        high[d] = across * spacing;
      fem::SolidOptions options;
      options.thickness          = spacing;
      options.large_displacement = options_.turns;
      options.degree             = options_.degree;
      if (shared)
        options.share = [overlap](const std::array<double, 3> &place) {
          return overlap.of_solid(Vector3d(place.data()));
        };
      return fem::Solid<dim>(
        fem::make_mesh<dim>(box<dim>(low, high, divisions), fem::ElementFamily::hypercube, MPI_COMM_SELF), options);
    }

    explicit Bar(coupling::VolumeCouplingParameters p, const BarOptions<dim, width> &options = {})
      : particles(specimen(options))
      , solid(elements(overlap(), p.method == coupling::VolumeMethod::multipliers, options))
    {
      if (options.stiffness)
        solid.assign("0", fem::make_points(fem::AnisotropicElastic(*options.stiffness), fem::Plane::strain));
      else
        solid.assign("0", fem::make_points(elastic(modulus / options.softer, 0.2), fem::Plane::strain));
      fem::Loads<dim> loads;
      loads.may_move_freely = true;
      solid.set_loads(loads);
      fem::ExplicitOptions explicitly;
      explicitly.density = {{"0", density}};
      motion             = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
      participant        = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
      both               = std::make_unique<coupling::ConcurrentMotion<dim>>(particles, solid, *motion, *participant);
      both->set_largest_ratio(options.largest_ratio);
      p.name    = "bar";
      p.overlap = overlap();
      if (options.velocity)
        set_velocity(options.velocity, options.spin);
      if (options.hold)
        options.hold(*this);
      if (p.absorbs)
        coupling::set_absorber(p, {}, element, std::sqrt(modulus / density));
      coupled = &both->add_volume(p);
    }

    /** Of both sides, each particle and node. */
    void set_velocity(const std::function<Vector3d(const Vector3d &)> &velocity,
                      const Vector3d                                  &spin = Vector3d::Zero())
    {
      for (std::size_t i = 0; i < particles.counts().particles; ++i)
        particles.set_velocity(i, velocity(particles.particle(i).position), spin);
      motion->set_velocity([&](const dealii::Point<dim> &x, double) {
        const Vector3d         v = velocity({x[0], x[1], dim == 3 ? x[dim - 1] : 0.0});
        dealii::Tensor<1, dim> t;
        for (int d = 0; d < dim; ++d)
          t[d] = v[d];
        return t;
      });
    }

    /** Irregular, of all wavelengths [m/s]. */
    static Vector3d noise(const Vector3d &place)
    {
      const double k = place.dot(Vector3d(1.0, 7.3, 3.1)) / spacing;
      Vector3d     v(std::sin(12.9898 * k), std::sin(3.7 + 78.233 * k), dim == 3 ? std::sin(1.3 + 37.7 * k) : 0.0);
      return 1e-3 * v;
    }

    /** What both sides count is there once. */
    double energy() const
    {
      const auto of_particles = coupling::ParticleParticipant(const_cast<dem::Specimen &>(particles)).energy();
      const auto of_solid     = participant->energy();
      return of_particles.kinetic + of_particles.internal + of_solid.kinetic + of_solid.internal -
             coupled->balance().double_counted;
    }

    Vector3d momentum() const
    {
      return coupling::momentum_of(coupling::ParticleParticipant(const_cast<dem::Specimen &>(particles))).linear +
             coupling::momentum_of(*participant).linear;
    }

    /** About the origin. */
    Vector3d angular_momentum() const
    {
      Vector3d sum = coupling::momentum_of(*participant).angular;
      for (std::size_t i = 0; i < particles.counts().particles; ++i)
        {
          const dem::ParticleState p = particles.particle(i);
          sum += p.position.cross(p.mass * p.velocity) + p.inertia * p.spin;
        }
      return sum;
    }

    void advance(const int windows)
    {
      for (int w = 0; w < windows; ++w)
        both->advance(1);
    }

    dem::Specimen                                    particles;
    fem::Solid<dim>                                  solid;
    std::unique_ptr<fem::ExplicitSolver<dim>>        motion;
    std::unique_ptr<coupling::SolidParticipant<dim>> participant;
    std::unique_ptr<coupling::ConcurrentMotion<dim>> both;
    const coupling::VolumeCoupling<dim>             *coupled = nullptr;
  };

  using coupling::Compatibility;
  using coupling::VolumeMethod;

  inline coupling::VolumeCouplingParameters
  tied(const Compatibility compatibility, const bool lumped = false, const bool absorbs = false)
  {
    coupling::VolumeCouplingParameters p;
    p.compatibility = compatibility;
    p.lumped        = lumped;
    p.absorbs       = absorbs;
    return p;
  }

  inline coupling::VolumeCouplingParameters driven(const VolumeMethod method)
  {
    coupling::VolumeCouplingParameters p;
    p.method = method;
    return p;
  }

  inline const std::vector<std::pair<std::string, coupling::VolumeCouplingParameters>> &methods()
  {
    static const std::vector<std::pair<std::string, coupling::VolumeCouplingParameters>> all = {
      {"coarse", tied(Compatibility::coarse)},
      {"strict", tied(Compatibility::strict)},
      {"lumped", tied(Compatibility::strict, true)},
      {"absorber", tied(Compatibility::coarse, false, true)},
      {"constrained", driven(VolumeMethod::constrained)},
      {"legacy", driven(VolumeMethod::legacy)}};
    return all;
  }
} // namespace volume

#include "apps/bench/conservation_cases.h"

#include "base/stopwatch.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "dem/laws/elastic_links.h"
#include "dem/laws/parallel_bond.h"
#include "dem/packing/lattice.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/mesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace apps
{
  using Eigen::Vector3d;

  namespace
  {
    constexpr double turning       = 2 * M_PI * 100; // [rad/s]
    constexpr double solid_density = 2400;           // [kg/m^3]

    /** Velocities of everything at the start. */
    struct StartOfMotion
    {
      std::function<Vector3d(const Vector3d &)> particles, solid; ///< by their place [m/s]
      Vector3d                                  spin = Vector3d::Zero();
    };

    /** Both sides, joined. */
    template <int dim>
    struct JoinedSides
    {
      JoinedSides(dem::Specimen &&made, const fem::BodiesShape &shape, const fem::SolidOptions &options)
        : specimen(std::move(made))
        , solid(fem::make_shape<dim>(shape, {fem::ElementFamily::hypercube, 0, MPI_COMM_SELF}), options)
      {
      }

      /** @param young of all bodies [Pa] */
      void begin(const double young, const double safety, const StartOfMotion &start)
      {
        fem::IsotropicElasticParameters elastic;
        elastic.young_modulus = young;
        elastic.poisson_ratio = 0.2;
        fem::ExplicitOptions explicitly;
        explicitly.safety = safety;
        for (const auto &body : solid.mesh().materials)
          {
            solid.assign(body.first, fem::make_points(fem::IsotropicElastic(elastic), fem::Plane::strain));
            explicitly.density[body.first] = solid_density;
          }
        fem::Loads<dim> loads;
        loads.may_move_freely = true;
        solid.set_loads(loads);
        motion      = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
        participant = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
        both        = std::make_unique<coupling::ConcurrentMotion<dim>>(specimen, solid, *motion, *participant);
        for (std::size_t i = 0; i < specimen.counts().particles; ++i)
          specimen.set_velocity(i, start.particles(specimen.particle(i).position), start.spin);
        motion->set_velocity([&](const dealii::Point<dim> &x, double) {
          const Vector3d         v = start.solid({x[0], x[1], dim == 3 ? x[dim - 1] : 0.0});
          dealii::Tensor<1, dim> t;
          for (int d = 0; d < dim; ++d)
            t[d] = v[d];
          return t;
        });
      }

      dem::Specimen                                    specimen;
      fem::Solid<dim>                                  solid;
      std::unique_ptr<fem::ExplicitSolver<dim>>        motion;
      std::unique_ptr<coupling::SolidParticipant<dim>> participant;
      std::unique_ptr<coupling::ConcurrentMotion<dim>> both;
    };

    struct Momenta
    {
      Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
      double   linear_size = 0, angular_size = 0; ///< sums of the sizes of their parts

      void add(const double mass, const Vector3d &place, const Vector3d &velocity, const Vector3d &own)
      {
        linear += mass * velocity;
        angular += place.cross(mass * velocity) + own;
        linear_size += mass * velocity.norm();
        angular_size += mass * place.norm() * velocity.norm() + own.norm();
      }
    };

    template <int dim>
    Momenta momenta_of(const JoinedSides<dim> &sides)
    {
      Momenta sum;
      for (std::size_t i = 0; i < sides.specimen.counts().particles; ++i)
        {
          const dem::ParticleState p = sides.specimen.particle(i);
          sum.add(p.mass, p.position, p.velocity, p.inertia * p.spin);
          sum.linear_size += p.inertia * p.spin.norm() / p.radius;
        }
      for (std::size_t i = 0; i < sides.participant->carriers(); ++i)
        sum.add(sides.participant->mass(i), sides.participant->position(i), sides.participant->velocity(i),
                Vector3d::Zero());
      return sum;
    }

    struct Energies
    {
      double there = 0, made = 0, missing = 0; ///< in motion and stored; by the coupling; in no account [J]
    };

    template <int dim>
    Energies energies_of(const JoinedSides<dim> &sides)
    {
      const dem::EnergyAccount   p = sides.specimen.energy();
      const fem::ExplicitEnergy &s = sides.motion->energy();
      Energies                   found;
      found.there   = p.kinetic + p.elastic + s.kinetic + std::fabs(s.internal);
      found.missing = p.residual() + s.external + s.start - s.kinetic - s.internal - s.damped;
      for (const auto &surface : sides.both->surfaces())
        found.made += surface->balance().spurious();
      for (const auto &handshake : sides.both->volumes())
        found.made += handshake->balance().spurious();
      for (const auto &contact : sides.both->contacts().all())
        found.missing -= contact->balance().spurious(); // what it holds is in no side's account
      return found;
    }

    template <int dim>
    ConservationAnswer follow(JoinedSides<dim> &sides, const double time, const double part)
    {
      const double       step    = part * sides.both->next_window(1).window;
      const auto         windows = static_cast<std::int64_t>(std::ceil(time / step));
      ConservationAnswer found;
      sides.both->advance(step); // constrained particles take their velocities from the solid in the first step
      const Momenta  start = momenta_of(sides);
      const Energies first = energies_of(sides);
      double         there = first.there;
      for (std::int64_t w = 1; w < windows; ++w)
        {
          const double before = base::processor_seconds();
          sides.both->advance(step);
          found.cost += base::processor_seconds() - before;
          const Momenta  now    = momenta_of(sides);
          const Energies energy = energies_of(sides);
          found.momentum        = std::max(found.momentum, (now.linear - start.linear).norm() / start.linear_size);
          found.turning         = std::max(found.turning, (now.angular - start.angular).norm() / start.angular_size);
          found.energy          = std::max(found.energy, std::fabs(energy.missing - first.missing));
          found.lost            = first.made - energy.made;
          there                 = std::max(there, energy.there);
        }
      found.energy /= there;
      found.lost /= there;
      found.cost /= static_cast<double>(windows);
      return found;
    }

    // A bar of discs that goes over into one of elements.

    constexpr double spacing = 0.01, element = 2 * spacing, own_length = 10 * spacing, overlap_width = 3 * element;
    constexpr int    across = 4, elements_along = 8;
    constexpr double bar_modulus = 25e9; // [Pa]

    enum HandshakeChoice
    {
      coarse,
      strict,
      lumped,
      absorber,
      constrained,
      legacy
    };

    coupling::VolumeCouplingParameters handshake_of(const CouplingCase &which)
    {
      coupling::VolumeCouplingParameters p;
      p.name    = which.name;
      p.overlap = {[](const Vector3d &place) { return place.x() - own_length; }, overlap_width};
      if (which.choice == constrained || which.choice == legacy)
        p.method = which.choice == constrained ? coupling::VolumeMethod::constrained : coupling::VolumeMethod::legacy;
      p.lumped = which.choice == lumped;
      if (which.choice == strict || which.choice == lumped)
        p.compatibility = coupling::Compatibility::strict;
      if (which.choice == absorber)
        coupling::set_absorber(p, {}, element, std::sqrt(bar_modulus / solid_density));
      return p;
    }

    dem::Specimen discs_of_bar(const double step_factor)
    {
      const int    along   = static_cast<int>(std::lround((own_length + overlap_width) / spacing));
      dem::Packing lattice = dem::make_lattice(dem::Lattice::square, spacing / 2, {along, across, 1});
      lattice.periodic_cell.reset();
      dem::SpecimenParameters p;
      p.physics.dimension = 2;
      p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.density                                                  = solid_density;
      p.thickness                                                = spacing;
      p.interaction_ratio                                        = 1.5; // diagonals: squares alone do not resist shear
      p.step_factor                                              = step_factor;
      return dem::Specimen(lattice, p, dem::elastic_links(bar_modulus, 0.3));
    }

    StartOfMotion start_of_bar(const CouplingMotion motion)
    {
      const auto rest = [](const Vector3d &) -> Vector3d { return Vector3d::Zero(); };
      const auto all  = [](const auto &field, const Vector3d &spin = Vector3d::Zero()) {
        return StartOfMotion{field, field, spin};
      };
      switch (motion)
        {
        case CouplingMotion::translation:
          return all([](const Vector3d &) { return Vector3d(3, -1, 0); });
        case CouplingMotion::rotation:
          return all(
            [](const Vector3d &x) -> Vector3d { return Vector3d(0, 0, turning).cross(x - Vector3d(0.13, 0.02, 0)); },
            Vector3d(0, 0, turning));
        case CouplingMotion::spin:
          return all(rest, Vector3d(0, 0, 100));
        case CouplingMotion::pulse:
          return all([](const Vector3d &x) -> Vector3d {
            const double away = (x.x() - 0.05) / 0.02;
            return Vector3d(0.1, 0.03, 0) * std::exp(-away * away);
          });
        default:
          return all([](const Vector3d &x) { return Vector3d(x.x() < spacing ? 1 : 0, 0, 0); });
        }
    }

    ConservationAnswer measure_handshake(const CouplingCase &which, const CouplingMotion motion, const double part)
    {
      const coupling::VolumeCouplingParameters parameters = handshake_of(which);
      fem::SolidOptions                        options;
      options.thickness          = spacing;
      options.large_displacement = true;
      if (parameters.method == coupling::VolumeMethod::multipliers)
        options.share = [overlap = parameters.overlap](const std::array<double, 3> &place) {
          return overlap.of_solid(Vector3d(place.data()));
        };
      fem::BodiesShape shape;
      shape.boxes = {{"bar",
                      "bar",
                      {own_length, 0, 0},
                      {elements_along * element, across * spacing, 1},
                      {elements_along, across / 2, 1}}};
      JoinedSides<2> sides(discs_of_bar(0.8 / which.ratio), shape, options);
      sides.begin(bar_modulus, 0.9, start_of_bar(motion));
      sides.both->set_largest_ratio(which.ratio);
      sides.both->add_volume(parameters);
      return follow(sides, 2e-4, part); // waves run through all of the bar and come back
    }

    // A ball on a free block, and two free blocks.

    constexpr double side = 0.1, block_modulus = 10e9; // [m], [Pa]

    enum SurfaceChoice
    {
      point,
      footprint,
      pressure,
      glue
    };

    coupling::SurfaceCouplingParameters surface_of(const CouplingCase &which)
    {
      dem::LinearContactParameters rough;
      rough.effective_modulus    = 1e8;
      rough.stiffness_ratio      = 2.5;
      rough.friction_coefficient = 0.4;
      coupling::SurfaceCouplingParameters p;
      p.name     = which.name;
      p.contact  = rough;
      p.pressure = which.choice == pressure;
      if (which.choice == footprint)
        p.spreading = coupling::Spreading::footprint;
      if (which.choice == glue)
        {
          dem::ParallelBondParameters bond;
          bond.effective_modulus = 1e8;
          bond.tensile_strength = bond.cohesion = 1e12;
          p.glue                                = {1e-6, dem::LinkMaterials(bond).bonds(dem::Physics())};
        }
      return p;
    }

    dem::Specimen ball(const Vector3d &centre, const double step_factor)
    {
      dem::Packing packing;
      packing.centre = {centre};
      packing.radius = {0.02};
      dem::SpecimenParameters p;
      p.density           = 7800;
      p.interaction_ratio = 1;
      p.step_factor       = step_factor;
      dem::LinearContactParameters law;
      law.effective_modulus = 1e8;
      return dem::Specimen(packing, p, law);
    }

    /** Of two sides of which the second lies above the plane z = side. */
    StartOfMotion start_of_pair(const CouplingMotion motion, const Vector3d &middle_of_second)
    {
      const auto     both = [](const auto &field) { return StartOfMotion{field, field}; };
      const Vector3d spin = turning * Vector3d(0.3, -0.8, 1).normalized();
      StartOfMotion  start;
      switch (motion)
        {
        case CouplingMotion::translation:
          return both([](const Vector3d &) { return Vector3d(3, -1, 0.5); });
        case CouplingMotion::rotation:
          start = both([spin](const Vector3d &x) -> Vector3d { return spin.cross(x - Vector3d(0.05, 0.05, 0.07)); });
          start.spin = spin;
          return start;
        case CouplingMotion::spin:
          start      = both([spin, middle_of_second](const Vector3d &x) -> Vector3d {
            return x.z() > side * (1 + 1e-9) ? Vector3d(Vector3d(0, 0, -1) + 0.2 * spin.cross(x - middle_of_second)) :
                                                    Vector3d::Zero();
          });
          start.spin = 0.2 * spin;
          return start;
        case CouplingMotion::pulse:
          return both([](const Vector3d &x) -> Vector3d {
            const double away = (x.z() - 0.05) / 0.02;
            return x.z() > side * (1 + 1e-9) ? Vector3d(0, 0, -0.2) : Vector3d(0.03, 0, 0.5 * std::exp(-away * away));
          });
        default:
          return both(
            [](const Vector3d &x) { return x.z() > side * (1 + 1e-9) ? Vector3d(2, -1, -5) : Vector3d(0, 0, 0); });
        }
    }

    fem::NamedBox block(const std::string &name, const std::array<double, 3> &corner, const double size)
    {
      return {name, name, corner, {size, size, size}, {3, 3, 3}};
    }

    ConservationAnswer measure_surface(const CouplingCase &which, const CouplingMotion motion, const double part)
    {
      const Vector3d    centre(0.03, 0.062, side + 0.02);
      fem::SolidOptions options;
      options.large_displacement = true;
      fem::BodiesShape shape;
      shape.boxes = {block("block", {0, 0, 0}, side)};
      // Sub-cycled, the steps of one side are short by a factor.
      JoinedSides<3> sides(ball(centre, which.ratio > 1 ? 0.02 : 0.4), shape, options);
      sides.begin(block_modulus, which.ratio < 0 ? 0.1 : 0.5, start_of_pair(motion, centre));
      sides.both->set_largest_ratio(std::abs(which.ratio));
      sides.both->add_surface(surface_of(which));
      return follow(sides, 1e-3, part);
    }

    ConservationAnswer measure_bodies(const CouplingCase &which, const CouplingMotion motion, const double part)
    {
      constexpr double  smaller = 0.06, gap = 1e-5;
      const Vector3d    middle(0.03 + smaller / 2, 0.03 + smaller / 2, side + gap + smaller / 2);
      fem::SolidOptions options;
      options.large_displacement = true;
      fem::BodiesShape shape;
      shape.boxes = {block("block", {0, 0, 0}, side), block("brick", {0.03, 0.03, side + gap}, smaller)};
      JoinedSides<3> sides(ball({10, 10, 10}, 0.4), shape, options); // the motion wants a particle: far away
      StartOfMotion  start = start_of_pair(motion, middle);
      start.particles      = [](const Vector3d &) -> Vector3d { return Vector3d::Zero(); };
      start.spin           = Vector3d::Zero();
      sides.begin(block_modulus, 0.5, start);
      coupling::bodies::BodyContactParameters contact;
      contact.form =
        which.choice == 0 ? coupling::bodies::BodyContactForm::potential : coupling::bodies::BodyContactForm::penalty;
      contact.stiffness            = 1e12;
      contact.friction_coefficient = 0.4;
      sides.both->contacts().add({which.name, {}, contact});
      return follow(sides, 1e-3, part);
    }
  } // namespace

  const std::vector<CouplingCase> &coupling_cases()
  {
    using Kind                                 = CouplingCase::Kind;
    static const std::vector<CouplingCase> all = {
      {"coarse multipliers", Kind::handshake, coarse},
      {"strict multipliers", Kind::handshake, strict},
      {"lumped multipliers", Kind::handshake, lumped},
      {"multipliers with absorber", Kind::handshake, absorber},
      {"constrained", Kind::handshake, constrained},
      {"legacy", Kind::handshake, legacy},
      {"coarse multipliers with 4 steps in one", Kind::handshake, coarse, 4},
      {"constrained with 4 steps in one", Kind::handshake, constrained, 4},
      {"surface at a point", Kind::surface, point},
      {"surface with footprint", Kind::surface, footprint},
      {"surface with pressure", Kind::surface, pressure},
      {"surface with glue", Kind::surface, glue},
      {"surface at a point with 4 steps of the particle in one", Kind::surface, point, 4},
      {"surface at a point with 4 steps of the solid in one", Kind::surface, point, -4},
      {"bodies with potential", Kind::bodies, 0},
      {"bodies with penalty", Kind::bodies, 1}};
    return all;
  }

  const char *name_of(const CouplingMotion motion)
  {
    constexpr const char *names[] = {"translation", "rotation", "spin", "pulse", "impact"};
    return names[static_cast<int>(motion)];
  }

  ConservationAnswer measure_conservation(const CouplingCase &which, const CouplingMotion motion, const double part)
  {
    switch (which.kind)
      {
      case CouplingCase::Kind::handshake:
        return measure_handshake(which, motion, part);
      case CouplingCase::Kind::surface:
        return measure_surface(which, motion, part);
      default:
        return measure_bodies(which, motion, part);
      }
  }
} // namespace apps

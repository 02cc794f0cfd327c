// Particles inside a solid: what the handshake keeps, whatever its method.
#include "coupling/concurrent/concurrent_motion.h"
#include "dem/laws/elastic_links.h"
#include "dem/packing/lattice.h"
#include "tests/dem/memory_state.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <memory>

using Eigen::Vector3d;

namespace
{
  constexpr double spacing = 0.01, modulus = 25e9, density = 2400;

  /** A bar of particles from x = 0 on that goes over into one of elements: three elements of two spacings in the overlap. */
  template <int dim>
  struct Bar
  {
    static constexpr double element = 2 * spacing, overlap_width = 3 * element, own_length = 10 * spacing;
    static constexpr int    across = 4; // particles

    explicit Bar(coupling::VolumeCouplingParameters p,
                 const double                       step_factor   = 0.8,
                 const int                          largest_ratio = 1,
                 const double                       softer        = 1)
      : Bar(std::move(p), step_factor, largest_ratio, softer, overlap())
    {
    }

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

    static dem::Specimen specimen(const double step_factor)
    {
      dem::SpecimenParameters p;
      p.physics.dimension = dim;
      p.physics.damage = p.physics.friction = p.physics.contacts = false;
      p.density                                                  = density;
      p.thickness                                                = spacing;
      p.interaction_ratio = 1.5; // diagonals too: a square alone has no shear stiffness
      p.step_factor       = step_factor;
      return dem::Specimen(packing(), p, dem::elastic_links(modulus, 0.3));
    }

    static fem::Solid<dim> elements(const coupling::Overlap &overlap, const bool shared)
    {
      const double              height = across * spacing;
      dealii::Point<dim>        low, high;
      std::vector<unsigned int> divisions(dim, across / 2);
      low[0]       = own_length;
      high[0]      = own_length + 8 * element;
      divisions[0] = 8;
      for (int d = 1; d < dim; ++d)
        high[d] = height;
      const fem::BuildMesh<dim> build = [=](dealii::Triangulation<dim> &mesh) {
        dealii::GridGenerator::subdivided_hyper_rectangle(mesh, divisions, low, high, true);
        for (const auto &cell : mesh.active_cell_iterators())
          cell->set_material_id(0);
      };
      fem::SolidOptions options;
      options.thickness = spacing;
      if (shared)
        options.share = [overlap](const std::array<double, 3> &place) {
          return overlap.of_solid(Vector3d(place.data()));
        };
      return fem::Solid<dim>(fem::make_mesh<dim>(build, fem::ElementFamily::hypercube, MPI_COMM_SELF), options);
    }

    Bar(coupling::VolumeCouplingParameters p,
        const double                       step_factor,
        const int                          largest_ratio,
        const double                       softer,
        const coupling::Overlap           &overlap)
      : particles(specimen(step_factor))
      , solid(elements(overlap, p.method == coupling::VolumeMethod::multipliers))
    {
      solid.assign("0", fem::make_points(elastic(modulus / softer, 0.2), fem::Plane::strain));
      fem::Loads<dim> loads;
      loads.may_move_freely = true;
      solid.set_loads(loads);
      fem::ExplicitOptions explicitly;
      explicitly.density = {{"0", density}};
      motion             = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
      participant        = std::make_unique<coupling::SolidParticipant<dim>>(solid, *motion);
      both               = std::make_unique<coupling::ConcurrentMotion<dim>>(particles, solid, *motion, *participant);
      both->set_largest_ratio(largest_ratio);
      p.name    = "bar";
      p.overlap = overlap;
      if (p.absorbs)
        coupling::set_absorber(p, {}, element, std::sqrt(modulus / density));
      coupled = &both->add_volume(p);
    }

    /** Of both sides, each particle and node. */
    void set_velocity(const std::function<Vector3d(const Vector3d &)> &velocity)
    {
      for (std::size_t i = 0; i < particles.counts().particles; ++i)
        particles.set_velocity(i, velocity(particles.particle(i).position), Vector3d::Zero());
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

    double energy() const
    {
      const auto of_particles = coupling::ParticleParticipant(const_cast<dem::Specimen &>(particles)).energy();
      const auto of_solid     = participant->energy();
      return of_particles.kinetic + of_particles.internal + of_solid.kinetic + of_solid.internal;
    }

    Vector3d momentum() const
    {
      return coupling::momentum_of(coupling::ParticleParticipant(const_cast<dem::Specimen &>(particles))).linear +
             coupling::momentum_of(*participant).linear;
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

  coupling::VolumeCouplingParameters
  tied(const Compatibility compatibility, const bool lumped = false, const bool absorbs = false)
  {
    coupling::VolumeCouplingParameters p;
    p.compatibility = compatibility;
    p.lumped        = lumped;
    p.absorbs       = absorbs;
    return p;
  }

  coupling::VolumeCouplingParameters led(const VolumeMethod method)
  {
    coupling::VolumeCouplingParameters p;
    p.method = method;
    return p;
  }

  const std::vector<std::pair<std::string, coupling::VolumeCouplingParameters>> &methods()
  {
    static const std::vector<std::pair<std::string, coupling::VolumeCouplingParameters>> all = {
      {"coarse", tied(Compatibility::coarse)},       {"strict", tied(Compatibility::strict)},
      {"lumped", tied(Compatibility::strict, true)}, {"absorber", tied(Compatibility::coarse, false, true)},
      {"slaved", led(VolumeMethod::slaved)},         {"legacy", led(VolumeMethod::legacy)}};
    return all;
  }

  template <int dim>
  void check_motion_as_a_whole()
  {
    for (const auto &[name, method] : methods())
      {
        INFO(name);
        Bar<dim>       bar(method);
        const Vector3d v(1.2, -0.7, dim == 3 ? 0.4 : 0.0);
        if (method.method != VolumeMethod::multipliers)
          continue; // slaves start at rest
        bar.set_velocity([&](const Vector3d &) { return v; });
        bar.advance(50);
        double worst = 0;
        for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
          worst = std::max(worst, (bar.particles.particle(i).velocity - v).norm());
        for (std::size_t i = 0; i < bar.participant->carriers(); ++i)
          worst = std::max(worst, (bar.participant->velocity(i) - v).norm());
        CHECK(worst <= 1e-10 * v.norm());
      }
  }

  template <int dim>
  void check_what_is_kept()
  {
    for (const auto &[name, method] : methods())
      {
        INFO(name);
        Bar<dim> bar(method);
        bar.set_velocity(Bar<dim>::noise);
        bar.advance(5); // velocities at the start do not obey what ties both sides
        const coupling::VolumeBalance before = bar.coupled->balance();
        const Vector3d                start  = bar.momentum();
        const double                  energy = bar.energy();
        double                        scale  = 0;
        for (std::size_t i = 0; i < bar.particles.counts().particles; ++i)
          scale += bar.particles.particle(i).mass * bar.particles.particle(i).velocity.norm();
        const auto residual = [&] {
          const fem::ExplicitEnergy e = bar.motion->energy();
          return e.start + e.external - e.kinetic - e.internal;
        };
        const double residual_of_solid = residual();
        bar.advance(300);
        CHECK((bar.momentum() - start).norm() <= 1e-10 * scale);
        const coupling::VolumeBalance &b = bar.coupled->balance();
        CHECK((b.to_particles + b.to_solid).norm() <= 1e-10 * scale);
        CHECK((b.turn_to_particles + b.turn_to_solid).norm() <= 1e-10 * scale * Bar<dim>::own_length);
        // Either side accounts for what the other gives; and both of them for the same.
        CHECK(std::fabs(bar.particles.energy().residual()) <= 1e-6 * energy);
        CHECK(std::fabs(residual() - residual_of_solid) <= 1e-9 * energy);
        const double made = b.made() - before.made();
        if (method.lumped) // takes energy
          CHECK(made < 0);
        else
          CHECK(std::fabs(made) <= 1e-10 * energy);
        if (method.absorbs)
          CHECK(b.absorbed > 0.05 * energy);
        else
          CHECK(b.absorbed == 0);
      }
  }
} // namespace

TEST_CASE("volume coupling: a body that moves as a whole passes the overlap unseen, in the plane and in space",
          "[coupling][volume]")
{
  check_motion_as_a_whole<2>();
  check_motion_as_a_whole<3>();
}

TEST_CASE("volume coupling: momentum, angular momentum and power are equal on both sides, energy is kept or told",
          "[coupling][volume]")
{
  check_what_is_kept<2>();
  check_what_is_kept<3>();
}

TEST_CASE("volume coupling: multipliers and absorber leave translation, rotation and even strain alone",
          "[coupling][volume]")
{
  // Particles of no order, and nodes at the corners of one cube around them.
  constexpr int              count = 400;
  coupling::AbsorberCarriers carriers;
  carriers.whole_mass.resize(count);
  carriers.damping.resize(count);
  carriers.inverse_mass.resize(count, 3);
  std::vector<Eigen::Triplet<double>> weights;
  const auto                          corner = [](const int k) { return Vector3d(k & 1, (k >> 1) & 1, (k >> 2) & 1); };
  for (int i = 0; i < count; ++i)
    {
      const double   k = i + 1;
      const Vector3d place(std::fmod(0.754877666 * k, 1.0), std::fmod(0.569840291 * k, 1.0),
                           std::fmod(0.438579 * k * k, 1.0));
      carriers.places.push_back(place);
      carriers.whole_mass[i] = 1 + 0.5 * std::sin(k);
      carriers.damping[i]    = 0.3 * carriers.whole_mass[i] * place.x();
      carriers.inverse_mass.row(i).setConstant(1 / (carriers.whole_mass[i] * (1.01 - place.x())));
      for (int c = 0; c < 8; ++c)
        {
          const Vector3d at = corner(c);
          double         w  = 1;
          for (int d = 0; d < 3; ++d)
            w *= at[d] > 0 ? place[d] : 1 - place[d];
          weights.emplace_back(i, c, w);
        }
    }
  coupling::WeightRows of_nodes(count, 8);
  of_nodes.setFromTriplets(weights.begin(), weights.end());
  coupling::CarrierRows node_masses(8, 3);
  node_masses.setConstant(1.0 / 30);
  carriers.point_mass.resize(0);
  carriers.weights.resize(0, 8);
  carriers.inverse_node_mass = node_masses;

  const coupling::FineScaleAbsorber absorber({0.2, 3}, carriers);
  Eigen::Matrix3d                   gradient;
  gradient << 0.3, -1.2, 0.5, 0.8, -0.1, 0.2, -0.6, 0.4, 0.9;
  coupling::CarrierRows of_particles(count, 3), at_nodes(8, 3), noise(count, 3);
  for (int i = 0; i < count; ++i)
    {
      of_particles.row(i) = Vector3d(0.7, -0.4, 1.1) + gradient * carriers.places[static_cast<std::size_t>(i)];
      noise.row(i) << std::sin(12.9898 * i), std::cos(78.233 * i), std::sin(37.7 * i + 1);
    }
  for (int c = 0; c < 8; ++c)
    at_nodes.row(c) = Vector3d(0.7, -0.4, 1.1) + gradient * corner(c);

  CHECK(absorber.changes(of_particles, at_nodes, 5).particles.norm() <= 1e-10 * of_particles.norm());
  for (const Compatibility compatibility : {Compatibility::coarse, Compatibility::strict})
    for (const bool lumped : {false, true})
      {
        const coupling::Multipliers ties(of_nodes, carriers.inverse_mass, node_masses, compatibility, lumped);
        const auto                  change = ties.changes(of_particles, at_nodes);
        CHECK(change.particles.norm() + change.nodes.norm() <= 1e-10 * of_particles.norm());
      }

  SECTION("what is irregular loses energy, and no momentum, whatever the time")
  {
    const auto kinetic = [&](const coupling::CarrierRows &v) {
      return 0.5 * v.cwiseProduct(carriers.inverse_mass.cwiseInverse()).cwiseProduct(v).sum();
    };
    for (const double time : {0.01, 1.0, 30.0})
      {
        const auto change = absorber.changes(noise, 0 * at_nodes, time);
        CHECK(kinetic(noise + change.particles) < kinetic(noise));
        const coupling::CarrierRows impulse = change.particles.cwiseQuotient(carriers.inverse_mass);
        CHECK(impulse.colwise().sum().norm() <= 1e-10 * impulse.norm());
        Vector3d turn = Vector3d::Zero();
        for (int i = 0; i < count; ++i)
          turn += carriers.places[static_cast<std::size_t>(i)].cross(Vector3d(impulse.row(i)));
        CHECK(turn.norm() <= 1e-10 * impulse.norm());
      }
  }
  SECTION("multipliers leave nothing of what they forbid, and are the smallest impulses that do")
  {
    const coupling::Multipliers ties(of_nodes, carriers.inverse_mass, node_masses, Compatibility::coarse, false);
    const auto                  change = ties.changes(noise, at_nodes);
    const coupling::CarrierRows v = noise + change.particles, nodes = at_nodes + change.nodes;
    const coupling::CarrierRows left = of_nodes.transpose() * (v - of_nodes * nodes);
    CHECK(left.norm() <= 1e-9 * (of_nodes.transpose() * noise).norm());
    // Orthogonal, in the masses, to all that obeys.
    const auto again = ties.changes(change.particles, change.nodes);
    CHECK((again.particles + change.particles).norm() <= 1e-9 * change.particles.norm());
  }
}

TEST_CASE("volume coupling: S10, a solid a hundred times as soft, fifty steps of particles in one: energy never grows",
          "[coupling][volume][slow]")
{
  for (const auto &[name, method] : methods())
    if (method.method == VolumeMethod::multipliers)
      {
        INFO(name);
        // A fifth of the stable step of the particles: fifty of them in one of the solid.
        Bar<2> bar(method, 0.2, 50, 100);
        bar.set_velocity(Bar<2>::noise);
        bar.advance(5);
        const double energy = bar.energy(), made = bar.coupled->balance().made();
        double       most = 0;
        while (bar.particles.steps() < 100000)
          {
            const auto taken = bar.both->advance(1);
            REQUIRE(taken.particles >= 40);
            most = std::max(most, bar.coupled->balance().made() - made);
          }
        CHECK(most <= 1e-3 * energy);
        CHECK(bar.energy() <= 1.001 * energy);
      }
}

TEST_CASE("volume coupling: a million steps close to the critical one neither make nor lose energy",
          "[coupling][volume][slow]")
{
  Bar<2> bar(tied(Compatibility::coarse), 0.99);
  bar.set_velocity(Bar<2>::noise);
  bar.advance(5);
  const double energy = bar.energy(), made = bar.coupled->balance().made();
  for (int block = 0; block < 100; ++block)
    {
      bar.advance(10000);
      REQUIRE(std::fabs(bar.coupled->balance().made() - made) <= 1e-6 * energy);
      REQUIRE(std::fabs(bar.particles.energy().residual()) <= 1e-3 * energy);
    }
}

TEST_CASE("volume coupling: the same bits with 1 and 2 threads, and after a restart", "[coupling][volume]")
{
  const auto run = [](const int threads, const bool restart) {
    omp_set_num_threads(threads);
    Bar<3> bar(tied(Compatibility::coarse, false, true));
    bar.set_velocity(Bar<3>::noise);
    bar.advance(40);
    Bar<3> fresh(tied(Compatibility::coarse, false, true));
    if (restart)
      {
        MemoryState         memory;
        MemoryState::Writer writer(memory);
        bar.particles.visit_state(writer);
        bar.both->visit_state(writer);
        MemoryState::Reader reader(memory);
        fresh.particles.visit_state(reader);
        fresh.both->visit_state(reader);
        fresh.motion->restore(bar.motion->state());
      }
    Bar<3> &on = restart ? fresh : bar;
    on.advance(40);
    std::vector<double> all;
    for (std::size_t i = 0; i < on.particles.counts().particles; ++i)
      for (int c = 0; c < 3; ++c)
        all.push_back(on.particles.particle(i).velocity[c]);
    for (std::size_t i = 0; i < on.participant->carriers(); ++i)
      for (int c = 0; c < 3; ++c)
        all.push_back(on.participant->velocity(i)[c]);
    return all;
  };
  const auto once = run(1, false);
  CHECK(once == run(2, false));
  omp_set_num_threads(1);
  CHECK(once == run(1, true));
}

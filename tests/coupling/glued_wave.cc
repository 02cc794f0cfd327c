// A wave through a glued interface: a row of discs on a bar of elements.
#include "block_fixture.h"

#include <catch2/catch.hpp>

using namespace block;

namespace
{
  constexpr double radius = 0.01, strip_width = 2 * radius, strip_modulus = 1e8, disc_density = 2500,
                   bar_density = 2400;

  /** Stiffness of a link, mass of a disc, and their wave: impedance sqrt(k m), speed 2 r sqrt(k/m). */
  const double link = strip_modulus * strip_width / (2 * radius), mass = disc_density * M_PI * radius * radius,
               impedance = std::sqrt(link * mass), speed = 2 * radius * std::sqrt(link / mass);

  /** Reflected over incident velocity, and the same of energy. */
  struct Reflection
  {
    double velocity, energy;
  };

  /** A pulse runs down a row of discs, which is glued to a bar of this many times its impedance. */
  Reflection reflection(const double ratio)
  {
    constexpr int discs = 220;
    dem::Packing  packing;
    for (int i = 0; i < discs; ++i)
      packing.centre.emplace_back(0.5 * strip_width, (2 * i + 1) * radius, 0);
    packing.radius.assign(discs, radius);
    auto p              = cluster::bonded(1.02);
    p.physics.dimension = 2;
    p.thickness         = 1;
    p.density           = disc_density;
    p.damping           = 0;
    p.step_factor       = 0.2;
    dem::ParallelBondParameters bonds;
    bonds.effective_modulus      = 1; // of the contact under a bond, which would stiffen it in compression alone
    bonds.bond_effective_modulus = strip_modulus;
    bonds.tensile_strength = bonds.cohesion = 1e12;
    dem::Specimen row(packing, p, bonds);

    const double            young  = std::pow(ratio * impedance / strip_width, 2) / bar_density;
    const double            length = 1.5, height = 0.5 * strip_width;
    const auto              elements = static_cast<unsigned int>(std::lround(length / height));
    fem::SolidOptions       options;
    const fem::BuildMesh<2> bar = [&](dealii::Triangulation<2> &mesh) {
      dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {1, elements}, {0, -length}, {strip_width, 0}, true);
    };
    fem::Solid<2> solid(fem::make_mesh<2>(bar, fem::ElementFamily::hypercube, MPI_COMM_SELF), options);
    for (const auto &entry : std::map(solid.mesh().materials))
      solid.assign(entry.first, fem::make_points(elastic(young, 0), fem::Plane::strain));
    fem::Loads<2> loads;
    loads.may_move_freely = true;
    solid.set_loads(loads);
    fem::ExplicitOptions explicitly;
    for (const auto &entry : solid.mesh().materials)
      explicitly.density[entry.first] = bar_density;
    fem::ExplicitSolver<2>              motion(solid, explicitly);
    coupling::SolidParticipant<2>       participant(solid, motion);
    coupling::ConcurrentMotion<2>       both(row, solid, motion, participant);
    coupling::SurfaceCouplingParameters glued{"foot", {"3"}, rough()};
    glued.glue.within = 1e-6;
    both.add_surface(glued);

    // At rest but for its speed: one half of it runs down, the other up.
    const double start = 2 * radius * 60, spread = 2 * radius * 10;
    for (int i = 0; i < discs; ++i)
      {
        const double away = (packing.centre[static_cast<std::size_t>(i)].y() - start) / spread;
        row.set_velocity(static_cast<std::size_t>(i), {0, -1e-3 * std::exp(-away * away), 0}, {0, 0, 0});
      }
    const double end   = 2 * start / speed; // the reflected pulse is where it came from
    double       whole = 0, incident = 0, back = 0;
    while (row.time() < end)
      {
        both.advance(end - row.time());
        whole             = std::max(whole, row.energy().kinetic);
        const double seen = row.particle(30).velocity.y(); // half way
        if (row.time() < 0.5 * end && std::fabs(seen) > std::fabs(incident))
          incident = seen;
        if (row.time() > 0.5 * end && std::fabs(seen) > std::fabs(back))
          back = seen;
      }
    const double initial = row.energy().initial, in_row = row.energy().kinetic + row.energy().elastic;
    CHECK(incident == Approx(-0.5e-3).epsilon(0.02));
    CHECK(initial == Approx(whole).epsilon(1e-3));
    CHECK(in_row + motion.energy().kinetic + motion.energy().internal == Approx(initial).epsilon(2e-3));
    return {back / incident, 2 * in_row / initial - 1};
  }
} // namespace

TEST_CASE("glued interface: a wave passes to a like bar, and returns from another by the theory of bars", "[coupling]")
{
  // Of velocity (Z1 - Z2)/(Z1 + Z2), of energy its square: J. D. Achenbach, Wave Propagation in Elastic Solids (1973), 1.4.
  const Reflection same = reflection(1);
  CHECK(std::fabs(same.velocity) < 0.01);
  CHECK(std::fabs(same.energy) < 0.002);
  for (const double ratio : {2.0, 0.5})
    {
      INFO("impedance times " << ratio);
      const Reflection found  = reflection(ratio);
      const double     theory = (1 - ratio) / (1 + ratio);
      CHECK(found.velocity == Approx(theory).epsilon(0.03));
      CHECK(found.energy == Approx(theory * theory).epsilon(0.03));
    }
}

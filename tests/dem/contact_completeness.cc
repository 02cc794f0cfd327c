#include "closed_system.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/specimen.h"
#include "periodic_cell_fixture.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <omp.h>

#include <array>
#include <cmath>
#include <set>

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A list of neighbours is made rarely and visited rarely; here every step is compared with all pairs there are. Two particles that
// fly at each other, each as fast as any, are what a bound that is too wide misses first: hence so many of equal speed.

namespace
{
  const double r = 1e-3;

  /** Two particles, and the periodic cells between them. */
  using Meeting = std::array<long, 5>;

  Meeting meeting(const std::size_t first, const std::size_t second, const std::array<long, 3> &cells)
  {
    const auto a = static_cast<long>(first), b = static_cast<long>(second);
    const bool turned = a > b || (a == b && cells < std::array<long, 3>{{0, 0, 0}});
    return turned ? Meeting{{b, a, -cells[0], -cells[1], -cells[2]}} : Meeting{{a, b, cells[0], cells[1], cells[2]}};
  }

  /** Compares what touches in a specimen with what ought to, step by step. */
  class Witness
  {
  public:
    /** @param contacts_wait they carry force from the first step that finds them touching, and not the one after */
    explicit Witness(const dem::Specimen &watched, const bool contacts_wait = false)
      : specimen(watched)
      , at_forces(contacts_wait)
      , periodic(watched.parameters().physics.periodic)
    {
    }

    void check_all()
    {
      dem::ParticleOutput body = specimen.particles();
      base                     = Matrix3d(1e9 * Matrix3d::Identity());
      if (periodic)
        base = specimen.cell().base;
      if (periodic && at_forces)
        base = specimen.cell().deformation_at_forces * specimen.cell().deformation.inverse() * base;
      for (std::size_t i = 0; at_forces && i < body.position.size(); ++i)
        body.position[i] -= specimen.particle(i).moved;
      inverse                        = base.inverse();
      const std::set<Meeting> before = std::move(joined), touched_before = std::move(touching);
      collect(body);
      for (const Meeting &m : touching)
        if (touched_before.count(m) == 0)
          {
            ++born;
            extra += gap(body, m) > rounding;
            late += before.count(m) == 0 && overlapping.count(m) > 0;
          }
      overlapping.clear();
      for (std::size_t i = 0; i < body.position.size(); ++i)
        for (std::size_t j = i; j < body.position.size(); ++j)
          compare(body, i, j);
    }

    int born = 0, missed = 0, late = 0, extra = 0;

  private:
    static constexpr double rounding = 1e-12 * 1e-3; // of places some thousand radii from the origin [m]

    void collect(const dem::ParticleOutput &body)
    {
      joined.clear();
      touching.clear();
      const dem::LinkOutput links = specimen.links();
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        {
          if (links.kind[l] == dem::LinkOutput::broken)
            continue;
          const auto [i, j]        = links.ends[l];
          const Vector3d      away = inverse * (links.load[l].branch - (body.position[j] - body.position[i]));
          std::array<long, 3> cells{};
          for (int d = 0; d < 3; ++d)
            cells[static_cast<std::size_t>(d)] = std::lround(away[d]);
          const Meeting m = meeting(i, j, cells);
          joined.insert(m);
          if (links.kind[l] == dem::LinkOutput::contact)
            touching.insert(m);
        }
    }

    double gap(const dem::ParticleOutput &body, const Meeting &m) const
    {
      const auto i = static_cast<std::size_t>(m[0]), j = static_cast<std::size_t>(m[1]);
      const auto cells = Vector3d(static_cast<double>(m[2]), static_cast<double>(m[3]), static_cast<double>(m[4]));
      return (body.position[j] - body.position[i] + base * cells).norm() - body.radius[i] - body.radius[j];
    }

    /** One pair, with the images of the second that are nearest. */
    void compare(const dem::ParticleOutput &body, const std::size_t i, const std::size_t j)
    {
      const Vector3d between = inverse * (body.position[i] - body.position[j]);
      const long     around  = periodic ? 1 : 0;
      for (long a = -around; a <= around; ++a)
        for (long b = -around; b <= around; ++b)
          for (long c = -around; c <= around; ++c)
            {
              const std::array<long, 3> cells = {
                {std::lround(between[0]) + a, std::lround(between[1]) + b, std::lround(between[2]) + c}};
              if (i == j && cells <= std::array<long, 3>{{0, 0, 0}})
                continue;
              const Meeting m = meeting(i, j, cells);
              if (gap(body, m) < -rounding)
                {
                  overlapping.insert(m);
                  missed += joined.count(m) == 0;
                }
            }
    }

    const dem::Specimen &specimen;
    bool                 at_forces, periodic;
    Matrix3d             base, inverse;
    std::set<Meeting>    joined, touching, overlapping;
  };

  /** Glue that lets go at the first touch. */
  dem::CpmParameters glue()
  {
    dem::CpmParameters law   = cluster::concrete();
    law.limit_elastic_strain = 1e-6;
    law.relative_ductility   = 2;
    return law;
  }

  constexpr int layers = 4, width = 4; ///< of a pile

  /** Layers across x, linked within and apart from each other by differing gaps; every other one will fly the other way. */
  dem::Packing pile(const double between, const double within, const std::vector<double> &radii)
  {
    dem::Packing       packing;
    dem::UniformRandom random(8);
    for (int i = 0; i < layers; ++i)
      for (int j = 0; j < width; ++j)
        for (int k = 0; k < width; ++k)
          {
            const double shift = 0.25 * r * (2 * random() - 1);
            packing.centre.emplace_back(between * i + shift, within * j, within * k);
            packing.radius.push_back(radii[static_cast<std::size_t>(i + j + k) % radii.size()]);
          }
    return packing;
  }

  /** Layers fly at each other, all particles about as fast. */
  void fly(dem::Specimen &specimen, const double speed)
  {
    dem::UniformRandom random(9);
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      {
        const double way = i / (width * width) % 2 == 0 ? 1 : -1;
        specimen.set_velocity(i, speed * (way * Vector3d::UnitX() + 0.02 * cluster::random_vector(random)),
                              Vector3d::Zero());
      }
  }

  void watch(dem::Specimen &specimen, const int steps, const int meetings, const bool contacts_wait = false)
  {
    omp_set_num_threads(1);
    Witness witness(specimen, contacts_wait);
    for (int n = 0; n < steps; ++n)
      {
        specimen.advance(1);
        witness.check_all();
      }
    CHECK(witness.missed == 0);
    CHECK(witness.late == 0);
    CHECK(witness.extra == 0);
    CHECK(witness.born > meetings); // otherwise nothing is proved
    CHECK(specimen.counts().neighbour_searches > 1);
    CHECK(specimen.counts().neighbour_searches < steps / 2); // rarely enough that lists are put to the test
  }
} // namespace

TEST_CASE("no contact of a body that flies apart is missed, late or made up", "[dem][contacts]")
{
  dem::Specimen specimen(pile(3 * r, 2.1 * r, {r}), cluster::bonded(1.2), glue());
  fly(specimen, 8);
  watch(specimen, 2000, 30);
}

TEST_CASE("no contact between three sizes of particles is missed, late or made up", "[dem][contacts]")
{
  dem::Specimen specimen(pile(2.4 * r, 1.6 * r, {r, 0.5 * r, 0.2 * r}), cluster::bonded(1.2), glue());
  fly(specimen, 8);
  watch(specimen, 2500, 30);
}

TEST_CASE("no contact in a periodic cell that shrinks and shears is missed, late or made up", "[dem][contacts][slow]")
{
  dem::Packing packing  = pile(3 * r, 2.1 * r, {r, 0.9 * r});
  packing.periodic_cell = r * Vector3d(3 * layers, 2.1 * width, 2.1 * width);
  auto p                = cluster::bonded(1.2);
  p.physics.periodic    = true;
  Matrix3d gradient;
  SECTION("particles fly through the cell")
  {
    gradient << -60, 40, 0, 0, -20, 0, 0, 0, -40;
    dem::Specimen specimen(packing, p, glue());
    specimen.set_velocity_gradient(gradient);
    fly(specimen, 8);
    watch(specimen, 2000, 30);
  }
  SECTION("the cell alone brings them together")
  {
    gradient << -1500, 0, 0, 0, 0, 0, 0, 0, 0;
    dem::Specimen specimen(packing, p, glue());
    specimen.set_velocity_gradient(gradient);
    watch(specimen, 1500, 30);
  }
}

namespace
{
  /** Stiff and rough, unbonded. */
  dem::LinearContactParameters marbles()
  {
    dem::LinearContactParameters law;
    law.effective_modulus    = 1e9;
    law.friction_coefficient = 0.5;
    return law;
  }
} // namespace

TEST_CASE("no contact is missed or made up where contacts wait for their particles", "[dem][contacts]")
{
  dem::Packing packing = pile(2.4 * r, 2.1 * r, {r, 0.7 * r});
  auto         p       = cluster::bonded(1.0);
  SECTION("in the open")
  {
    dem::Specimen specimen(packing, p, marbles());
    fly(specimen, 8);
    watch(specimen, 2000, 30, true);
  }
  SECTION("in a periodic cell that shrinks and shears")
  {
    packing.periodic_cell = r * Vector3d(2.4 * layers, 2.1 * width, 2.1 * width);
    p.physics.periodic    = true;
    Matrix3d gradient;
    gradient << -60, 40, 0, 0, -20, 0, 0, 0, -40;
    dem::Specimen specimen(packing, p, marbles());
    specimen.set_velocity_gradient(gradient);
    fly(specimen, 8);
    watch(specimen, 2000, 30, true);
  }
}

TEST_CASE("no contact of a projectile and what flies at it is missed, late or made up", "[dem][contacts]")
{
  omp_set_num_threads(1);
  const double speed = 8, size = 1.5 * r;
  int          met = 0;
  for (int start = 0; start < 8; ++start) // wherever it is in the life of a list when it hits
    {
      dem::Packing packing = cluster::cubic_lattice(3, 3, 3, 1.01 * r);
      packing.centre.emplace_back(2 * r, 2 * r, 2 * 2.02 * r + r + size + (1.2 + 0.03 * start) * r);
      packing.radius.push_back(size);
      auto p  = cluster::bonded(1.5);
      p.loose = 1;
      dem::Specimen specimen(packing, p, cluster::concrete());
      for (std::size_t i = 0; i < packing.size(); ++i)
        specimen.set_velocity(i, (i + 1 < packing.size() ? speed : -speed) * Vector3d::UnitZ(), Vector3d::Zero());
      Witness witness(specimen);
      for (int n = 0; n < 600; ++n)
        {
          specimen.advance(1);
          witness.check_all();
        }
      CHECK(witness.missed == 0);
      CHECK(witness.late == 0);
      CHECK(witness.extra == 0);
      met += witness.born > 0 ? 1 : 0;
      CHECK(specimen.counts().neighbour_searches < 600 / 10);
    }
  CHECK(met == 8);
}

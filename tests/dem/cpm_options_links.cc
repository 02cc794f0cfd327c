// Links of the cohesive particle model with options, as the kernel, the solvers and the energy account have them.
#include "closed_system.h"
#include "dem/laws/cpm.h"
#include "dem/specimen/specimen.h"
#include "same_bits.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using Eigen::Vector3d;

namespace
{
  dem::CpmParameters concrete_of_links()
  {
    dem::CpmParameters p = cluster::concrete();
    p.relative_ductility = 5;
    return p;
  }

  /** Each option alone, and all together with damage by shear. */
  std::vector<std::pair<std::string, dem::CpmParameters>> optional_laws()
  {
    const dem::CpmParameters plain = concrete_of_links();
    auto                     flow = plain, curved = plain, damage = plain, slip = plain, pressed = plain, all = plain;
    flow.options.compression_yield_strain = -1.2e-4;
    curved.options.strength_surface       = dem::StrengthSurface::logarithmic;
    damage.options.damage_time            = 20;
    damage.options.damage_exponent        = 0.4;
    slip.options.plastic_time             = 20;
    slip.options.plastic_exponent         = 0.4;
    pressed.options.prestress             = -1e6;
    all.shear_contribution                = 0.4;
    all.options                           = damage.options;
    all.options.compression_yield_strain  = -1.2e-4;
    all.options.strength_surface          = dem::StrengthSurface::logarithmic;
    all.options.plastic_time              = 20;
    all.options.plastic_exponent          = 0.3;
    all.options.prestress                 = -1e6;
    return {{"flow", flow}, {"curved", curved}, {"damage", damage}, {"slip", slip}, {"pressed", pressed}, {"all", all}};
  }

  /** One link in space, driven along a smooth random way in a tenth of a second. */
  struct OneLink
  {
    explicit OneLink(const dem::CpmParameters &p)
      : law(dem::CpmLaw::bonds({p}, {}, 3))
      , history(law->columns().size(), 0.0)
      , before(history)
    {
      dem::NewLink born;
      born.distance     = 2e-3;
      born.first_radius = born.second_radius = 1e-3;
      born.area                              = 3e-6;
      law->begin(0, born, history.data());
      step.geometry = {0, 2e-3, 2e-3, 3e-6};
    }
    void advance(const double strain, const Vector3d &slip, const double per_second)
    {
      step.strain_before   = step.geometry.strain;
      step.geometry.strain = strain;
      step.geometry.length = (1 + strain) * step.geometry.reference;
      step.shear_increment = slip;
      step.per_second      = per_second;
      before               = history;
      answer               = law->update(0, step, before.data(), history.data());
    }
    double stored() const { return law->stored(0, step.geometry, history.data()); }
    double damaged() const { return law->damage_dissipation(0, step.geometry, history.data()); }

    std::shared_ptr<const dem::LinkLaw> law;
    std::vector<double>                 history, before;
    dem::LinkStep                       step;
    dem::LinkAnswer                     answer;
  };

  double way(const int c, const double t)
  {
    return 4e-4 * t * std::sin((7 + 4 * c) * t + 0.7 * c + (c == 0 ? 3.3 : 0.0));
  }

  /** Part of the energy that is missing at the end of the way. @param spent by damage, sliding, rate */
  double missing_part(const dem::CpmParameters &p, const int steps, double (&spent)[3])
  {
    OneLink link(p);
    double  work = 0, largest = 0;
    std::fill_n(spent, 3, 0.0);
    for (int i = 1; i <= steps; ++i)
      {
        const double   now = double(i) / steps, then = double(i - 1) / steps;
        const Vector3d slip(0, way(1, now) - way(1, then), way(2, now) - way(2, then));
        const Vector3d force = link.answer.force;
        link.advance(way(0, now), slip, steps / 0.1);
        const Vector3d moved = 2e-3 * (Vector3d(way(0, now) - way(0, then), 0, 0) + slip);
        work += 0.5 * (force + link.answer.force).dot(moved);
        CHECK(link.answer.damage >= 0);
        CHECK(link.answer.friction >= 0);
        CHECK(link.answer.viscous >= 0);
        spent[0] += link.answer.damage;
        spent[1] += link.answer.friction;
        spent[2] += link.answer.viscous;
        largest = std::max(largest, link.stored() + spent[0] + spent[1] + spent[2]);
      }
    spent[0] += link.damaged();
    return std::abs(work - link.stored() - spent[0] - spent[1] - spent[2]) / largest;
  }

  dem::SpecimenParameters torn(const double step_factor)
  {
    auto p        = cluster::bonded(1.4);
    p.damping     = 0;
    p.step_factor = step_factor;
    return p;
  }

  /** Rates of colliding clusters are some 1e3 /s: the delays must be short to be seen beside the other mechanisms. */
  dem::CpmParameters quick(dem::CpmParameters p)
  {
    if (p.options.damage_time > 0)
      p.options.damage_time = 1e-2;
    if (p.options.plastic_time > 0)
      p.options.plastic_time = 1e-2;
    return p;
  }
} // namespace

TEST_CASE("CPM options: work of a link is what it stores and dissipates, ever closer with the step", "[dem][laws]")
{
  for (const auto &[name, p] : optional_laws())
    {
      INFO(name);
      double       spent[3], coarse[3];
      const double rough = missing_part(p, 4000, coarse), fine = missing_part(p, 32000, spent);
      INFO(rough << " " << fine);
      CHECK(spent[0] > 0);
      CHECK(spent[1] > 0);
      CHECK((spent[2] > 0) == p.options.depends_on_rate());
      CHECK(fine < 1e-3);
      CHECK(fine < std::max(0.3 * rough, 1e-9));
    }
}

TEST_CASE("CPM options: a new link stores nothing and pulls nothing, prestressed or not", "[dem][laws]")
{
  for (const auto &[name, p] : optional_laws())
    {
      OneLink link(p);
      CHECK(link.stored() == Approx(0).margin(1e-18));
      link.advance(0, Vector3d::Zero(), 1e6);
      CHECK(link.answer.force.norm() < 1e-12 * 25e9 * 1e-4 * 3e-6);
      CHECK(link.answer.friction + link.answer.damage + link.answer.viscous == Approx(0).margin(1e-18));
    }
}

TEST_CASE("CPM options: the tangent is the derivative of the update where no time passes", "[dem][laws][statics]")
{
  dem::UniformRandom random(9);
  for (const auto &[name, p] : optional_laws())
    {
      int compared = 0;
      for (int trial = 0; trial < 100; ++trial)
        {
          OneLink    link(p);
          const auto driven = [&](const double size) {
            link.advance(size * (2 * random() - 1), size * Vector3d(0, 2 * random() - 1, 2 * random() - 1), 0);
          };
          driven(3e-4);
          const OneLink start = link;
          driven(3e-4);
          const auto answer_at = [&](const Vector3d &change) {
            OneLink moved = start;
            moved.advance(link.step.geometry.strain + change[0],
                          link.step.shear_increment + Vector3d(0, change[1], change[2]), 0);
            return Vector3d(moved.answer.force / 3e-6);
          };
          dem::LinkTangent kind;
          kind.damages =
            link.law->damaging_strain(0, link.history.data()) > link.law->damaging_strain(0, start.history.data());
          kind.slides  = link.answer.slides;
          const auto C = link.law->tangent(0, link.step, start.history.data(), link.history.data(), kind)
                           .topLeftCorner<3, 3>()
                           .eval();
          const double h    = 1e-10;
          bool         kink = false; // within h of another branch
          double       off  = 0;
          for (int c = 0; c < 3; ++c)
            {
              const Vector3d forward  = (answer_at(h * Vector3d::Unit(c)) - answer_at(Vector3d::Zero())) / h,
                             backward = (answer_at(Vector3d::Zero()) - answer_at(-h * Vector3d::Unit(c))) / h;
              kink                    = kink || (forward - backward).norm() > 1e-3 * 25e9;
              off                     = std::max(off, (0.5 * (forward + backward) - C.col(c)).norm() / 25e9);
            }
          INFO(name << ", trial " << trial);
          if (kink)
            continue;
          ++compared;
          CHECK(off < 2e-5);
        }
      CHECK(compared > 70);
    }
}

TEST_CASE("CPM options: energy of bodies that break, flow, slide and delay stays accounted for", "[dem][laws]")
{
  omp_set_num_threads(1);
  for (const auto &[name, p] : optional_laws())
    {
      INFO(name);
      dem::Specimen specimen(cluster::colliding_clusters(60), torn(0.2), quick(p));
      cluster::set_colliding_velocities(specimen, 10);
      const cluster::Momenta start = cluster::momenta(specimen);
      specimen.advance(8000);
      const dem::EnergyAccount energy = specimen.energy();
      CHECK(energy.balance_error() < 1e-3);
      CHECK(energy.damage > 0);
      CHECK(energy.friction > 0);
      CHECK((energy.damping > 1e-3 * energy.initial) == p.options.depends_on_rate()); // nothing else damps
      const cluster::Momenta end = cluster::momenta(specimen);
      CHECK((end.linear - start.linear).norm() < 1e-11 * end.linear_scale);
      CHECK((end.angular - start.angular).norm() < 1e-11 * end.angular_scale);
    }
}

TEST_CASE("CPM options: the same bits for any threads and after a restart, with all of them on", "[dem][laws]")
{
  const dem::CpmParameters all = quick(optional_laws().back().second);
  check_same_bits(
    [&] {
      dem::Specimen specimen(cluster::colliding_clusters(30), torn(0.4), all);
      cluster::set_colliding_velocities(specimen, 150);
      return specimen;
    },
    40, 60, 5);
}

TEST_CASE("CPM options: two materials, each with options of its own, in one pass", "[dem][laws]")
{
  const dem::CpmParameters all     = quick(optional_laws().back().second);
  dem::CpmParameters       stiffer = all;
  stiffer.normal_modulus *= 2;
  stiffer.options.damage_time *= 3;
  dem::Packing packing = cluster::cubic_lattice(5, 5, 5, 1e-3);
  packing.material.resize(packing.size());
  for (std::size_t i = 0; i < packing.size(); ++i)
    packing.material[i] = static_cast<std::int32_t>(i % 2);
  const auto made = [&](const dem::CpmParameters &other) {
    dem::Specimen specimen(packing, torn(0.2), dem::CpmMaterials({{"a", all, 0}, {"b", other, 0}}));
    for (std::size_t i = 0; i < packing.size(); ++i)
      specimen.set_velocity(i, {400 * (packing.centre[i].x() - 4e-3), 0, 0}, {0, 0, 0});
    specimen.advance(2000);
    return specimen.energy();
  };
  // Equal constants by pairs are the one material; others are not.
  dem::Packing plain = packing;
  plain.material.clear();
  dem::Specimen one(plain, torn(0.2), all);
  for (std::size_t i = 0; i < packing.size(); ++i)
    one.set_velocity(i, {400 * (packing.centre[i].x() - 4e-3), 0, 0}, {0, 0, 0});
  one.advance(2000);
  const dem::EnergyAccount same = made(all), unlike = made(stiffer);
  CHECK(same.damping == Approx(one.energy().damping).epsilon(1e-12));
  CHECK(same.damage == Approx(one.energy().damage).epsilon(1e-12));
  CHECK(unlike.damping > same.damping);
  CHECK(unlike.balance_error() < 1e-3);
}

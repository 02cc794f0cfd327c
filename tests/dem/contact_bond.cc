// Contact bonds, and the incremental form of linear contacts, against closed forms: doc/theory/contact-bond.md, linear-contact.md.
#include "dem/laws/contact_bond.h"

#include "clusters.h"
#include "held_pair.h"
#include "same_bits.h"
#include "two_materials.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  using namespace held_pair;

  dem::ContactBondParameters glue() { return bond_of_mortar<dem::ContactBondParameters>(); }
} // namespace

TEST_CASE("contact bond in tension breaks at its strength and then carries nothing (T1)", "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double angle : {0.0, 2.0})
      check_tension(glue(), dimension, angle);
}

TEST_CASE("contact bond in shear breaks at its cohesion, whatever presses it, and then slides at mu |F_n|",
          "[dem][laws]")
{
  for (const int dimension : {2, 3})
    for (const double pressure : {0.0, 1e6, 5e6})
      {
        const auto law = glue();
        HeldPair   pair(dimension, law);
        if (pressure > 0)
          {
            pair.drive(-pressure * 2 * R / law.effective_modulus, 0, 0, 1000);
            pair.specimen.advance(1000);
          }
        pair.drive(0, 1.2 * law.cohesion * 2 * R / (law.effective_modulus / law.stiffness_ratio), 0, 2000);
        double peak = 0;
        for (int i = 0; i < 2000 && pair.intact() > 0; ++i)
          {
            pair.specimen.advance(1);
            if (pair.intact() > 0)
              peak = pair.specimen.links().shear_force.at(0);
          }
        REQUIRE(pair.intact() == 0);
        CHECK(peak == Approx(law.cohesion * section(dimension)).epsilon(1.5e-3));
        pair.specimen.advance(1);
        if (pressure > 0)
          {
            const dem::LinkOutput links = pair.specimen.links();
            CHECK(links.normal_force.at(0) == Approx(-pressure * section(dimension)).epsilon(5e-3));
            CHECK(links.shear_force.at(0) ==
                  Approx(-law.friction_coefficient * links.normal_force.at(0)).epsilon(1e-9));
            CHECK(links.kind.at(0) == dem::LinkOutput::contact);
          }
        CHECK(pair.specimen.energy().balance_error() < 1e-4);
      }
}

TEST_CASE("contact-bonded body of two materials that breaks has the same bits for any threads, and closes its account",
          "[dem][laws]")
{
  dem::Packing body = cluster::random_cluster(11, 200, 0.7 * R, R);
  for (std::size_t i = 0; i < body.size(); ++i)
    body.material.push_back(body.centre[i].x() > 0 ? 1 : 0);
  auto weak             = glue();
  weak.tensile_strength = 0.1e6;
  weak.cohesion         = 0.5e6;
  const dem::Materials<dem::ContactBondParameters> materials({{"strong", glue(), 0}, {"weak", weak, 0}});
  dem::SpecimenParameters                          p = cluster::bonded(1.2);
  p.step_factor                                      = 0.1;
  const auto made                                    = [&] {
    dem::Specimen specimen(body, p, materials);
    for (std::size_t i = 0; i < body.size(); ++i)
      specimen.set_velocity(i, 40.0 * body.centre[i], Vector3d(30, -20, 10));
    return specimen;
  };
  check_same_bits(made, 300, 300, 11);
  dem::Specimen one = made();
  one.advance(600);
  CHECK(one.energy().balance_error() < 1e-2);
}

TEST_CASE("incremental linear contact is without force where particles overlapped when it was made", "[dem][laws]")
{
  dem::LinearContactParameters p;
  p.effective_modulus    = 1e9;
  p.friction_coefficient = 0.3;
  for (const auto kind : {dem::NormalForce::absolute, dem::NormalForce::incremental})
    {
      p.normal_force   = kind;
      const auto   law = dem::LinkMaterials(p).contacts_in_space(dem::Physics());
      dem::NewLink made;
      made.distance     = 2 * R * (1 - 1e-3);
      made.first_radius = made.second_radius = R;
      made.area                              = 1e-6;
      std::vector<double> history(law->columns().size(), 0.0);
      law->begin(0, made, history.data());
      dem::LinkStep step;
      step.geometry   = {-1e-3, made.distance, 2 * R, 1e-6};
      const auto push = [&](const double strain) {
        step.strain_before   = step.geometry.strain;
        step.geometry.strain = strain;
        return law->update(0, step, std::vector<double>(history).data(), history.data()).force.x();
      };
      const bool whole = kind == dem::NormalForce::absolute;
      CHECK(push(-1e-3) == Approx(whole ? -1.0 : 0.0).margin(1e-12));
      CHECK(push(-3e-3) == Approx(whole ? -3.0 : -2.0));
      CHECK(push(-0.5e-3) == Approx(whole ? -0.5 : 0.0).margin(1e-12)); // never in tension
      CHECK(push(-2.5e-3) == Approx(whole ? -2.5 : -2.0));
      CHECK(push(1e-3) == 0);
      CHECK(push(-1e-3) == Approx(-1)); // of this step the part in touch
    }
}

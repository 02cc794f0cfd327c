// Hard case S15: elements of flat joints that open and close every few steps, a gap of exactly zero, partial debonding under an
// alternating moment.

#include "tests/dem/held_joint.h"

#include <catch2/catch.hpp>

#include <cmath>

using Eigen::Vector3d;
using held_joint::Joint;
using held_joint::mortar;
using held_joint::pi;
using held_joint::R;

TEST_CASE("flat joints that open and close under an alternating moment create no energy (S15)", "[dem][laws][S15]")
{
  for (const int dimension : {2, 3})
    for (const double friction : {0.0, 0.5})
      {
        auto p                 = mortar();
        p.friction_coefficient = friction;
        Joint        joint(p, dimension);
        const double unit  = p.tensile_strength / p.effective_modulus * 2 * R; // opening at the strength
        double       input = 0, stored = 0, lost = 0, work = 0;
        for (int cycle = 0; cycle < 50; ++cycle)
          {
            const int steps = 40; // elements open and close every few of them
            Vector3d  last  = Vector3d::Zero();
            double    bend  = 0;
            for (int i = 1; i <= steps; ++i)
              {
                const double   phase = 2 * pi * i / steps;
                const double   gap  = i == steps ? 0.0 : -0.5 * unit * (1 - std::cos(phase)); // exactly zero at its end
                const double   turn = 2.5 * unit / R * (i == steps ? 0.0 : std::sin(phase));
                const Vector3d slip(0, i == steps ? 0.0 : 2 * unit * std::sin(phase), 0);
                const double   before = joint.work;
                joint.advance(gap, slip - last, Vector3d(0, 0, turn - bend));
                input += std::abs(joint.work - before);
                last = slip;
                bend = turn;
              }
            // What was put in and is not lost is stored; sliding and breaking only ever take.
            if (cycle == 0)
              stored = joint.stored(), lost = joint.lost, work = joint.work;
            else
              {
                const double made = (joint.stored() - stored) + (joint.lost - lost) - (joint.work - work);
                CHECK(joint.lost - lost >= -1e-8 * input);
                CHECK(joint.work - work - (joint.stored() - stored) >= -1e-8 * input);
                if (friction == 0)
                  CHECK(std::abs(made) < 1e-8 * input);
              }
          }
        CHECK(joint.column("broken") > 0);
        CHECK(joint.column("bonded_elements") > 0);
      }
}

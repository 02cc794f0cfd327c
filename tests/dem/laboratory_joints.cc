// A joint through a specimen between platens: doc/theory/smooth-joint.md, 6.
#include "dem/joints/joint_cuts.h"
#include "dem/laws/smooth_joint.h"
#include "laboratory_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace laboratory;

namespace
{
  /** So soft against the blocks that its links bear alike: a brittle bond breaks where it bears most. */
  dem::SmoothJointParameters healed()
  {
    dem::SmoothJointParameters p;
    p.normal_stiffness     = 0.5e11;
    p.shear_stiffness      = 0.25e11;
    p.friction_coefficient = 0.4;
    p.cohesion             = 2e6;
    p.tensile_strength     = 1e6;
    return p;
  }

  /** Stress at which a plane of weakness slides, without pressure from the sides (Jaeger 1960; doc/theory/smooth-joint.md, eq. 7). */
  double stress_of_slip(const double dip, const dem::SmoothJointParameters &joint)
  {
    const double beta = dip * M_PI / 180, mu = joint.friction_coefficient;
    return 2 * joint.cohesion / ((1 - mu / std::tan(beta)) * std::sin(2 * beta));
  }

  /** Strength of a column of discs that nothing breaks but the joint through its middle. @param dip [degrees] */
  double strength_at(const double dip, dem::SmoothJointParameters joint)
  {
    dem::Packing    column = crystal(20, 46);
    dem::JointPlane plane;
    for (const Eigen::Vector3d &each : column.centre)
      plane.centre += each / static_cast<double>(column.size());
    plane.normal                    = dem::normal_of_dip(dip, 0, 2);
    joint.plane                     = plane.normal;
    const dem::SpecimenParameters p = discs();
    column.cuts = dem::find_cuts(column, {2, p.thickness, p.interaction_ratio, 0, column.size()}, {plane}).cuts;
    dem::LabParameters requested = between_platens(0.01);
    requested.stop_strain        = 4 * stress_of_slip(dip, joint) / modulus;
    Run run(column, p, dem::LinkMaterials(strong()).with_joints(std::vector{joint}), requested);
    run.to_end(2000000);
    CHECK(run.body.energy().friction > 0);
    CHECK(run.body.energy().balance_error() < 1e-3);
    return run.test.figures().largest_stress.value;
  }
} // namespace

TEST_CASE("a column with one joint is as strong as the single plane of weakness says, at seven angles",
          "[dem][laboratory][slow]")
{
  for (const double dip : {32.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0})
    {
      INFO("dip " << dip);
      CHECK(strength_at(dip, healed()) == Approx(stress_of_slip(dip, healed())).epsilon(0.05));
    }
}

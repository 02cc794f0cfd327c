// A joint through a specimen between platens: doc/theory/smooth-joint.md, 6.
#include "dem/joints/joint_cuts.h"
#include "dem/laboratory/membrane.h"
#include "dem/laws/smooth_joint.h"
#include "dem/statics/quasi_static_path.h"
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

  /** A column of discs, cut by a joint through its middle. @param dip [degrees] */
  struct JointedColumn
  {
    dem::Packing               column;
    dem::SmoothJointParameters joint;
    Eigen::Vector3d            middle = Eigen::Vector3d::Zero();

    JointedColumn(const int columns, const int rows, const double dip, const dem::SmoothJointParameters &constants)
      : column(crystal(columns, rows))
      , joint(constants)
    {
      for (const Eigen::Vector3d &each : column.centre)
        middle += each / static_cast<double>(column.size());
      dem::JointPlane plane;
      plane.centre = middle;
      plane.normal = joint.plane      = dem::normal_of_dip(dip, 0, 2);
      const dem::SpecimenParameters p = discs();
      column.cuts = dem::find_cuts(column, {2, p.thickness, p.interaction_ratio, 0, column.size()}, {plane}).cuts;
    }
    dem::LinkMaterials law() const { return dem::LinkMaterials(strong()).with_joints(std::vector{joint}); }
    bool               is_above(const std::size_t particle) const
    {
      const double side = joint.plane.dot(column.centre[particle] - middle);
      return joint.plane.y() > 0 ? side > 0 : side < 0;
    }
    dem::GripLayers ends() const
    {
      dem::GripParameters p;
      p.thickness = 0.5 * R;
      return dem::find_grip_layers({column.centre, column.radius, 2, discs().thickness}, 1, p);
    }
    /** Between smooth grips at its ends. */
    dem::LoadedNetwork in_equilibrium() const
    {
      dem::NetworkParameters links;
      links.dimension         = 2;
      links.thickness         = discs().thickness;
      links.interaction_ratio = discs().interaction_ratio;
      dem::GripPair grips;
      grips.axis   = 1;
      grips.layers = ends();
      return dem::load_grips(dem::make_network(column, links, law()), grips);
    }
  };

  /** Strength of a column of discs that nothing breaks but the joint through its middle. @param dip [degrees] */
  double strength_at(const double dip, const dem::SmoothJointParameters &joint)
  {
    const JointedColumn body(20, 46, dip, joint);
    dem::LabParameters  requested = between_platens(0.01);
    requested.stop_strain     = 4 * stress_of_slip(dip, joint) / modulus;
    Run run(body.column, discs(), body.law(), requested);
    run.to_end(2000000);
    CHECK(run.body.energy().friction > 0);
    CHECK(run.body.energy().balance_error() < 1e-3);
    return run.test.figures().largest_stress.value;
  }

  /** The same in equilibrium. */
  double strength_in_equilibrium(const double dip, const dem::SmoothJointParameters &joint)
  {
    const JointedColumn        body(12, 28, dip, joint);
    const dem::LoadedNetwork   loaded = body.in_equilibrium();
    dem::QuasiStaticParameters p;
    p.sign        = -1;
    p.end_strain  = 20 * stress_of_slip(dip, joint) / modulus; // most of it the joint's
    p.strain_step = p.end_strain / 200;
    p.end_stress  = 0.8;
    dem::QuasiStaticPath path(loaded, body.law(), p);
    double               strength = 0;
    while (!path.finished())
      strength = std::max(strength, -path.advance().stress[0]);
    CHECK(path.points().back().balance_error() < 1e-2);
    return strength;
  }

  struct UnderMembrane
  {
    double ratio = 0; ///< axial over lateral stress
    double width = 0; ///< between the ends of the joint as the membrane sees them, over that of the column
  };

  /**
   * A column with an unbonded joint in equilibrium, its sides pressed by a membrane in proportion to the strain: dead loads on particles,
   * borne by places that are tied to them.
   */
  UnderMembrane under_membrane(const JointedColumn &body, const double dip)
  {
    constexpr double   pressure = 0.1 * modulus; // per strain
    dem::LoadedNetwork loaded   = body.in_equilibrium();
    dem::Specimen      still(body.column, discs(), body.law());
    dem::Membrane      membrane(still, 0.5 * R);
    const auto         ends = body.ends();
    dem::EndPlanes     planes{1, ends.low_face - R, ends.high_face + R};
    membrane.lay(planes);
    const auto       pushes = membrane.pushes(pressure, planes);
    dem::ElasticBody around;
    around.stiffness.resize(3 * static_cast<Eigen::Index>(pushes.size()), 3 * static_cast<Eigen::Index>(pushes.size()));
    around.by_load.setZero(around.stiffness.rows());
    std::vector<dem::Tie> ties;
    double                across = 0; // on what is above the joint
    for (std::size_t j = 0; j < pushes.size(); ++j)
      {
        const auto &[particle, force] = pushes[j];
        across += body.is_above(particle) ? force.x() : 0.0;
        around.by_load.segment<3>(3 * static_cast<Eigen::Index>(j)) = force; // of a strain below zero
        const dem::HeldMotions along_x                              = 1;
        const bool             follows                              = !(loaded.held[particle] & along_x);
        loaded.held.push_back(follows ? dem::HeldMotions(~along_x) : dem::HeldMotions(~0u));
        if (follows)
          ties.push_back({{loaded.network.particles() + j, 0, 1.0}, {particle, 0, -1.0}});
      }
    around.load_work = -around.by_load;
    loaded.body      = around;
    loaded.ties      = std::make_shared<dem::Ties>(ties, loaded.held, dem::mean_arm(loaded.network));
    dem::QuasiStaticParameters p;
    p.sign        = -1;
    p.strain_step = p.end_strain = 1e-5;
    dem::QuasiStaticPath path(loaded, body.law(), p);
    while (!path.finished())
      path.advance();
    // The force of the driven parameter is that of the grips and of the membrane.
    const double strain      = path.points().back().strain[0];
    const double of_membrane = around.by_load.dot(dem::joints_of(loaded, path.motion())) / loaded.volume;
    return {(path.points().back().stress[0] - of_membrane) / (pressure * strain),
            std::fabs(across) / (pressure * ends.section * std::tan(dip * M_PI / 180))};
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

TEST_CASE("a column with one joint is as strong in equilibrium as the single plane of weakness says, at seven angles",
          "[dem][laboratory][slow]")
{
  auto joint = healed(); // softer still: where nothing is in motion nothing holds a link that bears more than others
  joint.normal_stiffness /= 5;
  joint.shear_stiffness /= 5;
  for (const double dip : {32.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0})
    {
      INFO("dip " << dip);
      CHECK(strength_in_equilibrium(dip, joint) == Approx(stress_of_slip(dip, joint)).epsilon(0.05));
    }
}

TEST_CASE(
  "under a membrane a joint without bond slides as the wedge above it does, up to three discs narrower than the column",
  "[dem][laboratory][slow]")
{
  auto joint             = healed();
  joint.normal_stiffness = joint.shear_stiffness = 4e12;
  joint.cohesion = joint.tensile_strength = 0;
  const double mu                         = joint.friction_coefficient;
  for (const double dip : {35.0, 45.0, 55.0, 65.0})
    {
      INFO("dip " << dip);
      for (const int columns : {10, 20})
        {
          const UnderMembrane found = under_membrane(JointedColumn(columns, 5 * columns / 2, dip, joint), dip);
          const double        beta  = dip * M_PI / 180;
          // sigma_1 over sigma_3 of eq. 7 without cohesion, of a joint all through the column.
          const double published = 1 + 2 * mu / ((1 - mu / std::tan(beta)) * std::sin(2 * beta));
          CHECK(found.ratio == Approx(found.width * published).epsilon(1e-4));
          CHECK(found.width < 1);
          CHECK(found.width > 1 - 3.0 / columns); // the outermost centres, and half a row of discs more or less
        }
    }
}

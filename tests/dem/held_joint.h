#pragma once

#include "dem/laws/flat_joint.h"
#include "tests/dem/held_pair.h"

#include <memory>
#include <string>
#include <vector>

/** One flat joint of mortar between particles of one millimetre, driven by hand. */
namespace held_joint
{
  using namespace held_pair;

  inline dem::FlatJointParameters mortar(const int elements = 4)
  {
    auto p           = bond_of_mortar<dem::FlatJointParameters>();
    p.friction_angle = 20.7;
    p.elements       = elements;
    return p;
  }

  inline dem::LinkGeometry touching(const double strain = 0)
  {
    return {strain, 2 * R * (1 + strain), 2 * R, 2 * R * thickness};
  }

  /** One joint between equal discs or spheres, made at the distance 2 R, driven by hand. */
  struct Joint
  {
    Joint(const dem::FlatJointParameters &p, const int dimension, const std::int64_t number = 1)
    {
      dem::Physics physics;
      physics.dimension = dimension;
      law               = dem::LinkMaterials(p).bonds_in_space(physics);
      dem::NewLink made;
      made.distance     = 2 * R;
      made.first_radius = made.second_radius = R;
      made.area                              = section(dimension);
      made.thickness                         = dimension == 2 ? thickness : 0;
      made.second_number                     = number;
      history.assign(law->columns().size(), 0.0);
      law->begin(0, made, history.data());
      step.geometry      = touching();
      step.geometry.area = section(dimension);
    }

    void advance(const double gap, const Eigen::Vector3d &slip, const Eigen::Vector3d &turn)
    {
      step.strain_before     = step.geometry.strain;
      step.geometry.strain   = gap / (2 * R);
      step.geometry.length   = 2 * R + gap;
      step.shear_increment   = slip / (2 * R);
      step.twist_increment   = turn.x();
      step.bending_increment = {0, turn.y(), turn.z()};
      const auto before      = history;
      const auto was         = answer;
      answer                 = law->update(0, step, before.data(), history.data());
      const Eigen::Vector3d moved(2 * R * (step.geometry.strain - step.strain_before), slip.y(), slip.z());
      work += 0.5 * (was.force + answer.force).dot(moved) + 0.5 * (was.moment + answer.moment).dot(turn);
      lost += answer.friction + answer.released;
    }
    double column(const std::string &name) const
    {
      const auto columns = law->columns();
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].name == name)
          return history[c];
      FAIL("no column " << name);
      return 0;
    }
    double stored() const { return law->stored(0, step.geometry, history.data()); }

    std::shared_ptr<const dem::LinkLaw> law;
    std::vector<double>                 history;
    dem::LinkStep                       step;
    dem::LinkAnswer                     answer;
    double                              work = 0, lost = 0;
  };
} // namespace held_joint

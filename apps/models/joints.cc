#include "apps/models/joints.h"

#include "base/errors.h"
#include "dem/joints/joint_network.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    /** Segments from corner to corner, or one polygon. @throws base::InputError */
    std::vector<dem::JointPlane> between_corners(const CornerList &corners, const int dimension)
    {
      const std::vector<Eigen::Vector3d> places = places_of(corners, dimension);
      if (dimension == 3)
        return {dem::polygon_joint(places)};
      if (places.size() < 2)
        throw base::InputError("a joint in the plane has at least two corners.");
      std::vector<dem::JointPlane> segments;
      for (std::size_t i = 1; i < places.size(); ++i)
        segments.push_back(dem::segment_joint(places[i - 1], places[i]));
      return segments;
    }

    dem::JointPlane placed(const JointSet &set, const int dimension)
    {
      dem::JointPlane joint;
      joint.centre = {set.place[0], set.place[1], dimension == 2 ? 0.0 : set.place[2]};
      joint.normal = dem::normal_of_dip(set.dip, set.dip_direction, dimension);
      joint.radius = set.shape == JointSet::Shape::disc ? set.radius : 0.0;
      return joint;
    }

    dem::JointNetwork
    network_of(const JointSet &set, const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, const int dimension)
    {
      dem::JointNetwork network;
      network.dimension     = dimension;
      network.lower         = lower;
      network.upper         = upper;
      network.intensity     = set.intensity;
      network.radius        = set.radius;
      network.normal        = dem::normal_of_dip(set.dip, set.dip_direction, dimension);
      network.concentration = set.concentration;
      network.seed          = static_cast<std::uint64_t>(set.seed);
      return network;
    }
  } // namespace

  void JointSection::check(const base::EntryPath &specimen, const int dimension) const
  {
    for (const JointSet &each : sets)
      {
        const base::EntryPath section = specimen.at("Joints").at(each.name);
        try
          {
            dem::SmoothJointLaw::check(each.law);
          }
        catch (const base::InputError &refusal)
          {
            section.refuse_within(refusal.what());
          }
        if (each.shape != JointSet::Shape::corners)
          continue;
        try
          {
            between_corners(each.corners, dimension);
          }
        catch (const base::InputError &refusal)
          {
            section.refuse("Corners", refusal.what());
          }
      }
  }

  std::vector<dem::JointPlane>
  JointSection::planes(const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, const int dimension) const
  {
    std::vector<dem::JointPlane> all;
    std::size_t                  number = 0;
    for (const JointSet &each : sets)
      {
        std::vector<dem::JointPlane> own;
        if (each.shape == JointSet::Shape::random)
          own = dem::random_joints(network_of(each, lower, upper, dimension));
        else if (each.shape == JointSet::Shape::corners)
          own = between_corners(each.corners, dimension);
        else
          own = {placed(each, dimension)};
        for (dem::JointPlane &joint : own)
          joint.set = number;
        all.insert(all.end(), own.begin(), own.end());
        ++number;
      }
    return all;
  }
} // namespace apps

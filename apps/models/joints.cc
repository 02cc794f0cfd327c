#include "apps/models/joints.h"

#include "apps/text/nearest_name.h"
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

    void check_joint_law(const base::EntryPath &section, const dem::SmoothJointParameters &law)
    {
      try
        {
          dem::SmoothJointLaw::check(law);
        }
      catch (const base::InputError &refusal)
        {
          section.refuse_within(refusal.what());
        }
    }

    const JointMaterial *joint_material(const std::list<JointMaterial> &materials, const std::string &name)
    {
      const auto place = std::find_if(materials.begin(), materials.end(),
                                      [&name](const JointMaterial &each) { return each.name == name; });
      return place == materials.end() ? nullptr : &*place;
    }

    std::vector<std::string> joint_material_names(const std::list<JointMaterial> &materials)
    {
      std::vector<std::string> names;
      for (const JointMaterial &each : materials)
        names.push_back(each.name);
      return names;
    }

    void check_joint_corners(const base::EntryPath &section, const JointSet &set, const int dimension)
    {
      if (set.shape != JointSet::Shape::corners)
        return;
      try
        {
          between_corners(set.corners, dimension);
        }
      catch (const base::InputError &refusal)
        {
          section.refuse("Corners", refusal.what());
        }
    }
  } // namespace

  const dem::SmoothJointParameters &JointSection::law_of(const JointSet &set) const
  {
    return set.material.empty() ? set.law : joint_material(materials, set.material)->law;
  }

  void JointSection::check(const base::EntryPath &root, const int dimension) const
  {
    for (const JointSet &each : sets)
      {
        const base::EntryPath section = root.at("Specimen").at("Joints").at(each.name);
        if (each.material.empty())
          check_joint_law(section, each.law);
        else if (joint_material(materials, each.material) == nullptr)
          section.refuse("Material", "is not in section Joint materials. " +
                                       did_you_mean_or_known(each.material, joint_material_names(materials)));
        check_joint_corners(section, each, dimension);
      }
    for (const JointMaterial &each : materials)
      {
        const base::EntryPath section = root.at("Joint materials").at(each.name);
        if (std::none_of(sets.begin(), sets.end(), [&each](const JointSet &set) { return set.material == each.name; }))
          section.refuse("no joint is of this material. Take it out, or name it in Specimen/Joints.");
        check_joint_law(section, each.law);
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

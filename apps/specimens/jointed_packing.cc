#include "apps/specimens/jointed_packing.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <limits>

namespace apps
{
  namespace
  {
    std::string class_of(const JointSet &set) { return "joint " + set.name; }

    /** Of materials that have no names. */
    std::vector<std::string> named(std::vector<std::string> classes)
    {
      return classes.empty() ? std::vector<std::string>{"material"} : classes;
    }
  } // namespace

  JointedPacking::JointedPacking(const JointSection    &asked,
                                 const SpecimenSection &specimen,
                                 const dem::Packing    &uncut,
                                 const int              in_dimensions,
                                 const std::size_t      loose)
    : joints(asked)
    , whole(uncut)
    , dimension(in_dimensions)
    , thickness(specimen.thickness)
  {
    if (!joints.given())
      return;
    const std::size_t count = uncut.size() - std::min(loose, uncut.size());
    Eigen::Vector3d   lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (std::size_t i = 0; i < count; ++i)
      {
        lower = lower.cwiseMin(uncut.centre[i] - Eigen::Vector3d::Constant(uncut.radius[i]));
        upper = upper.cwiseMax(uncut.centre[i] + Eigen::Vector3d::Constant(uncut.radius[i]));
      }
    const dem::JointedSpecimen linked{dimension, thickness, specimen.interaction_ratio, specimen.installation_gap,
                                      count};
    dem::JointCuts             found = dem::find_cuts(uncut, linked, joints.planes(lower, upper, dimension));
    cut                              = uncut;
    cut.cuts                         = std::move(found.cuts);
    figures                          = std::move(found.of_joint);
    std::vector<std::size_t> links(joints.sets.size(), 0);
    for (const dem::CutFigures &joint : figures)
      links[joint.set] += joint.links;
    for (std::size_t set = 0; set < links.size(); ++set)
      if (links[set] == 0)
        throw base::InputError(
          fmt::format("Specimen/Joints/{}: cuts no link: the particles are between ({:g}, {:g}, {:g}) and ({:g}, {:g}, "
                      "{:g}) m. Check its place and size, and units (metres).",
                      joints.set(set).name, lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z()));
  }

  dem::LinkMaterials JointedPacking::materials(const dem::LinkMaterials &of_particles) const
  {
    std::vector<dem::SmoothJointParameters> of_joints;
    for (const dem::CutFigures &joint : figures)
      {
        of_joints.push_back(joints.law_of(joints.set(joint.set)));
        of_joints.back().plane = joint.normal;
      }
    return of_particles.with_joints(of_joints);
  }

  std::vector<std::string> JointedPacking::link_classes(const std::vector<std::string> &of_materials) const
  {
    if (!joints.given())
      return of_materials;
    std::vector<std::string> classes = named(of_materials);
    for (const dem::CutFigures &joint : figures)
      classes.push_back(class_of(joints.set(joint.set)));
    return classes;
  }

  std::string JointedPacking::text() const
  {
    std::string text;
    for (std::size_t set = 0; set < joints.sets.size(); ++set)
      {
        std::size_t count = 0, links = 0;
        double      area = 0;
        for (const dem::CutFigures &joint : figures)
          if (joint.set == set)
            {
              count += 1;
              links += joint.links;
              area += joint.area;
            }
        text += fmt::format("  {:<12} {}cuts {} links, which share {:.4g} m^2\n", class_of(joints.set(set)),
                            count == 1 ? "" : fmt::format("{} joints, ", count), links, area);
      }
    return text;
  }

  std::vector<std::string> classes_with_joints(const JointSection &joints, std::vector<std::string> of_materials)
  {
    if (!joints.given())
      return of_materials;
    std::vector<std::string> classes = named(std::move(of_materials));
    for (const JointSet &set : joints.sets)
      classes.push_back(class_of(set));
    return classes;
  }
} // namespace apps

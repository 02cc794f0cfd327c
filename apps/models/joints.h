#pragma once

#include "apps/text/corner_list.h"
#include "base/entry_path.h"
#include "dem/joints/joint_plane.h"
#include "dem/laws/smooth_joint.h"

#include <array>
#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Joints": joints of the same constants. */
  struct JointSet
  {
    enum class Shape
    {
      plane,   ///< all of it
      disc,    ///< in two dimensions a piece of a line
      corners, ///< a polygon, in two dimensions segments one after the other
      random   ///< a network
    };

    std::string           name;
    std::string           material; ///< name of a JointMaterial; empty: `law` is its own
    Shape                 shape  = Shape::plane;
    std::array<double, 3> place  = {0, 0, 0};         ///< on the joint, of a disc its centre [m]
    double                radius = 0;                 ///< of discs, or half the length of pieces of a line [m]
    double                dip = 0, dip_direction = 0; ///< [degrees]; of a network the mean
    CornerList            corners;
    double                intensity     = 0; ///< P32, in two dimensions P21 [1/m]
    double                concentration = 0; ///< Fisher's kappa [-]
    std::int64_t          seed          = 1;

    dem::SmoothJointParameters law;
  };

  /** Sub-section of "Joint materials": constants that sets of joints share. */
  struct JointMaterial
  {
    std::string                name;
    dem::SmoothJointParameters law;
  };

  /**
   * Sub-section "Joints" of "Specimen": planes of weakness that cut through the particles (doc/theory/smooth-joint.md); and section "Joint
   * materials", which they may name.
   */
  struct JointSection
  {
    std::list<JointSet>      sets; ///< in the scene's order; of a link that several cut the first counts
    std::list<JointMaterial> materials;

    bool given() const { return !sets.empty(); }
    /** @throws base::InputError naming the entry */
    void check(const base::EntryPath &root, int dimension) const;
    /** Constants of a set, its own or those of its material. @pre checked */
    const dem::SmoothJointParameters &law_of(const JointSet &set) const;
    /** All joints of all sets. @param lower, upper corners of the particles' bounding box [m], which networks fill */
    std::vector<dem::JointPlane>
                    planes(const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, int dimension) const;
    const JointSet &set(const std::size_t number) const { return *std::next(sets.begin(), static_cast<int>(number)); }
  };
} // namespace apps

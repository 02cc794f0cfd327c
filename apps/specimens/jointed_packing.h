#pragma once

#include "apps/models/joints.h"
#include "apps/models/specimen.h"
#include "dem/joints/joint_cuts.h"
#include "dem/model/materials.h"
#include "dem/model/packing.h"

#include <string>
#include <vector>

namespace apps
{
  /** Particles with the joints of a scene through them: what a specimen is made of. */
  class JointedPacking
  {
  public:
    /**
     * @param loose so many particles at the end fly beside the specimen, and are not cut
     * @throws base::InputError for a set that cuts no link
     */
    JointedPacking(const JointSection    &joints,
                   const SpecimenSection &specimen,
                   const dem::Packing    &uncut,
                   int                    dimension,
                   std::size_t            loose = 0);

    const dem::Packing &packing() const { return joints.given() ? cut : whole; }
    dem::LinkMaterials  materials(const dem::LinkMaterials &of_particles) const;
    /** Class of each pair of materials and of each joint. @param of_materials empty: there is one */
    std::vector<std::string> link_classes(const std::vector<std::string> &of_materials) const;
    std::string              text() const; ///< lines of a forecast: what each set cuts; none without joints

  private:
    const JointSection          &joints;
    const dem::Packing          &whole;
    dem::Packing                 cut;
    std::vector<dem::CutFigures> figures; ///< of each joint
    int                          dimension;
    double                       thickness;
  };

  /** Each class of links once that a specimen with joints has, in the order in which JointedPacking has them. */
  std::vector<std::string> classes_with_joints(const JointSection &joints, std::vector<std::string> of_materials);
} // namespace apps

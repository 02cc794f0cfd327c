#pragma once

#include "fem/points/material_points.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fem
{
  /**
   * Points whose answers are expensive: they are found together before a sweep requests each, so that they can be spread over threads.
   *
   * A failure to find an answer is reported by evaluate(), which throws it. evaluate() of a strain that was not gathered finds it then.
   */
  class GatheredPoints : public MaterialPoints
  {
  public:
    /// A point's number in the whole mesh, the same for any number of ranks, and its undeformed place [m].
    struct Site
    {
      std::uint64_t   number = 0;
      Eigen::Vector3d place  = Eigen::Vector3d::Zero();
      ElementExtent   element;
    };

    /// What kind of model they are in.
    struct Setting
    {
      bool        plane         = false; ///< nothing varies along z
      bool        large_strains = false; ///< strains are Green's, stresses are to be second Piola-Kirchhoff's
      std::string group;                 ///< of elements: whose points they are
    };

    /// Where its points are, in their order; after allocate().
    virtual void place(std::vector<Site> sites, const Setting &setting) = 0;

    /// The strains that are gathered next are those at the end of a step in time of this length [s].
    virtual void begin_motion(double /*length*/) {}

    /// Finds the answers to one strain per point; all ranks call it for the same group. Throws nothing that depends on a strain.
    virtual void gather(const std::vector<base::Voigt> &strains, bool with_tangent) = 0;

    /// What a user should know of the committed state and how it came about, one sentence each.
    virtual std::vector<std::string> notes() const { return {}; }

    /// Why no state after the committed one is worth anything; "": none. A run ends there.
    virtual std::string end_of_validity() const { return ""; }
  };
}

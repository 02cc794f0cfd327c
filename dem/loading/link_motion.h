#pragma once

#include "dem/loading/link_path.h"

#include <array>
#include <string>
#include <vector>

namespace dem
{
  /** Two particles of the sizes given, and the link between them. */
  struct LinkPair
  {
    int    dimension = 3;                    ///< 3: spheres; 2: discs
    double thickness = 1;                    ///< of discs [m]
    double radius_1 = 1e-3, radius_2 = 1e-3; ///< [m]
    double gap = 0;                          ///< between the surfaces when the link is made [m]
  };

  /**
   * Motion of the second particle against the first at the contact point, row by row, each component either as a length (angle) or as
   * the force (moment) that is to be held. Components: along the link; across it, two; bending, two; twist.
   *
   * In space the link lies along x, across it are y and z. In the plane it lies along x, across it is y, and bending is about z.
   */
  struct LinkMotionPath
  {
    static constexpr int components = 6;
    struct Component
    {
      std::vector<double> values; ///< [m], [rad], or [N], [N m]; empty: not in the path, the motion is zero
      bool                force = false;
    };
    std::array<Component, components> component;
    std::size_t                       rows       = 0;
    double                            per_second = 0; ///< as in drive() of a LinkPath
  };

  /** Names of a component's motion and of its force in files: "normal_displacement" [m], "normal_force" [N], .. */
  struct LinkMotionName
  {
    const char *motion, *unit, *force, *force_unit;
  };
  extern const std::array<LinkMotionName, LinkMotionPath::components> link_motion_names;

  /** Whether a link of this dimension has the component. */
  bool has_component(int dimension, int component);

  /**
   * Drive one link of the law. Forces are those on the second particle but for the normal one, which is positive in tension: a
   * displacement finds a force of the other sign. A link that is gone is followed by the contact that the law leaves, should the
   * particles touch again.
   *
   * The path is followed as far as some motion holds the prescribed forces; LinkHistory::broke_off names the row where none does.
   * @throws base::InputError for a component that the law does not know
   */
  LinkHistory
  drive(const LinkLawKind &law, const LinkConstants &constants, const LinkPair &pair, const LinkMotionPath &path);
} // namespace dem

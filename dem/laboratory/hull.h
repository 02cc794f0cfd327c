#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Outermost particles of a body and their connectivity: the facets between the centres of those that a ball touches at once which
   * rolls all around the body. In the plane a chain of segments, in space triangles.
   */
  struct Hull
  {
    int corners = 2; ///< of a facet: 2 in the plane, 3 in space
    /** Numbers of particles; the body lies to the left of a segment; a triangle's corners run counter-clockwise seen from outside. */
    std::vector<std::array<std::int32_t, 3>> facet;

    /** Area vector of a facet, out of the body [m^2]; of a segment its length is that of the segment [m]. */
    Eigen::Vector3d area_vector(std::size_t facet, const std::vector<Eigen::Vector3d> &centre) const;
  };

  /**
   * Roll a ball around the body that reaches farthest along x. Closed: every end of a facet is that of another one, so that a uniform
   * pressure on it has neither resultant nor moment. What the ball cannot reach from outside, and pieces farther from the body than its
   * diameter, have no part in it. (Ball pivoting: Bernardini et al., IEEE Trans. Vis. Comput. Graph. 5 (1999) 349, of spheres of their
   * own sizes in place of points.)
   *
   * @param centre, radius of the particles [m] @param dimension 2 (then z is ignored) or 3
   * @param ball radius of the ball [m], > 0: smaller than the pores it may not enter are wide, it finds them
   * @return no facet where the ball finds no way around: a single particle, or in space a flat body
   */
  Hull
  find_hull(const std::vector<Eigen::Vector3d> &centre, const std::vector<double> &radius, int dimension, double ball);
} // namespace dem

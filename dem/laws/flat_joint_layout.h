#pragma once

#include <vector>

namespace dem
{
  /**
   * How the flat surface of a joint is cut into elements; lengths over its radius R, areas over its section A; doc/theory/flat-joint.md, 2.
   *
   * Its axes lie across the link: axis 1, and axis 2 = n x axis 1. A segment of the plane lies along axis 1.
   */
  struct FlatJointLayout
  {
    struct Element
    {
      double x1, x2; ///< centroid
      double share;  ///< of the area
      double own;    ///< second moment about its own centroid, over its area times R^2
    };
    std::vector<Element> elements;
    double half_width = 0; ///< of an element of a segment; 0: a disk, whose elements are closed or open as a whole
    double reach      = 0; ///< how far the farthest centroid lies from the middle

    int size() const { return static_cast<int>(elements.size()); }
    /** I / (A R^2), the elements' own part included. */
    double second_moment() const;
    /** J / (A R^2) of the centroids. */
    double polar_moment() const;
  };

  /** Equal pieces of a segment [-R, R]: exact, whatever their number. */
  FlatJointLayout segment_layout(int elements);

  /**
   * Rings of equal width, each of equal sectors, by their centroids.
   * @param own_moments whether elements have a second moment of their own, half their polar one; then I is exact. Otherwise it is
   *                    below (0.88 of it with 2 x 6).
   */
  FlatJointLayout disk_layout(int rings, int sectors, bool own_moments);
} // namespace dem

#pragma once

#include "postprocess/pictures/gnuplot.h"

#include <Eigen/Geometry>

#include <string>

namespace postprocess
{
  /** A unit in which lengths of a picture are drawn. */
  struct LengthUnit
  {
    double      per_metre;
    const char *name;
  };

  /** The unit that keeps the numbers at an axis short, for a body of that extent [m]. */
  LengthUnit length_unit(double extent);

  /** Three digits and the unit that suits them: "23 µm". */
  std::string length_text(double metres);

  /** Distance of ticks, 1, 2 or 5 times a power of ten: labels of the range then have the requested room. @param most at most so many ticks */
  double tick_step(double range, double most);

  /** A round number to magnify displacements by, not above the wished one; at least 1. */
  double round_magnification(double wished);

  /** Distance of ticks along a horizontal axis whose labels must fit side by side. */
  double horizontal_tick_step(double low, double high, double pixels);

  /** What a picture in true proportion shows, and how large. */
  struct PictureFrame
  {
    Eigen::AlignedBox2d box;                ///< [m]
    char                right, up;          ///< names of the axes
    int                 longer_side;        ///< of the box [pixel]
    int                 around_x, around_y; ///< room for labels and legend [pixel]
    int                 least;              ///< side of the picture [pixel]
  };

  /**
   * Set size, ranges, ticks and axis labels of a picture in true proportion; its data are to be in the unit returned.
   * @throws std::invalid_argument for a box that is empty or not finite
   */
  LengthUnit set_axes(GnuplotJob &job, const PictureFrame &frame);

  /** A legend below the picture, clear of the label of the axis above it: the line of a script. */
  std::string legend_below();

  /** Place of the colour bar, for a script after set_axes(): beside a flat body it is higher than the body, so that its ticks have room. */
  std::string colour_bar(const GnuplotJob &job, const PictureFrame &frame);
} // namespace postprocess

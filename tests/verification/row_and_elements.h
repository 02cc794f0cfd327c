#pragma once

namespace row_and_elements
{
  enum class Ties
  {
    strict,
    coarse,
    lumped
  };

  /** A packet of waves in a row of particles that shares `overlap` elements with a row of linear elements; spacing, mass and stiffness 1. */
  struct Row
  {
    Ties   ties;
    double wavelength;
    int    element = 8, overlap = 4; ///< spacings of an element, elements of the overlap
    double step = 0.25;
  };

  struct Answer
  {
    double reflected, transmitted; ///< of the packet's energy
  };

  /**
   * Weighted overlap with multipliers in one dimension, written from the formulas alone and sharing nothing with the program: weights that are
   * linear over the overlap, mass of a particle times the mean weight of its two bonds, velocities tied after each step (Xiao and Belytschko
   * 2004; Rateau 2003 for the coarse ones). It ends when the packet has gone 7.5 of its widths past the overlap.
   */
  Answer transmit(const Row &row);
} // namespace row_and_elements

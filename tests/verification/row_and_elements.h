#pragma once

namespace row_and_elements
{
  enum class Ties
  {
    strict,
    coarse,
    lumped
  };

  /** What damps waves that are too short for the elements: m dv/dt = -F^T C m F v, F = (1 - G)^p, G the average over a grid of splines. */
  struct Absorber
  {
    int    sharpness = 3;  ///< p; 0: there is none
    double spacing   = 7;  ///< of the grid
    double layer     = 32; ///< before the overlap, through which the rate grows as a square
    double rate      = 1;
    /** Mass of the last particle; 0: by its bonds. Averages end with it. */
    double last_mass = 0;
  };

  /** A packet of waves in a row of particles that shares `overlap` elements with a row of linear elements; spacing, mass and stiffness 1. */
  struct Row
  {
    Ties     ties;
    double   wavelength;
    int      element = 8, overlap = 4; ///< spacings of an element, elements of the overlap
    double   step       = 0.25;
    Absorber absorber   = {0, 0, 0, 0, 0};
    bool     sides_half = false; ///< coarse multipliers count the first and the last particle of the overlap half
  };

  struct Answer
  {
    double reflected, transmitted; ///< of the packet's energy
  };

  /**
   * Weighted overlap with multipliers in one dimension, written from the formulas alone and sharing nothing with the program: weights that are
   * linear over the overlap, mass of a particle times the mean weight of its two bonds, of a node times the weight of the halves of elements next to
   * it, velocities tied after each step (Xiao and Belytschko 2004; Rateau 2003 for the coarse ones), damping between two half steps. It ends when the packet has gone 6 of its widths past the overlap.
   */
  Answer transmit(const Row &row);
} // namespace row_and_elements

#pragma once

namespace row_and_elements
{
  enum class Ties
  {
    strict,
    coarse,
    lumped
  };

  /** What an absorber takes for carried by the elements. */
  enum class Smooth
  {
    grid,      ///< an average over a grid of cubic splines
    normal,    ///< an average by the distance of particles, exp(-d^2 / 2 w^2) with w the spacing
    projection ///< the fit by cubic splines to the particles of the layer, least in energy; no average: it mirrors waves of twice its spacing
  };

  /** What damps waves that are too short for the elements: m dv/dt = -F^T C m F v, F = (1 - G)^p, G as Smooth says. */
  struct Absorber
  {
    int    sharpness = 3;  ///< p; 0: there is none
    double spacing   = 7;  ///< of the grid of splines
    double layer     = 32; ///< before the overlap, through which the rate grows as a square
    double rate      = 1;
    /** Mass of the last particle; 0: by its bonds. Averages end with it. */
    double last_mass = 0;
    Smooth smooth    = Smooth::grid;
    double offset    = 0; ///< of the grid, over its spacing
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
    /** Rate, at the far side of the overlap, at which velocities lose what a fit by the overlap's elements leaves; 0: there is no such damping. */
    double residual_rate = 0;
    bool   point_masses  = false; ///< particles have the weight at their place instead of the mean of their bonds
    double followed      = 6;     ///< widths of the packet that it goes past the beginning of the overlap
  };

  struct Answer
  {
    double reflected, transmitted; ///< of the packet's energy
  };

  /**
   * Weighted overlap with multipliers in one dimension, written from the formulas alone and sharing nothing with the program: weights that are
   * linear over the overlap, mass of a particle times the mean weight of its two bonds, of a node times the weight of the halves of elements next to
   * it, velocities tied after each step (Xiao and Belytschko 2004; Rateau 2003 for the coarse ones), damping between two half steps, of the residual just before the tie.
   */
  Answer transmit(const Row &row);
} // namespace row_and_elements

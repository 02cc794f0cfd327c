#pragma once

namespace apps
{
  /** Energies of an analysis of a solid [J]: what came in equals what is there and what is lost, up to balance_error(). */
  struct ContinuumEnergy
  {
    double external = 0; ///< work of loads and prescribed displacements
    double internal = 0; ///< work of stresses, by trapezes over the steps
    double kinetic = 0, damped = 0, start = 0;
    double contacts = 0; ///< held and turned into heat by contacts between bodies
    double stored   = 0; ///< by the materials, more than at the start

    /** Lost in the materials, by their own account; where they keep none, what the stresses have worked and nothing stores. */
    double dissipated = 0;

    bool materials_keep_account = false;

    /** What is missing or too much (doc/theory/static-solver.md, 5) [J]. */
    double residual() const { return external + start - kinetic - damped - stored - dissipated - contacts; }

    /** The largest of all. */
    double largest() const;

    /** The residual's magnitude over the largest; 0 for nothing. */
    double balance_error() const;
  };
} // namespace apps

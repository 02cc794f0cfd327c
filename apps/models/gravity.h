#pragma once

#include "base/entry_path.h"

#include <Eigen/Core>

#include <array>

namespace apps
{
  /** Section "Gravity": the weight of the particles, and whether they carry it from the start. */
  struct GravitySection
  {
    enum class Start
    {
      none,
      statics
    };

    std::array<double, 3> acceleration = {0, 0, 0}; ///< [m/s^2]
    Start                 start        = Start::statics;

    /** @param root holds the section, as in declare() */
    void            check(const base::EntryPath &root, int dimension) const;
    Eigen::Vector3d vector() const { return {acceleration[0], acceleration[1], acceleration[2]}; }
    bool            acts() const { return !vector().isZero(0); }
    /** There is an equilibrium to find. */
    bool asks_for_equilibrium() const { return start == Start::statics && acts(); }
  };
} // namespace apps

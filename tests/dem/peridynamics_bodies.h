#pragma once

#include "dem/peridynamics/equilibrium.h"
#include "dem/peridynamics/transfer.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/** Bodies of the published cases, loaded as these say. */
namespace peridynamic_tests
{
  using namespace dem::peridynamics;

  constexpr double E = 200e9, q = 200e6;

  /** Traction [Pa] on a boundary. */
  struct Pull
  {
    std::string                                             boundary;
    std::function<Eigen::Vector3d(const Eigen::Vector3d &)> traction;
    TractionWeight                                          weight = TractionWeight::paper;
    TractionForm                                            form   = TractionForm::transfer;
  };

  inline Pull uniform(const std::string &boundary, const Eigen::Vector3d &p)
  {
    return {boundary, [p](const Eigen::Vector3d &) { return p; }};
  }

  /** Of what the bodies in motion are [kg/m^3]. */
  constexpr double density = 8000;

  struct Case
  {
    Body              body;
    Horizon           horizon;
    Material          material;
    std::vector<Pull> pulls;

    Grid  grid() const { return Grid(body, reach_of(horizon)); }
    Bonds bonds() const { return Bonds(grid(), horizon, material); }
    /** Held nowhere. */
    Loads loads(const Bonds &bonds) const;
  };

  /** A plate of 1 m x 0.5 m, or a rod of 1 m. @param cells along it */
  Case plate(int cells, Layout layout, Calibration calibration = Calibration::none);
  Case rod(int cells, double ratio, BondModel model, Layout layout, Volumes volumes);
  /** Pulled along y. */
  Case pulled_plate(int cells, Layout layout, Calibration calibration = Calibration::none);
  /** A square plate of 0.5 m with a hole of 0.05 m, pulled along y. */
  Case plate_with_hole(Layout layout, Calibration calibration = Calibration::none);

  /** A rod of 1 m whose left end is pushed once, with q at most: it begins at the time 0 and lasts so long [s]. */
  struct PushedRod
  {
    static constexpr double duration = 4e-5;
    Case                    c        = rod(800, 3, BondModel::prototype, Layout::cell_centred, Volumes::partial);

    double speed() const; ///< of long waves where Young's modulus is E [m/s]
    /** Of bonds of this rod, which must outlive them. */
    Loads loads(const Bonds &bonds) const;
  };

  /** Displacement in equilibrium, without rigid motion. */
  Field displacement(const Case  &what,
                     const Bonds &bonds,
                     Solver       solver     = Solver::direct,
                     Kinematics   kinematics = Kinematics::linear);
} // namespace peridynamic_tests

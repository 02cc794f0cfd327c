#include "apps/bench/peridynamic_plate.h"

#include "apps/forecasts/duration.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    constexpr double young = 200e9, pulls = 200e6; // Yu, Zhou, Huang (2023)

    using TractionAt = std::function<Eigen::Vector3d(const pd::BoundaryPoint &)>;

    pd::Bonds bonds_of(const PeridynamicPlate &plate)
    {
      pd::Body body;
      body.size    = {1.0, 0.5, 0.0};
      body.spacing = body.thickness = 1.0 / plate.cells;
      body.layout                   = plate.layout;
      const pd::Horizon horizon{plate.ratio, plate.volumes, plate.corrected};
      pd::Material      material;
      material.young_modulus = young;
      material.calibration   = plate.calibration;
      return {pd::Grid(body, pd::reach_of(horizon)), horizon, material};
    }

    /** A traction on all four sides, by place and normal. */
    pd::Loads loads_of(const PeridynamicPlate &plate, const pd::Bonds &bonds, const TractionAt &traction)
    {
      std::vector<std::pair<std::shared_ptr<pd::Transfer>, std::vector<Eigen::Vector3d>>> all;
      for (const std::string &side : pd::side_names(2))
        {
          auto transfer =
            std::make_shared<pd::Transfer>(bonds.grid(), bonds.horizon(), bonds.model(),
                                           pd::boundary_points(bonds.grid(), side), plate.weight, plate.form);
          std::vector<Eigen::Vector3d> values;
          for (const pd::BoundaryPoint &p : transfer->points())
            values.push_back(traction(p));
          all.emplace_back(transfer, values);
        }
      pd::Loads made;
      made.held.assign(bonds.grid().places(), 0);
      made.displacements = [](double, pd::Field &) {};
      made.forces        = [all](double, const pd::Field *const u, pd::Field &forces) {
        for (const auto &[transfer, values] : all)
          transfer->add(values, u, forces);
      };
      return made;
    }

    TractionAt of_stress(const Eigen::Matrix3d &stress)
    {
      return [stress](const pd::BoundaryPoint &p) -> Eigen::Vector3d { return stress * p.normal; };
    }

    Eigen::Matrix3d stress_of(const int i, const int j)
    {
      Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
      stress(i, j) = stress(j, i) = pulls;
      return stress;
    }

    pd::Field at_rest(const PeridynamicPlate &plate, const pd::Bonds &bonds, const Eigen::Matrix3d &stress)
    {
      // Conjugate gradients need as many steps as horizons fit across, each a pass over the bonds; a factor fills up as the horizon grows.
      pd::Equilibrium equilibrium(bonds, pd::Kinematics::linear, pd::Solver::iterative);
      pd::Field       u     = bonds.grid().field();
      const auto      state = equilibrium.find(bonds, loads_of(plate, bonds, of_stress(stress)), 1.0, 1e-10, u);
      if (state.loose) // a layer of body force has other arms than the tractions: their moments do not balance
        for (const std::size_t i : bonds.grid().nodes())
          u.add(i, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
      pd::remove_rigid_motion(bonds.grid(), u);
      return u;
    }

    /** Largest errors of two components on the nodes next to the axes, over the largest exact values. */
    struct LineErrors
    {
      Eigen::Vector2d on_y0 = Eigen::Vector2d::Zero(), on_x0 = Eigen::Vector2d::Zero(); ///< of u_x and u_y
    };

    LineErrors errors_on_lines(const pd::Grid                                                &grid,
                               const pd::Field                                               &u,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &exact)
    {
      pd::Field wanted = grid.field();
      for (const std::size_t i : grid.nodes())
        wanted.add(i, exact(grid.position(i)));
      pd::remove_rigid_motion(
        grid, wanted); // as of the solution: shear of a plate that is no square has a mean rotation by mass
      Eigen::Vector2d largest = Eigen::Vector2d::Zero();
      LineErrors      errors;
      for (const std::size_t i : grid.nodes())
        {
          const Eigen::Vector3d x   = grid.position(i);
          const Eigen::Vector2d off = (u.at(i) - wanted.at(i)).cwiseAbs().head<2>();
          largest                   = largest.cwiseMax(wanted.at(i).cwiseAbs().head<2>());
          if (std::abs(x.y()) < 0.6 * grid.spacing())
            errors.on_y0 = errors.on_y0.cwiseMax(off);
          if (std::abs(x.x()) < 0.6 * grid.spacing())
            errors.on_x0 = errors.on_x0.cwiseMax(off);
        }
      const double exists = u.at(grid.nodes().front()).sum() * 0; // 0, or not a number
      errors.on_y0        = errors.on_y0.cwiseQuotient(largest).array() + exists;
      errors.on_x0        = errors.on_x0.cwiseQuotient(largest).array() + exists;
      return errors;
    }
  } // namespace

  PeridynamicErrors errors_of(const PeridynamicPlate &plate)
  {
    const pd::Bonds   bonds = bonds_of(plate);
    PeridynamicErrors found;
    found.bonds = bonds.count();
    const base::Stopwatch watch;
    const pd::Field pulled = at_rest(plate, bonds, stress_of(1, 1)), sheared = at_rest(plate, bonds, stress_of(0, 1));
    found.seconds       = watch.seconds();
    const double     nu = pd::poisson_ratio(pd::Space::plane_stress), unit = pulls / young;
    const LineErrors tension = errors_on_lines(bonds.grid(), pulled, [&](const Eigen::Vector3d &x) -> Eigen::Vector3d {
      return unit * Eigen::Vector3d(-nu * x.x(), x.y(), 0);
    });
    const LineErrors shear   = errors_on_lines(bonds.grid(), sheared, [&](const Eigen::Vector3d &x) -> Eigen::Vector3d {
      return unit * (1 + nu) * Eigen::Vector3d(x.y(), x.x(), 0);
    });
    found.tension_across     = tension.on_y0.x();
    found.tension_along      = tension.on_x0.y();
    found.shear              = std::max(shear.on_x0.x(), shear.on_y0.y());
    return found;
  }

  PeridynamicSteps steps_of(const std::string &name, const bool gershgorin, const int cells)
  {
    PeridynamicPlate plate;
    plate.cells              = cells;
    const pd::Bonds bonds    = bonds_of(plate);
    const auto      traction = [&name](const pd::BoundaryPoint &p) -> Eigen::Vector3d {
      const double sxx = name == "bending (a)" ? pulls / 0.25 * p.place.y() : 0;
      const double syy = name == "bending (b)" ? pulls / 0.5 * p.place.x() : name == "tension" ? pulls : 0;
      return {sxx * p.normal.x(), syy * p.normal.y(), 0};
    };
    const pd::Loads loads = loads_of(plate, bonds, traction);
    pd::Relaxation  relaxation(bonds, pd::Kinematics::linear,
                              gershgorin ? pd::FictitiousDensity::gershgorin : pd::FictitiousDensity::constant);
    relaxation.load(loads, 1.0);
    PeridynamicSteps found{name, gershgorin, 0, 0};
    while (relaxation.steps() < 20000 && (relaxation.steps() == 0 || relaxation.residual() > 1e-6))
      {
        relaxation.step(bonds, loads);
        if (found.coarse == 0 && relaxation.residual() < 1e-3)
          found.coarse = relaxation.steps();
      }
    found.fine = relaxation.steps();
    return found;
  }

  PeridynamicRate rate_of(const int dimension, const int nodes)
  {
    pd::Body body;
    body.space   = dimension == 3 ? pd::Space::space : pd::Space::plane_stress;
    body.size    = {1.0, 1.0, dimension == 3 ? 1.0 : 0.0};
    body.spacing = body.thickness = 1.0 / nodes;
    const pd::Horizon horizon;
    pd::Material      material;
    material.young_modulus    = young;
    material.critical_stretch = 0.1;
    pd::Bonds bonds(pd::Grid(body, pd::reach_of(horizon)), horizon, material);
    pd::Field u = bonds.grid().field(), f = u;
    for (const std::size_t i : bonds.grid().nodes())
      u.add(i, 1e-3 * bonds.grid().position(i));
    pd::BondForces forces(bonds, pd::Kinematics::nonlinear);
    const double   seconds = seconds_per_unit([&](const std::int64_t passes) {
      for (std::int64_t n = 0; n < passes; ++n)
        forces.add_up_and_break(bonds, u, nullptr, f);
      return passes;
    });
    return {dimension, bonds.count(), static_cast<double>(bonds.count()) / seconds};
  }
} // namespace apps

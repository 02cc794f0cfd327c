#include "peridynamics_bodies.h"

#include <algorithm>
#include <cmath>

namespace peridynamic_tests
{
  Loads Case::loads(const Bonds &bonds) const
  {
    std::vector<std::pair<std::shared_ptr<Transfer>, std::vector<Eigen::Vector3d>>> all;
    for (const Pull &pull : pulls)
      {
        auto transfer =
          std::make_shared<Transfer>(bonds.grid(), bonds.horizon(), material.model,
                                     boundary_points(bonds.grid(), pull.boundary), pull.weight, pull.form);
        std::vector<Eigen::Vector3d> tractions;
        for (const BoundaryPoint &p : transfer->points())
          tractions.push_back(pull.traction(p.place));
        all.emplace_back(transfer, tractions);
      }
    Loads made;
    made.held.assign(bonds.grid().places(), 0);
    made.displacements = [](double, Field &) {};
    made.forces        = [all](const double factor, const Field *const u, Field &forces) {
      for (const auto &[transfer, tractions] : all)
        {
          std::vector<Eigen::Vector3d> now = tractions;
          for (Eigen::Vector3d &p : now)
            p *= factor;
          transfer->add(now, u, forces);
        }
    };
    return made;
  }

  Case plate(const int cells, const Layout layout, const Calibration calibration)
  {
    Case c;
    c.body.size              = {1.0, 0.5, 0.0};
    c.body.spacing           = 1.0 / cells;
    c.body.thickness         = c.body.spacing;
    c.body.layout            = layout;
    c.material.young_modulus = E;
    c.material.calibration   = calibration;
    return c;
  }

  Case rod(const int cells, const double ratio, const BondModel model, const Layout layout, const Volumes volumes)
  {
    Case c            = plate(cells, layout);
    c.body.space      = Space::rod;
    c.body.size       = {1.0, 0.0, 0.0};
    c.horizon.ratio   = ratio;
    c.horizon.volumes = volumes;
    c.material.model  = model;
    c.pulls           = {uniform("left", {-q, 0, 0}), uniform("right", {q, 0, 0})};
    return c;
  }

  Case pulled_plate(const int cells, const Layout layout, const Calibration calibration)
  {
    Case c  = plate(cells, layout, calibration);
    c.pulls = {uniform("bottom", {0, -q, 0}), uniform("top", {0, q, 0})};
    return c;
  }

  Case plate_with_hole(const Layout layout, const Calibration calibration)
  {
    Case c           = pulled_plate(200, layout, calibration);
    c.body.size      = {0.5, 0.5, 0.0};
    c.body.thickness = c.body.spacing;
    c.body.holes     = {{"hole", Eigen::Vector3d::Zero(), 0.05}};
    return c;
  }

  double PushedRod::speed() const { return std::sqrt(E / density); }

  Loads PushedRod::loads(const Bonds &bonds) const
  {
    Loads      made  = c.loads(bonds);
    const auto whole = made.forces;
    const auto half  = static_cast<std::ptrdiff_t>(bonds.grid().nodes()[bonds.grid().nodes().size() / 2]);
    made.forces      = [whole, half](const double t, const Field *const u, Field &f) {
      whole(t < duration ? std::pow(std::sin(std::acos(-1.0) * t / duration), 2) : 0.0, u, f);
      std::fill(f.c[0].begin() + half, f.c[0].end(), 0.0); // of the right end
    };
    return made;
  }

  Field displacement(const Case &what, const Bonds &bonds, const Solver solver, const Kinematics kinematics)
  {
    Equilibrium equilibrium(bonds, kinematics, solver);
    Field       u = bonds.grid().field();
    equilibrium.find(bonds, what.loads(bonds), 1.0, kinematics == Kinematics::linear ? 1e-11 : 1e-9, u);
    remove_rigid_motion(bonds.grid(), u);
    return u;
  }
} // namespace peridynamic_tests

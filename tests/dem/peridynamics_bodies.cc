#include "peridynamics_bodies.h"

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

  Field displacement(const Case &what, const Bonds &bonds, const Solver solver, const Kinematics kinematics)
  {
    Equilibrium equilibrium(bonds, kinematics, solver);
    Field       u = bonds.grid().field();
    equilibrium.find(bonds, what.loads(bonds), 1.0, kinematics == Kinematics::linear ? 1e-11 : 1e-9, u);
    remove_rigid_motion(bonds.grid(), u);
    return u;
  }
} // namespace peridynamic_tests

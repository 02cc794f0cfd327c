#pragma once

#include "dem/core/uniform_random.h"
#include "dem/laws/cpm.h"
#include "dem/loading/periodic_cell.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Dense>

#include <cmath>
#include <string>
#include <vector>

/** Packings with known stiffness, and how their cells are loaded, for the tests of periodic cells. */
namespace periodic_fixture
{
  /** doc/theory/homogenisation.md, 5: eight spheres in the unit cube; interaction ratio 1.5 reaches beyond half the cell. */
  inline dem::Packing eight_spheres()
  {
    dem::Packing p;
    p.centre        = {{0.625, 0.897, 0.776}, {0.225, 0.300, 0.874}, {0.468, 0.303, 0.278}, {0.036, 0.515, 0.466},
                       {0.508, 0.871, 0.361}, {0.123, 0.967, 0.658}, {0.815, 0.730, 0.113}, {0.921, 0.123, 0.092}};
    p.radius        = std::vector<double>(8, 0.22);
    p.periodic_cell = Eigen::Vector3d(1, 1, 1);
    return p;
  }

  /** Its relaxed stiffness for E = 1, G/E = 0.2 as printed there. */
  inline base::Matrix6 eight_spheres_stiffness()
  {
    base::Matrix6 d;
    d << 0.6516972, 0.1656204, 0.1871454, -0.004127942, -0.07683566, -0.01991760, //
      0.1656204, 0.5962287, 0.1309957, 0.02745349, -0.01489825, -0.009256186,     //
      0.1871454, 0.1309957, 0.6422239, 0.01182032, -0.04931502, -0.002428461,     //
      -0.004127942, 0.02745349, 0.01182032, 0.1878680, -0.01971590, -0.03942749,  //
      -0.07683566, -0.01489825, -0.04931502, -0.01971590, 0.2281245, 0.01970901,  //
      -0.01991760, -0.009256186, -0.002428461, -0.03942749, 0.01970901, 0.2291952;
    return d;
  }

  /** doc/theory/homogenisation.md, 5: six discs in the unit square. */
  inline dem::Packing six_discs()
  {
    dem::Packing p;
    p.centre = {{0.10, 0.20, 0}, {0.55, 0.15, 0}, {0.30, 0.55, 0}, {0.80, 0.60, 0}, {0.05, 0.85, 0}, {0.60, 0.90, 0}};
    p.radius = std::vector<double>(6, 0.22);
    p.periodic_cell = Eigen::Vector3d(1, 1, 1);
    return p;
  }

  /** Touching spheres of radius 1, one cubic unit cell of a lattice given by its points in units of the edge. */
  inline dem::Packing lattice(const std::vector<Eigen::Vector3d> &points, const double edge)
  {
    dem::Packing p;
    for (const auto &x : points)
      p.centre.push_back(edge * x);
    p.radius        = std::vector<double>(points.size(), 1.0);
    p.periodic_cell = Eigen::Vector3d(edge, edge, edge);
    return p;
  }

  /** n x n x n spheres of radius 1 mm on a cubic lattice of 1.9 mm, each moved up to 15 % of the spacing. */
  inline dem::Packing disordered(const int n, const std::uint64_t seed)
  {
    dem::UniformRandom random(seed);
    dem::Packing       p;
    const double       spacing = 1.9e-3;
    for (int i = 0; i < n * n * n; ++i)
      {
        Eigen::Vector3d x(i % n, i / n % n, i / (n * n));
        for (int d = 0; d < 3; ++d)
          x[d] += 0.3 * (random() - 0.5);
        p.centre.push_back(spacing * x);
        p.radius.push_back(1e-3);
      }
    p.periodic_cell = Eigen::Vector3d::Constant(n * spacing);
    return p;
  }

  /** The packing repeated along the first axis. */
  inline dem::Packing twice(dem::Packing p)
  {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        p.centre.push_back(p.centre[i] + p.periodic_cell->x() * Eigen::Vector3d::UnitX());
        p.radius.push_back(p.radius[i]);
      }
    p.periodic_cell->x() *= 2;
    return p;
  }

  inline dem::SpecimenParameters elastic(const double interaction_ratio, const int dimension = 3)
  {
    dem::SpecimenParameters s;
    s.physics.dimension = dimension;
    s.physics.periodic  = true;
    s.physics.damage = s.physics.friction = s.physics.contacts = false;
    s.density                                                  = 1;
    s.thickness                                                = dimension == 2 ? 1 : 0;
    s.interaction_ratio                                        = interaction_ratio;
    s.damping                                                  = 0.2;
    return s;
  }

  /** E = 1 Pa, G/E as given; limits out of reach. */
  inline dem::CpmParameters unit_links(const double shear_ratio)
  {
    dem::CpmParameters c;
    c.normal_modulus       = 1;
    c.shear_ratio          = shear_ratio;
    c.limit_elastic_strain = 1;
    c.relative_ductility   = 2;
    c.cohesion             = 1e3;
    return c;
  }

  inline dem::SpecimenParameters concrete_specimen()
  {
    dem::SpecimenParameters s;
    s.physics.periodic  = true;
    s.density           = 4800;
    s.interaction_ratio = 1.4;
    s.damping           = 0.2;
    return s;
  }

  /** The concrete of concrete_uniaxial.prm, more brittle so that it breaks soon. */
  inline dem::CpmParameters brittle_concrete()
  {
    dem::CpmParameters c;
    c.normal_modulus       = 25e9;
    c.shear_ratio          = 0.2;
    c.limit_elastic_strain = 1e-4;
    c.relative_ductility   = 5;
    c.cohesion             = 3e6;
    c.friction_coefficient = 0.8;
    return c;
  }

  inline dem::CellLeg strain_leg(const double duration, const base::Vector6 &strain)
  {
    dem::CellLeg leg;
    leg.duration = duration;
    leg.target   = strain;
    return leg;
  }

  /** Hold the cell as it is until the forces balance. @return steps taken, or -1 if they do not within the limit */
  inline std::int64_t relax(dem::Specimen &specimen, const double unbalanced, const std::int64_t limit = 200000)
  {
    specimen.set_velocity_gradient(Eigen::Matrix3d::Zero());
    for (std::int64_t steps = 0; steps < limit; steps += 200)
      {
        specimen.advance(200);
        if (specimen.unbalanced_ratio() < unbalanced)
          return steps + 200;
      }
    return -1;
  }

  inline base::Vector6 stress_of(const dem::Specimen &specimen)
  {
    const Eigen::Matrix3d s = specimen.cell().stress;
    base::Vector6         v;
    v << s(0, 0), s(1, 1), s(2, 2), 0.5 * (s(1, 2) + s(2, 1)), 0.5 * (s(2, 0) + s(0, 2)), 0.5 * (s(0, 1) + s(1, 0));
    return v;
  }

  /**
   * Column of the stiffness: stress of a fresh cell per unit of strain c, odd part of +size and -size, so that finite strain
   * counts only by its square.
   */
  template <typename Make>
  base::Vector6 stiffness_column(Make &&make, const int component, const double size, const double unbalanced)
  {
    base::Vector6 column = base::Vector6::Zero();
    for (const double sign : {1.0, -1.0})
      {
        dem::Specimen           specimen = make();
        dem::CellTestParameters p;
        p.path = {strain_leg(10 * specimen.time_step(), sign * size * base::Vector6::Unit(component))};
        dem::CellTest test(specimen, p);
        test.advance(10);
        if (unbalanced > 0 && relax(specimen, unbalanced) < 0)
          throw std::runtime_error("the cell does not come to rest");
        column += sign / (2 * size) * stress_of(specimen);
      }
    return column;
  }
} // namespace periodic_fixture

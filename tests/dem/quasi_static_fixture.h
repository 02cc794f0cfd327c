#pragma once

#include "dem/grips/grip_layers.h"
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/cpm.h"
#include "dem/packing/lattice.h"
#include "dem/specimen/specimen.h"
#include "dem/statics/quasi_static_path.h"
#include "tests/dem/homogenisation_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

/** Cells and gripped specimens of CPM links, and their quasi-static paths. */
namespace quasi_static_fixture
{
  using namespace homogenisation_fixture;

  inline dem::CpmParameters concrete(const double ductility = 30)
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = 1e-4;
    p.relative_ductility   = ductility;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  inline dem::QuasiStaticParameters steps(const double end_strain, const double sign = 1)
  {
    dem::QuasiStaticParameters p;
    p.sign        = sign;
    p.strain_step = 1e-5;
    p.end_strain  = end_strain;
    return p;
  }

  inline std::vector<dem::QuasiStaticPoint>
  follow(const dem::LoadedNetwork &loaded, const dem::CpmParameters &law, const dem::QuasiStaticParameters &p)
  {
    dem::QuasiStaticPath path(loaded, law, p);
    while (!path.finished())
      path.advance();
    return path.points();
  }

  inline dem::ElasticNetwork network_of(const dem::Packing &packing, const double ratio, const dem::CpmParameters &law)
  {
    return dem::make_network(packing, links(ratio, law.shear_ratio, law.normal_modulus));
  }

  /** Envelope of a link in tension, written out anew: (2.17) of Stransky (2018). */
  inline double envelope(const dem::CpmParameters &p, const double strain)
  {
    const double onset = p.limit_elastic_strain;
    return strain <= onset ? p.normal_modulus * strain :
                             p.normal_modulus * onset * std::exp(-(strain - onset) / (p.relative_ductility * onset));
  }

  inline double peak(const std::vector<dem::QuasiStaticPoint> &path, const int component = 0)
  {
    double largest = 0;
    for (const auto &point : path)
      largest = std::max(largest, std::fabs(point.stress[component]));
    return largest;
  }

  inline dem::Packing millimetres(dem::Packing packing)
  {
    for (auto &c : packing.centre)
      c *= 1e-3;
    for (auto &r : packing.radius)
      r *= 1e-3;
    *packing.periodic_cell *= 1e-3;
    return packing;
  }

  inline dem::LoadedNetwork random_cell(const dem::CpmParameters &law, const bool lateral_free = true)
  {
    return dem::load_cell(network_of(millimetres(random_spheres(64, 3)), 1.6, law), 0, lateral_free);
  }

  inline dem::GripLayers cluster_grips(const dem::Packing &packing, const int axis, const double thickness)
  {
    dem::GripParameters p;
    p.thickness = thickness;
    return dem::find_grip_layers({packing.centre, packing.radius}, axis, p);
  }

  /** A row of touching spheres of 1 mm along x, gripped at its ends. */
  inline dem::LoadedNetwork row(const int spheres, const dem::CpmParameters &law)
  {
    dem::Packing packing;
    for (int i = 0; i < spheres; ++i)
      packing.centre.emplace_back(2e-3 * i, 0, 0);
    packing.radius.assign(spheres, 1e-3);
    dem::GripPair grips;
    grips.axis   = 0;
    grips.layers = cluster_grips(packing, 0, 0.5e-3);
    return dem::load_grips(network_of(packing, 1.05, law), grips);
  }

  /** A box of the random cell cut free, gripped along z. */
  inline dem::LoadedNetwork random_box(const dem::CpmParameters &law, const bool rough = false)
  {
    dem::Packing packing = millimetres(random_spheres(64, 3));
    packing.periodic_cell.reset();
    dem::GripPair grips;
    grips.lateral_blocked = grips.spin_blocked = rough;
    grips.layers                               = cluster_grips(packing, 2, 1.5e-3);
    return dem::load_grips(network_of(packing, 1.6, law), grips);
  }
} // namespace quasi_static_fixture

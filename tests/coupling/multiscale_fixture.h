#pragma once

#include "coupling/multiscale/cell_points.h"
#include "dem/laws/cpm.h"
#include "tests/dem/homogenisation_fixture.h"

#include <memory>

/** Small cells of concrete behind integration points. */
namespace multiscale
{
  inline dem::CpmParameters concrete(const double limit_strain = 1e-4)
  {
    dem::CpmParameters p;
    p.normal_modulus       = 25e9;
    p.shear_ratio          = 0.2;
    p.limit_elastic_strain = limit_strain;
    p.relative_ductility   = 30;
    p.cohesion             = 3e6;
    p.friction_coefficient = 0.8;
    return p;
  }

  inline coupling::CellParameters parameters(const double tolerance = 1e-9)
  {
    coupling::CellParameters p;
    p.links              = homogenisation_fixture::links(1.6, 0.2, 25e9);
    p.response.tolerance = tolerance;
    return p;
  }

  inline std::shared_ptr<const coupling::PreparedCell> prepared(const dem::LinkMaterials       &law   = concrete(),
                                                                const coupling::CellParameters &p     = parameters(),
                                                                const std::uint64_t             seed  = 3,
                                                                const std::size_t               count = 48)
  {
    return std::make_shared<coupling::PreparedCell>(homogenisation_fixture::random_spheres(count, seed), law, p);
  }

  inline std::unique_ptr<coupling::CellPoints> points(std::vector<std::shared_ptr<const coupling::PreparedCell>> cells,
                                                      const coupling::Localised localised = coupling::Localised::go_on,
                                                      const bool                large_strains = false)
  {
    coupling::CellPointsParameters p;
    p.cells         = std::move(cells);
    p.localised     = localised;
    p.large_strains = large_strains;
    return std::make_unique<coupling::CellPoints>(p, fem::Plane::strain);
  }

  inline base::Voigt mixed(const double size)
  {
    return (base::Voigt() << 1.0, -0.3, 0.2, 0.4, -0.2, 0.5).finished() * size;
  }

  inline fem::PointAnswer requested(coupling::CellPoints &of, const base::Voigt &strain, const bool with_tangent = true)
  {
    fem::PointAnswer answer;
    of.evaluate(0, strain, fem::ElementExtent::uniform(1), with_tangent, answer);
    return answer;
  }
} // namespace multiscale

// Spheres that press on areas of a surface: closed form, forces as the slope of an energy, and a bounce.
#include "dem/facets/pressure.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "tests/dem/clusters.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using Eigen::Vector3d;

namespace
{
  constexpr double modulus = 1e7, skin = 1e-3, radius = 0.01; ///< [Pa], [m]

  /** A square of small triangles around the origin, bumpy if wanted. */
  dem::FacetMesh carpet(const int divisions, const double half_width, const double bumps)
  {
    dem::FacetMesh                         mesh;
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> up(-bumps, bumps);
    for (int j = 0; j <= divisions; ++j)
      for (int i = 0; i <= divisions; ++i)
        mesh.vertex.emplace_back((2.0 * i / divisions - 1) * half_width, (2.0 * j / divisions - 1) * half_width,
                                 bumps > 0 ? up(random) : 0.0);
    for (int j = 0; j < divisions; ++j)
      for (int i = 0; i < divisions; ++i)
        {
          const std::int32_t a = j * (divisions + 1) + i, b = a + 1, c = a + divisions + 1, d = c + 1;
          mesh.facet.push_back({a, b, d});
          mesh.facet.push_back({a, d, c});
        }
    return mesh;
  }

  dem::SurfaceParameters with_skin(const dem::FacetMesh &mesh, const double friction = 0)
  {
    dem::LinearContactParameters law;
    law.effective_modulus    = modulus;
    law.friction_coefficient = friction;
    return {"skin", mesh, law, skin};
  }

  std::vector<dem::NearPoint> near_points(const dem::Surface &surface, const Vector3d &centre)
  {
    std::vector<dem::NearPoint> near;
    for (std::size_t f = 0; f < surface.mesh.size(); ++f)
      {
        const dem::FacetPoint point = dem::closest_on_facet(surface.mesh, surface.place, f, centre);
        const double          d     = (point.place - centre).norm();
        if (d < radius)
          near.push_back({static_cast<std::int32_t>(f), point, d, (point.place - centre) / d});
      }
    return near;
  }

  dem::PressedPatch
  patch_of(const dem::Surface &surface, const Vector3d &centre, std::vector<dem::VertexPart> *parts = nullptr)
  {
    std::vector<dem::VertexPart> unused;
    return dem::press(surface, near_points(surface, centre), centre, radius, 1, parts ? *parts : unused);
  }
} // namespace

TEST_CASE("a sphere presses on a skin as the integral over its cap says", "[facets]")
{
  const double depth = 2e-3, distance = radius - depth, bedding = modulus / skin;
  const double force  = M_PI * bedding * distance * depth * depth;
  const double energy = M_PI * bedding * (radius * std::pow(depth, 3) / 3 - std::pow(depth, 4) / 4);
  double       error[2];
  for (const int level : {0, 1})
    {
      const dem::Surface      surface(with_skin(carpet(20 << level, 0.012, 0)), dem::Physics());
      const dem::PressedPatch found = patch_of(surface, {1.3e-4, -0.7e-4, distance});
      error[level]                  = std::fabs(found.push.z() / force - 1) + std::fabs(found.spring / energy - 1);
      CHECK(found.push.head<2>().norm() < 0.01 * force);
      CHECK(found.deepest == Approx(depth).epsilon(0.01));
    }
  CHECK(error[1] < 5e-3);
  CHECK(error[1] < 0.5 * error[0]);
}

TEST_CASE("forces of a skin are the slope of its energy, for the sphere and for every vertex", "[facets]")
{
  dem::Surface                 surface(with_skin(carpet(8, 0.012, 5e-4)), dem::Physics());
  const Vector3d               centre(1e-3, 2e-3, 8.5e-3);
  std::vector<dem::VertexPart> parts;
  const dem::PressedPatch      found = patch_of(surface, centre, &parts);
  REQUIRE(found.touches());
  const double h        = 1e-8;
  Vector3d     together = found.push;
  double       weights  = 0;
  for (int d = 0; d < 3; ++d)
    {
      const Vector3d step = h * Vector3d::Unit(d);
      const double   slope =
        (patch_of(surface, centre + step).spring - patch_of(surface, centre - step).spring) / (2 * h);
      CHECK(found.push[d] == Approx(-slope).margin(1e-5 * found.total));
    }
  for (const dem::VertexPart &part : parts)
    {
      together += part.force;
      weights += part.weight;
      for (int d = 0; d < 3; ++d)
        {
          Vector3d    &place = surface.place[static_cast<std::size_t>(part.vertex)];
          const double at    = place[d];
          place[d]           = at + h;
          const double more  = patch_of(surface, centre).spring;
          place[d]           = at - h;
          const double less  = patch_of(surface, centre).spring;
          place[d]           = at;
          CHECK(part.force[d] == Approx(-(more - less) / (2 * h)).margin(1e-5 * found.total));
        }
    }
  CHECK(together.norm() < 1e-12 * found.total);
  CHECK(weights == Approx(1).epsilon(1e-12));
}

TEST_CASE("a ball bounces off a rough bumpy skin and keeps its energy", "[facets]")
{
  double error[2];
  for (const int level : {0, 1})
    {
      dem::Packing packing;
      packing.centre = {{1e-3, 2e-3, 0.0115}};
      packing.radius = {radius};
      auto p         = cluster::bonded(1.0);
      p.step_factor  = 0.1 / (1 << level);
      p.damping      = 0;
      dem::LinearContactParameters law;
      law.effective_modulus = modulus;
      dem::Specimen specimen(packing, p, law);
      specimen.set_velocity(0, {0.3, 0, -1}, {0, 20, 0});
      specimen.surfaces().add(with_skin(carpet(12, 0.015, 5e-4), 0.4));
      bool   touched = false;
      double worst   = 0;
      while (specimen.time() < 0.01)
        {
          specimen.advance(1);
          touched = touched || specimen.surfaces().at(0).touching > 0;
          worst   = std::max(worst, std::fabs(specimen.energy().residual()) / specimen.energy().initial);
        }
      REQUIRE(touched);
      CHECK(specimen.surfaces().at(0).touching == 0);
      CHECK(specimen.particle(0).velocity.z() > 0);
      CHECK(specimen.energy().friction > 0);
      error[level] = worst;
    }
  CHECK(error[0] < 2e-3);
  CHECK(error[1] < 0.6 * error[0]);
}

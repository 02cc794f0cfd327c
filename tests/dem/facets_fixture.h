#pragma once

#include "dem/core/uniform_random.h"
#include "dem/facets/shapes.h"
#include "dem/facets/surface.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <vector>

/** Balls and walls for tests. */
namespace walls
{
  using Eigen::Vector3d;

  constexpr double pi = 3.14159265358979323846;

  inline dem::LinearContactParameters contact(const double friction = 0, const double modulus = 1e7)
  {
    dem::LinearContactParameters p;
    p.effective_modulus    = modulus;
    p.stiffness_ratio      = 2;
    p.friction_coefficient = friction;
    return p;
  }

  inline dem::SpecimenParameters loose(const int dimension = 3)
  {
    dem::SpecimenParameters p;
    p.physics.dimension = dimension;
    p.thickness         = dimension == 2 ? 0.01 : 0;
    p.density           = 2500;
    p.interaction_ratio = 1;
    p.step_factor       = 0.2;
    return p;
  }

  inline dem::SurfaceParameters wall(const dem::FacetMesh &mesh, const double friction = 0, const double modulus = 1e7)
  {
    return {"wall", mesh, contact(friction, modulus)};
  }

  inline dem::Packing balls(const std::vector<Vector3d> &centre, const double radius)
  {
    return {centre, std::vector<double>(centre.size(), radius), {}};
  }

  /** Square [-half, half]^2 of n x n cells of two triangles each, at the heights given; inner vertices shaken sideways. */
  inline dem::FacetMesh patch(
    const double                                 half,
    const int                                    n,
    const std::function<double(double, double)> &height = [](double, double) { return 0.0; },
    const double                                 shake  = 0.25)
  {
    dem::FacetMesh     mesh;
    dem::UniformRandom random(5);
    const double       size = 2 * half / n;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        {
          const bool   inner = i > 0 && j > 0 && i < n && j < n;
          const double x     = -half + size * (i + (inner ? shake * (2 * random() - 1) : 0)),
                       y     = -half + size * (j + (inner ? shake * (2 * random() - 1) : 0));
          mesh.vertex.push_back({x, y, height(x, y)});
        }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        {
          const int at = j * (n + 1) + i;
          mesh.facet.push_back({at, at + 1, at + n + 2});
          mesh.facet.push_back({at, at + n + 2, at + n + 1});
        }
    return mesh;
  }

  /** A particle driven along a path. */
  class Driven
  {
  public:
    Driven(dem::Specimen &specimen, const std::size_t particle)
      : body(specimen)
      , number(particle)
    {
      dem::Grip grip;
      grip.particles  = {particle};
      grip.prescribed = {true, true, true, true, true, true};
      held            = body.grips().add(grip);
    }
    void to(const Vector3d &place)
    {
      body.grips().set_velocity(held, (place - body.particle(number).position) / body.time_step(), Vector3d::Zero());
      body.advance(1);
    }

  private:
    dem::Specimen &body;
    std::size_t    number, held;
  };

  inline Vector3d random_place(dem::UniformRandom &random, const double half)
  {
    const double x = random(), y = random(), z = random();
    return half * Vector3d(2 * x - 1, 2 * y - 1, 2 * z - 1);
  }

  /** By how much two lists differ, all in all; 0: to the last bit in nothing. */
  inline double difference(const std::vector<Vector3d> &a, const std::vector<Vector3d> &b)
  {
    double sum = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      sum += (a[i] - b[i]).cwiseAbs().sum();
    return sum;
  }
} // namespace walls

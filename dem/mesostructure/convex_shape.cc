#include "dem/mesostructure/convex_shape.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/genesis/polyhedron.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    class Sphere final : public ConvexShape
    {
    public:
      Vector3d furthest(const Vector3d &direction) const override { return direction.normalized(); }
      double   depth(const Vector3d &place) const override { return 1 - place.norm(); }
      double   reach() const override { return 1; }
      double   inner_reach() const override { return 1; }
      bool     is_sphere() const override { return true; }
    };

    class Ellipsoid final : public ConvexShape
    {
    public:
      explicit Ellipsoid(const Vector3d &semi_axes)
        : axes(semi_axes)
      {
      }

      Vector3d furthest(const Vector3d &direction) const override
      {
        const Vector3d scaled = axes.cwiseProduct(direction);
        return axes.cwiseProduct(scaled) / scaled.norm();
      }

      double reach() const override { return axes.maxCoeff(); }
      double inner_reach() const override { return axes.minCoeff(); }

      /**
       * The nearest place of the surface is x_i = a_i^2 y_i/(t + a_i^2), where t is the largest root of sum (a_i y_i/(t + a_i^2))^2 = 1, which falls
       * monotonically above -min a_i^2 (Eberly, Distance from a point to an ellipsoid).
       */
      double depth(const Vector3d &place) const override
      {
        const Vector3d y = place.cwiseAbs(), squares = axes.cwiseAbs2();
        const auto     sum = [&](const double t) {
          return (axes.cwiseProduct(y).array() / (squares.array() + t)).square().sum();
        };
        const double pole = -squares.minCoeff();
        double       low = pole, high = axes.maxCoeff() * y.norm();
        // Inside, on the plane of the longer axes and near the middle there is no root: the nearest place is off that plane.
        for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
          (sum(middle) > 1 ? low : high) = middle;
        Vector3d nearest;
        double   used = 0;
        int      shortest;
        squares.minCoeff(&shortest);
        for (int d = 0; d < 3; ++d)
          if (d != shortest || y[d] > 0)
            {
              nearest[d] = squares[d] * y[d] / (squares[d] + high);
              used += d == shortest ? 0 : std::pow(nearest[d] / axes[d], 2);
            }
        if (!(y[shortest] > 0) || !(std::abs(sum(high) - 1) < 1e-6))
          nearest[shortest] = axes[shortest] * std::sqrt(std::max(0.0, 1 - used));
        const double distance = (nearest - y).norm();
        return y.cwiseQuotient(axes).squaredNorm() <= 1 ? distance : -distance;
      }

    private:
      Vector3d axes;
    };

    class Hull final : public ConvexShape
    {
    public:
      explicit Hull(const std::vector<Vector3d> &corners)
        : body(corners)
        , corner(corners)
      {
        for (const Vector3d &x : corner)
          arm = std::max(arm, x.norm());
        inner = body.depth(Vector3d::Zero());
      }

      Vector3d furthest(const Vector3d &direction) const override
      {
        return *std::max_element(corner.begin(), corner.end(), [&](const Vector3d &a, const Vector3d &b) {
          return direction.dot(a) < direction.dot(b);
        });
      }
      double depth(const Vector3d &place) const override { return body.depth(place); }
      double reach() const override { return arm; }
      double inner_reach() const override { return inner; }

    private:
      Polyhedron            body;
      std::vector<Vector3d> corner;
      double                arm = 0, inner = 0;
    };

    /** Semi-axes of the volume of a sphere of radius 1: the longest first. */
    Vector3d semi_axes(const double elongation, const double flatness)
    {
      for (const auto &[name, value] : {std::pair{"elongation", elongation}, std::pair{"flatness", flatness}})
        if (!(value >= 0.1 && value <= 1))
          throw base::InputError(std::string("Aggregates: ") + name + " = " + base::number_text(value) +
                                 ": must be in [0.1, 1].");
      const Vector3d axes(1, elongation, elongation * flatness);
      return axes / std::cbrt(axes.prod());
    }

    Vector3d random_direction(UniformRandom &random)
    {
      const double z = 2 * random() - 1, angle = 2 * M_PI * random(), across = std::sqrt(1 - z * z);
      return {across * std::cos(angle), across * std::sin(angle), z};
    }

    /** Places on the unit sphere that keep a distance from each other. */
    std::vector<Vector3d> spread_corners(const int count, UniformRandom &random)
    {
      const double          apart = 0.5 * std::sqrt(4 * M_PI / count);
      std::vector<Vector3d> corners;
      while (static_cast<int>(corners.size()) < count)
        {
          const Vector3d x = random_direction(random);
          if (std::all_of(corners.begin(), corners.end(), [&](const Vector3d &y) { return (x - y).norm() >= apart; }))
            corners.push_back(x);
        }
      return corners;
    }
  } // namespace

  std::shared_ptr<const ConvexShape> unit_sphere() { return std::make_shared<Sphere>(); }

  std::shared_ptr<const ConvexShape> ellipsoid(const double elongation, const double flatness)
  {
    return std::make_shared<Ellipsoid>(semi_axes(elongation, flatness));
  }

  std::shared_ptr<const ConvexShape>
  random_polyhedron(const int corners, const double elongation, const double flatness, UniformRandom &random)
  {
    if (corners < 6 || corners > 24)
      throw base::InputError("Aggregates: " + std::to_string(corners) + " corners: must be from 6 to 24.");
    const Vector3d axes = semi_axes(elongation, flatness);
    for (;;)
      {
        std::vector<Vector3d> places = spread_corners(corners, random);
        for (Vector3d &x : places)
          x = x.cwiseProduct(axes);
        const Polyhedron hull(places);
        if (!(hull.depth(Vector3d::Zero()) > 0)) // all corners on one side
          continue;
        const double scale = std::cbrt(4.0 / 3.0 * M_PI / hull.volume());
        for (Vector3d &x : places)
          x = (x - hull.centroid()) * scale;
        return std::make_shared<Hull>(places);
      }
  }

  Eigen::Matrix3d random_rotation(UniformRandom &random)
  {
    const double u = random(), first = 2 * M_PI * random(), second = 2 * M_PI * random();
    const double a = std::sqrt(1 - u), b = std::sqrt(u);
    return Eigen::Quaterniond(b * std::cos(second), a * std::sin(first), a * std::cos(first), b * std::sin(second))
      .toRotationMatrix();
  }
} // namespace dem

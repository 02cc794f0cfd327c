// What of velocities is too fine for a mesh: doc/theory/volume-coupling.md, 4.
#include "dem/measures/fine_scale.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using Eigen::Vector3d;

namespace
{
  constexpr double spacing_of_grid = 0.3;

  /** Points of no order in a cube of unit edges, of unequal masses. */
  dem::FineScaleFilter::Carriers irregular(const int count)
  {
    dem::FineScaleFilter::Carriers all;
    for (int i = 0; i < count; ++i)
      {
        const double k = i + 1;
        all.places.emplace_back(std::fmod(0.819172513 * k, 1.0), std::fmod(0.671043607 * k, 1.0),
                                std::fmod(0.549700478 * k, 1.0));
        all.masses.push_back(1 + 0.5 * std::sin(k));
        all.rates.push_back(0.2 + all.places.back().x());
      }
    return all;
  }

  base::Column field(const dem::FineScaleFilter                      &filter,
                     const dem::FineScaleFilter::Carriers            &all,
                     const std::function<Vector3d(const Vector3d &)> &value)
  {
    base::Column column(dem::SplineGrid::record * all.places.size());
    for (std::size_t k = 0; k < all.places.size(); ++k)
      Eigen::Map<Vector3d>{&column[dem::SplineGrid::record * k]} = value(all.places[filter.order()[k]]);
    return column;
  }

  double product(const base::Column &a, const base::Column &b)
  {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); k += dem::SplineGrid::record)
      sum += Vector3d(&a[k]).dot(Vector3d(&b[k]));
    return sum;
  }

  Vector3d noise(const Vector3d &x, const double phase)
  {
    const double k = x.dot(Vector3d(1.0, 7.3, 3.1));
    return {std::sin(phase + 1299.898 * k), std::sin(2 * phase + 7823.3 * k), std::sin(3 * phase + 377.7 * k)};
  }
} // namespace

TEST_CASE("fine scale: what varies evenly feels no force, and no force has a sum or a moment", "[fine scale]")
{
  const auto                 all = irregular(3000);
  const dem::FineScaleFilter filter(all, spacing_of_grid, 3, 3);
  Eigen::Matrix3d            gradient;
  gradient << 0.3, -1.2, 0.5, 0.8, -0.1, 0.2, -0.6, 0.4, 0.9;
  base::Column force;
  filter.damping(field(filter, all, [&](const Vector3d &x) -> Vector3d { return Vector3d(1, 2, 3) + gradient * x; }),
                 force);
  CHECK(std::sqrt(product(force, force)) <= 1e-11);

  filter.damping(field(filter, all, [](const Vector3d &x) { return noise(x, 0.4); }), force);
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  for (std::size_t k = 0; k < all.places.size(); ++k)
    {
      const Vector3d f(&force[dem::SplineGrid::record * k]);
      sum += f;
      moment += all.places[filter.order()[k]].cross(f);
    }
  CHECK(sum.norm() <= 1e-11 * std::sqrt(product(force, force)) * 50);
  CHECK(moment.norm() <= 1e-11 * std::sqrt(product(force, force)) * 50);
}

TEST_CASE("fine scale: the force is symmetric in the velocities, and takes energy of all of them", "[fine scale]")
{
  const auto all = irregular(2000);
  for (const int sharpness : {1, 2, 3})
    {
      const dem::FineScaleFilter filter(all, spacing_of_grid, 3, sharpness);
      const base::Column         one = field(filter, all, [](const Vector3d &x) { return noise(x, 0.1); }),
                         other       = field(filter, all, [](const Vector3d &x) -> Vector3d {
                           return noise(x, 1.7) + Vector3d(std::sin(5 * x.x()), x.y() * x.y(), 0);
                         });
      base::Column of_one, of_other;
      filter.damping(one, of_one);
      filter.damping(other, of_other);
      CHECK(product(other, of_one) == Approx(product(one, of_other)).epsilon(1e-10));
      CHECK(product(one, of_one) > 0);
      CHECK(product(other, of_other) > 0);
    }
}

TEST_CASE("fine scale: waves short against the grid are damped at the full rate, long ones hardly", "[fine scale]")
{
  dem::FineScaleFilter::Carriers row;
  for (int i = 0; i < 400; ++i)
    {
      row.places.emplace_back(0.1 * i, 0, 0);
      row.masses.push_back(2);
      row.rates.push_back(i >= 100 && i < 300 ? 5.0 : 0.0); // away from the ends, where averages are one-sided
    }
  const dem::FineScaleFilter filter(row, 0.35, 2, 3);
  const auto                 rate = [&](const double wavelength) {
    const base::Column v = field(
                      filter, row, [&](const Vector3d &x) { return Vector3d(std::sin(2 * M_PI / wavelength * x.x() + 0.3), 0, 0); });
    base::Column force;
    filter.damping(v, force);
    double power = 0, motion = 0;
    for (std::size_t k = 0; k < row.places.size(); ++k)
      if (row.rates[filter.order()[k]] > 0)
        motion += 2 * 5.0 * v[dem::SplineGrid::record * k] * v[dem::SplineGrid::record * k];
    power = product(v, force);
    return power / motion;
  };
  CHECK(rate(0.4) == Approx(1).margin(0.02));
  // An average passes sinc^8 of half the phase between knots.
  for (const double wavelength : {1.0, 1.4, 2.0, 3.0})
    {
      const double half = M_PI * 0.35 / wavelength, passed = std::pow(std::sin(half) / half, 8);
      CHECK(rate(wavelength) == Approx(std::pow(1 - passed, 6)).margin(0.02));
    }
}

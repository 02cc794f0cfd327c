// Overlaps of simplices and the forces between bodies that lie in each other.
#include "coupling/contact/bodies/body_contacts.h"
#include "coupling/contact/bodies/overlap.h"
#include "dem/core/uniform_random.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

using coupling::bodies::Simplex;
using Eigen::Vector3d;

namespace
{
  Simplex unit(const int corners, const Vector3d &at = Vector3d::Zero(), const double size = 1)
  {
    Simplex s;
    s.corners = corners;
    s.corner  = {at, at + size * Vector3d::UnitX(), at + size * Vector3d::UnitY(), at + size * Vector3d::UnitZ()};
    return s;
  }

  /** Any simplex of positive volume around the origin. */
  Simplex random_simplex(const int corners, dem::UniformRandom &random)
  {
    Simplex s;
    s.corners = corners;
    do
      for (Vector3d &x : s.corner)
        for (int d = 0; d < 3; ++d)
          x[d] = d < corners - 1 ? 2 * random() - 1 : 0.0;
    while (!(s.volume() > 0.05));
    return s;
  }

  bool inside(const Simplex &s, const Vector3d &x)
  {
    for (int c = 0; c < s.corners; ++c)
      if (s.slope(c).dot(x - s.corner[c == 0 ? 1 : 0]) < 0)
        return false;
    return true;
  }

  /** Two bodies, each a simplex divided about its centre, which is deepest. */
  coupling::bodies::BodyMesh two_bodies(const int corners, dem::UniformRandom &random)
  {
    coupling::bodies::BodyMesh mesh;
    mesh.corners   = corners;
    mesh.thickness = corners == 3 ? 0.3 : 1;
    mesh.bodies    = {"one", "two"};
    for (std::int32_t b = 0; b < 2; ++b)
      {
        const Simplex                  s       = random_simplex(corners, random);
        const auto                     first   = static_cast<std::int32_t>(mesh.place.size());
        coupling::bodies::BodyElement &element = mesh.elements.emplace_back();
        element.body                           = b;
        element.size                           = std::cbrt(s.volume() * s.volume());
        Vector3d centre                        = Vector3d::Zero();
        for (int c = 0; c < corners; ++c)
          {
            element.vertices.push_back(first + c);
            mesh.place.push_back(s.corner[c]);
            mesh.depth.push_back(0);
            centre += s.corner[c] / corners;
          }
        mesh.place.push_back(centre);
        mesh.depth.push_back(0.3);
        for (int c = 0; c < corners; ++c) // the centre in place of this corner
          {
            coupling::bodies::BodySimplex part;
            part.element = b;
            part.surface = static_cast<std::uint8_t>(1u << c);
            for (int k = 0; k < corners; ++k)
              part.vertex[k] = first + (k == c ? corners : k);
            mesh.simplices.push_back(part);
          }
      }
    return mesh;
  }

  coupling::bodies::BodyContacts contacts(const coupling::bodies::BodyMesh &mesh, const std::vector<Vector3d> &place)
  {
    coupling::bodies::BodyContactParameters law;
    law.stiffness = 3e6;
    coupling::bodies::BodyContacts made(mesh, law);
    made.move_to(place);
    return made;
  }
} // namespace

TEST_CASE("bodies: volume and centroid of an overlap are those of the points in both", "[coupling][bodies]")
{
  const int          corners = GENERATE(3, 4);
  dem::UniformRandom random(7);
  int                overlapping = 0;
  for (int n = 0; n < 60; ++n)
    {
      const Simplex             a = random_simplex(corners, random), b = random_simplex(corners, random);
      coupling::bodies::Overlap found;
      coupling::bodies::find_overlap(a, b, found);
      constexpr int points = 20000;
      Vector3d      sum    = Vector3d::Zero();
      int           hits   = 0;
      for (int p = 0; p < points; ++p)
        {
          Vector3d x(2 * random() - 1, 2 * random() - 1, corners == 4 ? 2 * random() - 1 : 0.0);
          if (inside(a, x) && inside(b, x))
            {
              sum += x;
              ++hits;
            }
        }
      const double box = std::pow(2.0, corners - 1), noise = 4 * box * std::sqrt((hits + 1.0)) / points;
      INFO("pair " << n << ": " << found.volume);
      REQUIRE(found.volume == Approx(box * hits / points).margin(noise));
      if (hits > 100)
        {
          ++overlapping;
          REQUIRE((found.centroid - sum / hits).norm() < 4.0 / std::sqrt(hits));
        }
      Vector3d closed = Vector3d::Zero(); // the boundary is
      for (const coupling::bodies::OverlapPiece &piece : found.pieces)
        if (!piece.twice)
          closed += piece.area;
      REQUIRE(closed.norm() < 1e-13);
      coupling::bodies::Overlap other;
      coupling::bodies::find_overlap(b, a, other);
      REQUIRE(other.volume == Approx(found.volume).epsilon(1e-12).margin(1e-15));
    }
  CHECK(overlapping > 5);
}

TEST_CASE("bodies: simplices with sides in one plane overlap by what they share", "[coupling][bodies]")
{
  coupling::bodies::Overlap found;
  const double              whole = 1.0 / 6;
  coupling::bodies::find_overlap(unit(4), unit(4), found);
  CHECK(found.volume == Approx(whole).epsilon(1e-14));
  CHECK((found.centroid - Vector3d::Constant(0.25)).norm() < 1e-15);
  coupling::bodies::find_overlap(unit(4), unit(4, Vector3d::Zero(), 0.5), found); // three planes in common
  CHECK(found.volume == Approx(whole / 8).epsilon(1e-14));
  coupling::bodies::find_overlap(unit(4), unit(4, {0, 0, 0.25}), found); // two
  CHECK(found.volume == Approx(whole * 27 / 64).epsilon(1e-14));
  coupling::bodies::find_overlap(unit(3), unit(3, {0.25, 0, 0}), found);
  CHECK(found.volume == Approx(0.5 * 9 / 16).epsilon(1e-14));
  // Side by side: nothing.
  Simplex beside   = unit(4);
  beside.corner[3] = -Vector3d::UnitZ();
  std::swap(beside.corner[0], beside.corner[1]);
  coupling::bodies::find_overlap(unit(4), beside, found);
  CHECK(found.pieces.empty());
}

TEST_CASE("bodies: faces that lie on each other overlap in nothing, whatever rounding makes of their common plane",
          "[coupling][bodies]")
{
  // Two triangles in one plane, a sixth of a turn apart: what they share has six corners, above and below the plane by chance.
  dem::UniformRandom        random(5);
  coupling::bodies::Overlap found;
  for (int n = 0; n < 20000; ++n)
    {
      Vector3d at, normal;
      for (int d = 0; d < 3; ++d)
        {
          at[d]     = 2 * random() - 1;
          normal[d] = 2 * random() - 1;
        }
      normal.normalize();
      const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
      const double   sixth = M_PI / 3, turn = 2 * M_PI * random();
      Simplex        below, above;
      for (int c = 0; c < 3; ++c)
        {
          const double p  = turn + 2 * c * sixth;
          below.corner[c] = at + std::cos(p) * u + std::sin(p) * v;
          above.corner[c] = at + std::cos(p + sixth) * u + std::sin(p + sixth) * v;
        }
      below.corner[3] = at - normal;
      above.corner[3] = at + normal;
      for (Simplex *each : {&below, &above})
        if (each->volume() < 0)
          std::swap(each->corner[0], each->corner[1]);
      coupling::bodies::find_overlap(below, above, found);
      REQUIRE(found.volume >= 0);
      REQUIRE(found.volume < 1e-14);
      for (const coupling::bodies::OverlapPiece &piece : found.pieces)
        REQUIRE((piece.corner[0] - at).norm() < 1.1);
    }
}

TEST_CASE("bodies: forces of the potential are the slope of its energy, moved as one or deformed", "[coupling][bodies]")
{
  const int          corners = GENERATE(3, 4);
  constexpr double   step    = 1e-6;
  dem::UniformRandom random(11);
  int                tested = 0;
  for (int n = 0; n < 100 && tested < 8; ++n)
    {
      const coupling::bodies::BodyMesh     mesh  = two_bodies(corners, random);
      const coupling::bodies::BodyContacts found = contacts(mesh, mesh.place);
      if (found.overlap() < 0.01)
        continue;
      ++tested;
      double   largest = 0;
      Vector3d sum = Vector3d::Zero(), turn = Vector3d::Zero();
      for (std::size_t v = 0; v < mesh.place.size(); ++v)
        {
          largest = std::max(largest, found.force()[v].norm());
          sum += found.force()[v];
          turn += mesh.place[v].cross(found.force()[v]);
        }
      CHECK(sum.norm() < 1e-12 * largest);
      CHECK(turn.norm() < 1e-12 * largest);
      for (std::size_t v = 0; v < mesh.place.size(); ++v)
        for (int d = 0; d < corners - 1; ++d)
          {
            const auto energy = [&](const double by) {
              auto place = mesh.place;
              place[v][d] += by;
              return contacts(mesh, place).energy().normal;
            };
            CAPTURE(n, v, d);
            REQUIRE(found.force()[v][d] ==
                    Approx((energy(-step) - energy(step)) / (2 * step)).epsilon(1e-6).margin(1e-6 * largest));
          }
    }
  CHECK(tested == 8);
}

#pragma once

#include "dem/model/packing.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace dem
{
  /** A convex body in space, known by its corners (doc/theory/clumps.md, 3). */
  class Polyhedron
  {
  public:
    /** @param corners in any order [m] @throws base::InputError where they are not the corners of a convex body, naming one (from 1) */
    explicit Polyhedron(const std::vector<Eigen::Vector3d> &corners);

    double          volume() const { return own_volume; }     ///< [m^3]
    Eigen::Vector3d centroid() const { return own_centroid; } ///< [m]
    /** Second moments about the centroid over the volume, int x x^T dV / V [m^2]. */
    Eigen::Matrix3d second_moments() const { return own_moments; }
    /** How deep a place lies inside: the distance to the nearest face, below 0 outside [m]. */
    double depth(const Eigen::Vector3d &place) const;

  private:
    struct Face
    {
      std::vector<std::size_t> corners; ///< counter-clockwise seen from outside
      Eigen::Vector3d          normal;  ///< unit, outwards
      double                   at;      ///< of its plane along the normal [m]
    };

    void find_faces();
    bool is_in_a_face(const std::array<std::size_t, 3> &three) const;
    /** Corners that lie in the plane of three, if all others lie on one side of it; otherwise empty. */
    std::vector<std::size_t> face_through(std::size_t i, std::size_t j, std::size_t k, Eigen::Vector3d &normal) const;
    void                     refuse_corners_that_are_none() const;
    void                     integrate();

    std::vector<Eigen::Vector3d> corner;
    double                       size = 0; ///< largest distance of two corners [m]
    std::vector<Face>            faces;
    double                       own_volume   = 0;
    Eigen::Vector3d              own_centroid = Eigen::Vector3d::Zero();
    Eigen::Matrix3d              own_moments  = Eigen::Matrix3d::Zero();
  };

  /** As a rigid body of a packing: volume, centroid and inertia of the polyhedron. */
  PackedBody body_of(const Polyhedron &polyhedron);
} // namespace dem

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dem
{
  /** A body that pebbles of a packing stand for: its shape, not theirs, says how it moves (doc/theory/genesis.md, 6). */
  struct PackedBody
  {
    double          volume = 0;                       ///< [m^3], of discs area [m^2]; > 0
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of mass [m]
    Eigen::Matrix3d inertia =
      Eigen::Matrix3d::Zero(); ///< about the centre, over the mass [m^2]; in the plane z alone counts
  };

  /** Two particles with a joint between them: the plane of a crack that was there before the load (doc/theory/smooth-joint.md, 4). */
  struct JointCut
  {
    std::int32_t first = 0, second = 0; ///< numbers of the particles, the first the smaller
    std::int32_t joint = 0;             ///< its number, from 0
    double       area  = 0;             ///< of a link between the two: its share of the joint [m^2], > 0

    bool operator<(const JointCut &other) const
    {
      return first != other.first ? first < other.first : second < other.second;
    }
  };

  /**
 * Spheres (discs in two dimensions: z = 0): where a specimen starts from. Of their material it knows a number and, if its maker
 * gave one, a name; the constants are the specimen's.
 *
 * A periodic packing fills the box [0, cell) of the three edge lengths and repeats along each; centres may lie outside
 * and are then understood modulo the cell. An infinite edge: no repetition along it (the third edge of discs).
 */
  struct Packing
  {
    std::vector<Eigen::Vector3d>   centre;        ///< [m]
    std::vector<double>            radius;        ///< [m], > 0
    std::optional<Eigen::Vector3d> periodic_cell; ///< edge lengths [m]; absent: a free packing

    std::vector<std::int32_t> material       = {}; ///< of each particle, a number from 0; empty: all are of one
    std::vector<std::string>  material_names = {}; ///< what the numbers are called; empty: they have no names

    std::vector<std::int32_t> clump =
      {}; ///< number of the body below that each is a pebble of, -1: of none; empty: none is
    std::vector<PackedBody> bodies = {};

    std::vector<JointCut> cuts =
      {}; ///< in their order, each pair once; such pairs are linked by the joint, or not at all

    /** Whether two are pebbles of one body, and may overlap as they like. */
    bool in_one_body(const std::size_t first, const std::size_t second) const
    {
      return !clump.empty() && clump[first] >= 0 && clump[first] == clump[second];
    }

    std::size_t size() const { return centre.size(); }
  };

  /**
 * Refuse what no specimen can be made of: columns of unequal length, no particle, a centre or radius that is not a number
 * or beyond 1e100 m, a radius not above zero, two centres at the same place, a periodic cell edge not above zero, a material
 * that is negative or beyond the names, names that is_material_name() does not allow or that occur twice, a clump beyond the bodies,
 * a body without pebbles or of no volume or inertia.
 *
 * @param origin where the packing came from (a file name, "generator"), for the message.
 * @throws base::InputError naming the first offending particle (counted from 1) and what is allowed.
 */
  void check_packing(const Packing &packing, const std::string &origin);

  /** What a packing must be to repeat by its periodic cell. @throws base::InputError naming the particle */
  void check_in_cell(const Packing &packing, const std::string &origin);

  /** Whether a material may be called so: its name must fit a column of a table. */
  bool        is_material_name(const std::string &name);
  const char *material_name_rule(); ///< in words

  /** Volume of all particles [m^3] (spheres; overlaps counted twice). */
  double solid_volume(const Packing &packing);
} // namespace dem

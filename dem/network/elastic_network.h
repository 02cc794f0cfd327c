#pragma once

#include "dem/model/materials.h"
#include "dem/model/packing.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * One linear link of a network: force on its first end = stiffness * slip, with
   *
   *   slip = u_K - u_J + n x (a_J phi_J + a_K phi_K)
   *
   * the relative displacement at the contact point (doc/theory/statics.md, 1).
   */
  struct ElasticLink
  {
    std::int32_t    first, second;         ///< J, K; equal: a particle and its own periodic image
    Eigen::Vector3d direction;             ///< n, from J to K
    Eigen::Vector3d branch;                ///< l = x_K + H k - x_J [m]
    Eigen::Vector3d shift;                 ///< H k, what of the branch is cell [m]
    double          arm_first, arm_second; ///< a_J, a_K: from either centre to the contact point, a_J + a_K = |l| [m]
    double          area;                  ///< A [m^2]
    double          reference;             ///< length that strains are measured against [m]
    Eigen::Matrix3d stiffness;             ///< C, symmetric [N/m]
    /** Moment over relative rotation phi_K - phi_J, symmetric [N m]; zero where the law has no moment. */
    Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();
    std::int32_t    pair    = 0; ///< number of the pair of materials; see `waits`
    NewLink         made;        ///< as the law saw it when it was made
    /** A contact of particles that are apart (dem/network/waiting_contacts.h): its pair is numbered past those of all bonds. */
    bool            waits = false;
    Eigen::Matrix3d once_closed =
      Eigen::Matrix3d::Zero(); ///< stiffness that a contact which waits has when it touches [N/m]
  };

  /** A link where it lies, as its law sees it. */
  LinkGeometry geometry_of(const ElasticLink &link);

  /** Force and moment on the first end per slip and relative rotation, as the link was made. */
  base::Matrix6 undamaged_stiffness(const ElasticLink &link);

  /** Particles joined by linear links, in the configuration from which small motions are computed. */
  struct ElasticNetwork
  {
    int                          dimension = 3;    ///< 3, or 2: only x, y and the rotation about z move
    bool                         rotations = true; ///< particles rotate; otherwise they only translate
    std::vector<Eigen::Vector3d> centre;           ///< [m]
    std::vector<std::int32_t>    material;         ///< of each particle its number; empty: there is one
    std::vector<ElasticLink>     links;            ///< sorted by first, then second
    double volume = 0; ///< of the periodic cell (area times thickness in the plane) [m^3]; 0: free

    std::size_t particles() const { return centre.size(); }
    std::size_t bonds() const; ///< links but for contacts that wait
    bool        periodic() const { return volume > 0; }

    /** Which of a particle's six motions x, y, z, rotation about x, y, z exist at all. */
    bool moves(int component) const;
  };

  /** How links are drawn between particles. */
  struct NetworkParameters
  {
    int    dimension         = 3;    ///< 3: spheres, 2: discs in the plane z = 0
    bool   rotations         = true; ///< particles rotate; off: shear links hold translations only
    double interaction_ratio = 0;    ///< iota: a link where distance < iota (r_J + r_K), strictly; >= 1
    double installation_gap  = 0;    ///< that much further still [m], >= 0; of packings
    double normal_modulus    = 0;    ///< E of the link [Pa], > 0
    double shear_ratio       = 0;    ///< G/E of the link, > 0
    double thickness         = 0;    ///< of the discs [m], > 0; two dimensions only
    /** Particles that no link joins wait for contact where distance < (1 + reach)(r_J + r_K), >= 0; with a law's materials only. */
    double contact_reach = 0;
  };

  /** Spheres or discs in a general periodic cell: what Packing cannot hold. */
  struct CellPacking
  {
    std::vector<Eigen::Vector3d> centre; ///< [m]
    std::vector<double>          radius; ///< [m]
    Eigen::Matrix3d              cell;   ///< H, columns are the base vectors [m]; in the plane the third is ignored
  };

  /**
   * Undamaged links of stiffness (A/L)(E n n + G (1 - n n)), A = pi min(r)^2, in the plane 2 min(r) t; L the distance.
   *
   * In a periodic cell every image counts, however small the cell.
   *
   * @throws base::InputError for a parameter out of its range, a packing that check_packing() refuses, or no link at all.
   */
  ElasticNetwork make_network(const Packing &packing, const NetworkParameters &parameters);
  ElasticNetwork make_network(const CellPacking &packing, const NetworkParameters &parameters);

  /**
   * The same of a packing with several materials: moduli are those of the pair that a link joins, in place of the parameters'. Links that
   * a joint cuts (Packing::cuts) have its area and its law.
   * @throws also for a material of the packing that is not among those given
   */
  ElasticNetwork
  make_network(const Packing &packing, const NetworkParameters &parameters, const LinkMaterials &materials);
} // namespace dem

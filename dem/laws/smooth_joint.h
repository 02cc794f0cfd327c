#pragma once

#include "dem/kernels/link_law_defaults.h"
#include "dem/laws/smooth_joint_update.h"
#include "dem/model/physics.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct SmoothJointLaw;

  /**
   * Constants of a smooth joint: Mas Ivars, Pierce, Darcel, Reyes-Montes, Potyondy, Young and Cundall, Int. J. Rock Mech. Min. Sci. 48
   * (2011) 219.
   */
  struct SmoothJointParameters
  {
    using Law = SmoothJointLaw;

    double          normal_stiffness     = 0;         ///< k_n, stress over opening [Pa/m]
    double          shear_stiffness      = 0;         ///< k_s, shear stress over slip [Pa/m]
    double          friction_coefficient = 0;         ///< mu [-]
    double          dilation_angle       = 0;         ///< psi [degrees]
    double          tensile_strength     = 0;         ///< sigma_t [Pa]
    double          cohesion             = 0;         ///< c [Pa]
    Eigen::Vector3d plane                = {0, 1, 0}; ///< N, unit normal of the joint
  };

  struct SmoothJointConstants : smooth_joint::Constants<double>
  {
    /** @throws base::InputError naming the entry that is out of range */
    explicit SmoothJointConstants(const SmoothJointParameters &parameters);
  };

  /** Links of smooth joints (doc/theory/smooth-joint.md); the formulas stand in dem/laws/smooth_joint_update.h. */
  struct SmoothJoint : LinkLawDefaults
  {
    using Constants = SmoothJointConstants;

    static constexpr const char *name  = "smooth-joint";
    static constexpr bool        bonds = true, moment = false, breaks_in_place = true, tells_elements = true;
    static constexpr bool        directed = true;
    static constexpr int         records  = 2;

    template <typename T, int m>
    using State = smooth_joint::State<T, m>;

    static std::array<LinkQuantity, smooth_joint::count> history()
    {
      return {
        {{"joint_mode", "-", "0: the joint is bonded; 1: it broke in tension, 2: in shear; 3: it never was", true},
         {"joint_opening", "m", "elastic opening of the joint, negative while closed", true},
         {"slid", "m", "length slid on the closed joint", true},
         {"normal_cosine", "-", "cosine of the angle between the link and the normal of the joint, when it was made"},
         {"elastic_slip_x", "m", "elastic slip on the joint plane, along x"},
         {"elastic_slip_y", "m", "elastic slip on the joint plane, along y"},
         {"elastic_slip_z", "m", "elastic slip on the joint plane, along z"}}};
    }
    static void put(const Constants &k, double *record)
    {
      const double all[] = {k.normal,   k.shear,         k.friction, k.dilation, k.tensile_strength,
                            k.cohesion, k.bond_friction, k.plane[0], k.plane[1], k.plane[2]};
      std::copy(std::begin(all), std::end(all), record);
    }
    BRECCIA_KERNEL static smooth_joint::Constants<Pack> gathered(const Pack (&c)[2][pack_size], const Constants &)
    {
      return {c[0][0], c[0][1], c[0][2], c[0][3], c[0][4], c[0][5], c[0][6], {c[0][7], c[1][0], c[1][1]}};
    }

    static double reference_length(const NewLink &link) { return link.distance; }
    static void   begin(const Constants &k, const NewLink &link, double *history);

    template <typename K, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work)
    {
      return smooth_joint::update(k, motion, state, work);
    }
    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &, const S &)
    {
      return ((1u << smooth_joint::count) - 1) & ~(1u << smooth_joint::cosine);
    }

    /**
     * Along and across the link, of the joint's stiffness in its own axes: each with what couples the two added, so that no motion is met
     * by more (doc/theory/smooth-joint.md, 3).
     */
    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const double c2 = state.number[smooth_joint::cosine] * state.number[smooth_joint::cosine], s2 = 1 - c2;
      const double coupling = std::abs(k.normal - k.shear) * std::sqrt(std::max(c2 * s2, 0.0));
      return {link.reference * (c2 * k.normal + s2 * k.shear + coupling),
              link.reference * (s2 * k.normal + c2 * k.shear + coupling), 0, 0};
    }
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
    {
      const bool carries = state.number[smooth_joint::mode] < 0.5 || state.number[smooth_joint::opening] < 0;
      return carries ? stiffness(k, link, state) : LinkStiffnesses{};
    }
    template <typename S>
    static LinkPhase phase(const Constants &, const LinkGeometry &, const S &state)
    {
      return state.number[smooth_joint::mode] < 0.5 ? LinkPhase::whole : LinkPhase::broken;
    }
    template <typename S>
    static std::vector<BrokenElement> broken_elements(const Constants &, const LinkGeometry &, const S &state)
    {
      if (state.number[smooth_joint::mode] < 0.5 || state.number[smooth_joint::mode] > 2.5)
        return {};
      return {{0, state.number[smooth_joint::mode] < 1.5 ? BreakMode::tension : BreakMode::shear}};
    }
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state)
    {
      return link.area * smooth_joint::stored(k, state);
    }
    template <typename S>
    static LinkLoss damage(const Constants &, const LinkGeometry &, const S &state)
    {
      const double lost = state.number[smooth_joint::mode] < 0.5 ? 0.0 : 1.0;
      return {lost, lost};
    }
    template <typename S>
    static LinkExertion exertion(const Constants &k, const LinkGeometry &, const S &state, const double, const double)
    {
      constexpr double none   = std::numeric_limits<double>::infinity();
      const double     normal = k.normal * state.number[smooth_joint::opening];
      const double     shear  = k.shear * std::sqrt(smooth_joint::slip_squared(state));
      const auto       used   = [](const double stress, const double strength) {
        return stress <= 0 ? 0.0 : strength > 0 ? stress / strength : none;
      };
      if (state.number[smooth_joint::mode] > 0.5)
        return {none, used(shear, -k.friction * std::min(normal, 0.0))};
      return {std::max(used(normal, k.tensile_strength), used(shear, k.cohesion - k.bond_friction * normal)), 0};
    }
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);
  };

  /** Smooth joints as a specimen is given them: links that the plane of a joint cuts (LinkMaterials::with_joints()). */
  struct SmoothJointLaw
  {
    static constexpr const char *meaning =
      "Smooth joint: opens, closes and slides on the plane of the joint, whatever the direction of the link; no moment";

    /** @throws base::InputError naming the entry that is out of range */
    static void check(const SmoothJointParameters &parameters) { SmoothJointConstants{parameters}; }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<SmoothJointParameters> &pairs, const Physics &physics, int vector_dimension);

    /** The constants but for the plane. @param number as LinkLawKindOf takes it */
    template <typename Number>
    static void describe(SmoothJointParameters &p, Number &&number)
    {
      constexpr double smallest  = std::numeric_limits<double>::min();
      constexpr double largest   = std::numeric_limits<double>::max();
      constexpr double unlimited = std::numeric_limits<double>::infinity(); // what nothing breaks
      number("Normal stiffness", p.normal_stiffness, "Pa/m", "k_n, normal stress over opening of the joint", smallest,
             largest, true);
      number("Shear stiffness", p.shear_stiffness, "Pa/m", "k_s, shear stress over slip on the joint", smallest,
             largest, true);
      number("Friction coefficient", p.friction_coefficient, "-",
             "mu, of the broken joint, and growth of the bonded one's shear strength with pressure", 0.0, largest,
             false);
      number("Dilation angle", p.dilation_angle, "degrees",
             "psi: the sliding joint opens by tan psi times what it slides; not above the angle of friction", 0.0, 89.9,
             false);
      number("Tensile strength", p.tensile_strength, "Pa",
             "Normal stress that breaks the bonded joint; this and Cohesion 0: it is not bonded", 0.0, unlimited,
             false);
      number("Cohesion", p.cohesion, "Pa", "c, shear stress that breaks the bonded joint without normal stress", 0.0,
             unlimited, false);
    }
  };
} // namespace dem

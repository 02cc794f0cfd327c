#pragma once

#include "dem/laws/flat_joint_element.h"
#include "dem/laws/flat_joint_layout.h"
#include "dem/laws/linear_contact.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace dem
{
  struct FlatJointLaw;

  /** Constants of flat joints; Potyondy, 46th US Rock Mech. Symp. (2012), ARMA 12-501, and 52nd (2018), ARMA 18-1208. */
  struct FlatJointParameters
  {
    using Law = FlatJointLaw;

    double effective_modulus    = 0;         ///< E* of the joint [Pa]
    double stiffness_ratio      = 2.5;       ///< kappa* of the joint [-]
    double friction_coefficient = 0;         ///< mu of elements that are not bonded, and of linear contacts [-]
    double tensile_strength     = 0;         ///< sigma_c [Pa]
    double cohesion             = 0;         ///< c [Pa]
    double friction_angle       = 0;         ///< phi of bonded elements [degrees]
    double radius_multiplier    = 1;         ///< lambda: radius of the joint over that of the smaller particle [-]
    double elements             = 4;         ///< of the segment, in the plane
    double rings = 2, sectors = 6;           ///< of the disk, in space
    bool   own_moments               = true; ///< elements of the disk have second moments of their own
    double contact_effective_modulus = 0;    ///< E* of linear contacts [Pa]; 0: that of the joint
    double contact_stiffness_ratio   = 0;    ///< kappa* of linear contacts [-]; 0: that of the joint
    double gapped_fraction = 0, slit_fraction = 0; ///< of the joints, when they are made; the others are bonded [-]
    double mean_gap = 0, gap_deviation = 0;        ///< of gapped joints, normally distributed, above 0 [m]
    double seed = 1;                               ///< of that draw

    /** What is born later. */
    LinearContactParameters contact() const;
  };

  /** The same as an update takes them; as a linear contact, what stands in the place of a joint that has slid over its length. */
  template <typename Number>
  struct FlatJointNumbers : LinearContactNumbers<Number>
  {
    Number joint_normal, joint_shear; ///< E*, E*/kappa* of the joint [Pa]
    Number tensile_strength, cohesion, tan_angle;
    Number area_factor;      ///< of the joint's section over A of the link: lambda^2, in the plane lambda
    Number bending_modulus;  ///< of a bonded joint: E* I / (A R^2), A of the link [Pa]
    Number twisting_modulus; ///< E*/kappa* J / (A R^2) [Pa]

    const FlatJointLayout *layout; ///< the same for all pairs of materials
  };

  struct FlatJointConstants : FlatJointNumbers<double>
  {
    /** @throws base::InputError naming the entry that is out of range */
    FlatJointConstants(const FlatJointParameters &parameters, int dimension);

    double        radius_multiplier, gapped_fraction, slit_fraction, mean_gap, gap_deviation;
    std::uint64_t seed;

    std::shared_ptr<const FlatJointLayout> owned_layout;
  };

  /**
   * Flat joint: two particles that meet along a flat notional surface, cut into elements that are bonded or not. Bonded elements break
   * one by one, in tension or shear; unbonded ones push where they are closed and slide with friction. So a joint breaks partly, and
   * resists rotation even when broken (doc/theory/flat-joint.md).
   */
  struct FlatJoint : LinkLawDefaults
  {
    using Constants = FlatJointConstants;

    static constexpr const char *name  = "flat-joint";
    static constexpr bool        bonds = true, moment = true, breaks_in_place = true;
    static constexpr int         records  = 2;
    static constexpr bool        has_rows = true, tells_elements = true;

    /** Places of the history. */
    enum Numbers
    {
      bonded,    ///< how many elements are
      installed, ///< strain at which the gap of the surfaces is zero
      radius,    ///< of the joint [m]
      twist,     ///< relative rotation about the link since it was made [rad]
      slip_1,    ///< tangential displacement since then over the reference length, along axis 1
      turn_2,    ///< relative rotation since then, about axis 2 (in the plane: about z) [rad]
      slip_2,    ///< the others, in space only
      turn_1
    };
    /** And of its rows. */
    enum Rows
    {
      broken,      ///< how many elements are
      replaced,    ///< 1: a linear contact stands in its place, whose elastic slip is that of the first element
      initial_gap, ///< of a gapped joint, over the reference length
      elements     ///< from here on: state, and slip along axis 1 (and 2, in space)
    };
    /** State of an element. */
    enum Element
    {
      holds,
      torn,
      sheared,
      gapped,
      slit
    };

    /** The axis 1 of the elements turns with the pair; in the plane it is the direction turned by +90 degrees. */
    template <typename T, int m>
    struct State : LinkState<T, m, m == 3 ? 8 : 6, 0, 0, m == 3 ? 1 : 0>
    {
      ElementRows<T> rows;
    };

    static constexpr int row_width(const int m) { return m == 3 ? 3 : 2; }

    static std::vector<LinkQuantity> history();
    static std::vector<LinkQuantity> rows(const Constants &k, int m);
    static int rows_of(const Constants &k, const int m) { return elements + row_width(m) * k.layout->size(); }

    static void put(const Constants &k, double *record)
    {
      const double all[] = {k.normal,           k.shear,    k.friction,  k.joint_normal, k.joint_shear,
                            k.tensile_strength, k.cohesion, k.tan_angle, k.area_factor,  k.bending_modulus,
                            k.twisting_modulus};
      std::copy(std::begin(all), std::end(all), record);
    }
    BRECCIA_KERNEL static FlatJointNumbers<Pack> gathered(const Pack (&c)[2][pack_size], const Constants &first)
    {
      FlatJointNumbers<Pack> k;
      k.normal           = c[0][0];
      k.shear            = c[0][1];
      k.friction         = c[0][2];
      k.joint_normal     = c[0][3];
      k.joint_shear      = c[0][4];
      k.tensile_strength = c[0][5];
      k.cohesion         = c[0][6];
      k.tan_angle        = c[0][7];
      k.area_factor      = c[1][0];
      k.bending_modulus  = c[1][1];
      k.twisting_modulus = c[1][2];
      k.layout           = first.layout;
      return k;
    }

    static double reference_length(const NewLink &link) { return link.first_radius + link.second_radius; }
    /** @throws base::InputError between a sphere and a wall: what glues to walls does not say where they lie */
    static void begin(const Constants &k, const NewLink &link, double *numbers);
    static void begin_rows(const Constants &k, const NewLink &link, int m, double *numbers, double *rows);

    template <typename K, typename T, int m>
    BRECCIA_KERNEL static LinkForce<T, m>
    update(const K &k, const LinkMotion<T, m> &motion, State<T, m> &state, LinkWork<T> &work);

    template <typename S>
    BRECCIA_KERNEL static unsigned changes_numbers(const S &before, const S &after)
    {
      const bool breaks = any(after.number[bonded] < before.number[bonded]);
      const bool moves  = any(after.number[installed] > before.number[installed]) ||
                         any(after.number[installed] < before.number[installed]);
      constexpr unsigned always   = 1u << slip_1 | 1u << turn_2;
      constexpr unsigned in_space = 1u << twist | 1u << slip_2 | 1u << turn_1;
      return always | (S::axes > 0 ? in_space : 0u) | (breaks ? 1u << bonded : 0u) | (moves ? 1u << installed : 0u);
    }

    template <typename S>
    static LinkStiffnesses stiffness(const Constants &k, const LinkGeometry &link, const S &state);
    template <typename S>
    static LinkStiffnesses damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state);
    template <typename S>
    static LinkPhase phase(const Constants &k, const LinkGeometry &link, const S &state);
    template <typename S>
    static std::vector<BrokenElement> broken_elements(const Constants &k, const LinkGeometry &link, const S &state);
    template <typename S>
    static double stored(const Constants &k, const LinkGeometry &link, const S &state);
    template <typename S>
    static LinkLoss damage(const Constants &k, const LinkGeometry &, const S &state)
    {
      const double lost = state.rows.get(broken) / k.layout->size();
      return {lost, lost};
    }
    template <typename S>
    static LinkExertion
    exertion(const Constants &k, const LinkGeometry &link, const S &state, double normal, double shear);
    static base::Matrix6 tangent(const Constants        &k,
                                 const LinkStep         &step,
                                 const State<double, 3> &before,
                                 const State<double, 3> &after,
                                 LinkTangent             kind);
  };

  /** Flat joints as a scene chooses them; contacts born later are linear. */
  struct FlatJointLaw
  {
    using Parameters = FlatJointParameters;

    static constexpr const char *name    = "flat-joint";
    static constexpr const char *meaning = "Flat joint: a flat surface of elements that break one by one, push and "
                                           "slide with friction; resists rotation when "
                                           "broken";
    static constexpr bool        touches_only = false;

    /**
     * Means of all constants, and of the angles of friction.
     * @throws base::InputError where elements, fractions or seeds of the two differ
     */
    static FlatJointParameters mean_of(const Material<FlatJointParameters> &one,
                                       const Material<FlatJointParameters> &other);
    static void                check(const FlatJointParameters &parameters) { FlatJointConstants(parameters, 3); }
    static std::shared_ptr<const LinkLaw>
    bonds(const std::vector<FlatJointParameters> &pairs, const Physics &physics, int vector_dimension);
    static std::shared_ptr<const LinkLaw>
    contacts(const std::vector<FlatJointParameters> &pairs, const Physics &physics, int vector_dimension);

    template <typename Number, typename Choice>
    static void describe(FlatJointParameters &p, Number &&number, Choice &&choice)
    {
      constexpr double smallest  = std::numeric_limits<double>::min();
      constexpr double largest   = std::numeric_limits<double>::max();
      constexpr double unlimited = std::numeric_limits<double>::infinity(); // what nothing breaks
      number("Effective modulus", p.effective_modulus, "Pa",
             "E* of the joint: stiffness per area is E* over the sum of radii", smallest, largest, true);
      number("Stiffness ratio", p.stiffness_ratio, "-", "k_n/k_s of the joint", smallest, largest, false);
      number("Friction coefficient", p.friction_coefficient, "-",
             "mu of elements that are not bonded, and of linear contacts", 0.0, largest, false);
      number("Tensile strength", p.tensile_strength, "Pa", "sigma_c, tension at its middle that breaks an element", 0.0,
             unlimited, true);
      number("Cohesion", p.cohesion, "Pa", "c, shear stress that breaks an element without normal stress", 0.0,
             unlimited, true);
      number("Friction angle", p.friction_angle, "degrees",
             "phi, growth of an element's shear strength with compression", 0.0, 89.9, false);
      number("Radius multiplier", p.radius_multiplier, "-",
             "lambda, radius of the joint over that of the smaller particle", smallest, largest, false);
      number("Elements", p.elements, "-", "of a joint between discs, a whole number", 1.0, 64.0, false);
      number("Rings", p.rings, "-", "of a joint between spheres, a whole number", 1.0, 16.0, false);
      number("Sectors", p.sectors, "-", "of each ring, a whole number", 3.0, 64.0, false);
      choice(
        "Own moments", p.own_moments, {{"yes", true}, {"no", false}},
        "whether bonded elements of a joint between spheres resist bending about their own middles, too, which makes "
        "the joint as stiff as a disk");
      number("Contact effective modulus", p.contact_effective_modulus, "Pa",
             "E* of the linear contact between particles that no joint holds any more; 0: that of the joint", 0.0,
             largest, false);
      number("Contact stiffness ratio", p.contact_stiffness_ratio, "-", "k_n/k_s of that contact; 0: that of the joint",
             0.0, largest, false);
      number("Gapped fraction", p.gapped_fraction, "-", "of the joints that are made unbonded with a gap", 0.0, 1.0,
             false);
      number("Slit fraction", p.slit_fraction, "-", "of the joints that are made unbonded without a gap", 0.0, 1.0,
             false);
      number("Mean gap", p.mean_gap, "m", "of gapped joints", 0.0, largest, false);
      number("Gap deviation", p.gap_deviation, "m", "standard deviation of their gaps, of which none is below zero",
             0.0, largest, false);
      number("Seed", p.seed, "-", "of the choice which joints are gapped and slit, a whole number", 0.0, 1e15, false);
    }
  };
} // namespace dem

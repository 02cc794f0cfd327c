#include "dem/laws/flat_joint.h"

#include "base/errors.h"
#include "dem/core/uniform_random.h"
#include "dem/laws/flat_joint_update.h"
#include "dem/laws/requirements.h"

#include <cmath>

namespace dem
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /** Of the modulus: stresses below are rounding, and break nothing that has no strength. */
    constexpr double no_stress = 1e-12;
    /** A strength is reached this much below it: a path that ends on it breaks. */
    constexpr double reached = 1 - 1e-12;

    constexpr Requirements require("flat-joint");

    bool whole_number(const double value, const double lower, const double upper)
    {
      return value >= lower && value <= upper && value == std::floor(value);
    }

    void check_strength(const FlatJointParameters &p)
    {
      require(p.effective_modulus > 0, "Effective modulus", p.effective_modulus, "must be above 0 Pa.");
      require(p.stiffness_ratio > 0, "Stiffness ratio", p.stiffness_ratio, "must be above 0.");
      require(p.friction_coefficient >= 0, "Friction coefficient", p.friction_coefficient, "must not be negative.");
      require.strength("Tensile strength", p.tensile_strength);
      require.strength("Cohesion", p.cohesion);
      require(p.friction_angle >= 0 && p.friction_angle < 90, "Friction angle", p.friction_angle,
              "must lie in [0, 90) degrees.");
      require(p.radius_multiplier > 0, "Radius multiplier", p.radius_multiplier, "must be above 0.");
      require(p.contact_effective_modulus >= 0, "Contact effective modulus", p.contact_effective_modulus,
              "must not be negative; 0 stands for that of the joint.");
      require(p.contact_stiffness_ratio >= 0, "Contact stiffness ratio", p.contact_stiffness_ratio,
              "must not be negative; 0 stands for that of the joint.");
    }

    void check_structure(const FlatJointParameters &p)
    {
      require(whole_number(p.elements, 1, 64), "Elements", p.elements, "must be a whole number from 1 to 64.");
      require(whole_number(p.rings, 1, 16), "Rings", p.rings, "must be a whole number from 1 to 16.");
      require(whole_number(p.sectors, 3, 64), "Sectors", p.sectors, "must be a whole number from 3 to 64.");
      require(p.gapped_fraction >= 0 && p.gapped_fraction <= 1, "Gapped fraction", p.gapped_fraction,
              "must lie in [0, 1].");
      require(p.slit_fraction >= 0 && p.slit_fraction <= 1, "Slit fraction", p.slit_fraction, "must lie in [0, 1].");
      require(p.gapped_fraction + p.slit_fraction <= 1, "Slit fraction", p.slit_fraction,
              "and Gapped fraction together must not be above 1.");
      require(p.mean_gap >= 0, "Mean gap", p.mean_gap, "must not be negative.");
      require(p.gap_deviation >= 0, "Gap deviation", p.gap_deviation, "must not be negative.");
      require(p.gapped_fraction == 0 || p.mean_gap > 0 || p.gap_deviation > 0, "Mean gap", p.mean_gap,
              "must be above 0 m where joints are gapped.");
      require(whole_number(p.seed, 0, 1e15), "Seed", p.seed, "must be a whole number from 0 to 1e15.");
    }

    /** Random numbers of a pair: by its particles alone, whichever is first. */
    UniformRandom random_of(const std::uint64_t seed, const NewLink &link)
    {
      const auto lower = static_cast<std::uint64_t>(std::min(link.first_number, link.second_number)),
                 upper = static_cast<std::uint64_t>(std::max(link.first_number, link.second_number));
      return UniformRandom(mixed(mixed(mixed(seed) + lower) + upper));
    }

    /** Normally distributed (Box and Muller, 1958), drawn again until it is above zero. */
    double drawn_gap(const FlatJointConstants &k, UniformRandom &random)
    {
      constexpr int most = 1000;
      for (int i = 0; i < most && k.gap_deviation > 0; ++i)
        {
          const double radius = std::sqrt(-2 * std::log(1 - random())), angle = 2 * pi * random();
          const double gap = k.mean_gap + k.gap_deviation * radius * std::cos(angle);
          if (gap > 0)
            return gap;
        }
      return k.mean_gap;
    }

    template <typename S>
    constexpr int dimension_of = S::axes > 0 ? 3 : 1;

    template <typename S>
    JointOpening<double, dimension_of<S>> opening_at(const LinkGeometry &link, const S &state)
    {
      return opening_of<dimension_of<S>>(state, link.strain, state.number[FlatJoint::radius] / link.reference);
    }

    template <typename S>
    int row_of(const int element)
    {
      return FlatJoint::elements + FlatJoint::row_width(dimension_of<S>) * element;
    }

    template <typename S>
    Vec<double, 2> slip_of_element(const S                                     &state,
                                   const int                                    element,
                                   const JointOpening<double, dimension_of<S>> &at,
                                   const FlatJointLayout                       &l)
    {
      const int row = row_of<S>(element);
      if (state.rows.get(row) < 0.5)
        return at.slip_at(l.elements[static_cast<std::size_t>(element)]);
      return {{state.rows.get(row + 1), dimension_of<S> == 3 ? state.rows.get(row + 2) : 0.0}};
    }

    /** Lowest gap of its elements' ends over the reference length. */
    template <int m>
    double lowest_gap(const FlatJointLayout &layout, const JointOpening<double, m> &at)
    {
      double lowest = std::numeric_limits<double>::infinity();
      for (const auto &e : layout.elements)
        lowest = std::min(lowest, at.gap_at(e) - layout.half_width * std::abs(at.b2));
      return lowest;
    }
  } // namespace

  LinearContactParameters FlatJointParameters::contact() const
  {
    return {contact_effective_modulus > 0 ? contact_effective_modulus : effective_modulus,
            contact_stiffness_ratio > 0 ? contact_stiffness_ratio : stiffness_ratio, friction_coefficient};
  }

  FlatJointConstants::FlatJointConstants(const FlatJointParameters &p, const int dimension)
  {
    check_strength(p);
    check_structure(p);
    owned_layout = std::make_shared<const FlatJointLayout>(
      dimension == 3 ? disk_layout(static_cast<int>(p.rings), static_cast<int>(p.sectors), p.own_moments) :
                       segment_layout(static_cast<int>(p.elements)));
    layout = owned_layout.get();

    friction          = p.friction_coefficient;
    joint_normal      = p.effective_modulus;
    joint_shear       = p.effective_modulus / p.stiffness_ratio;
    tensile_strength  = std::max(reached * p.tensile_strength, no_stress * joint_normal);
    cohesion          = std::max(reached * p.cohesion, no_stress * joint_normal);
    tan_angle         = std::tan(p.friction_angle * pi / 180);
    area_factor       = dimension == 3 ? p.radius_multiplier * p.radius_multiplier : p.radius_multiplier;
    normal            = area_factor * joint_normal;
    shear             = area_factor * joint_shear;
    bending_modulus   = area_factor * layout->second_moment() * joint_normal;
    twisting_modulus  = dimension == 3 ? area_factor * layout->polar_moment() * joint_shear : 0.0;
    radius_multiplier = p.radius_multiplier;
    gapped_fraction   = p.gapped_fraction;
    slit_fraction     = p.slit_fraction;
    mean_gap          = p.mean_gap;
    gap_deviation     = p.gap_deviation;
    seed              = static_cast<std::uint64_t>(p.seed);
  }

  std::vector<LinkQuantity> FlatJoint::history()
  {
    return {{"bonded_elements", "-", "number of elements that are bonded", true},
            {"installed_strain", "-", "strain at which the gap of the surfaces is zero"},
            {"joint_radius", "m", "radius of the joint"},
            {"twist", "rad", "relative rotation about the link since the joint was made"},
            {"slip_1", "-", "tangential displacement since then over the reference length, along axis 1"},
            {"turn_2", "rad", "relative rotation since then about axis 2; in the plane, about z"},
            {"slip_2", "-", "tangential displacement along axis 2"},
            {"turn_1", "rad", "relative rotation about axis 1"},
            {"axis", "-", "axis 1 of the elements; axis 2 is n x axis 1"}};
  }

  std::vector<LinkQuantity> FlatJoint::rows(const Constants &k, const int m)
  {
    std::vector<LinkQuantity> all = {{"broken", "-", "number of elements that broke"},
                                     {"replaced", "-", "1: slid over its length, a linear contact stands in its place"},
                                     {"initial_gap", "-", "of a gapped joint, over the reference length"}};
    for (int e = 1; e <= k.layout->size(); ++e)
      {
        const std::string element = "element_" + std::to_string(e);
        all.push_back(
          {element + "_state", "-", "0: bonded; broken in 1: tension, 2: shear; 3: gapped, 4: slit from the start"});
        for (int c = 1; c < row_width(m); ++c)
          all.push_back({element + "_slip_" + std::to_string(c), "-",
                         "elastic slip over the reference length of an element that is not bonded"});
      }
    return all;
  }

  void FlatJoint::begin(const Constants &k, const NewLink &link, double *numbers)
  {
    if (link.second_radius == 0 && link.thickness == 0)
      throw base::InputError("flat-joint: glues discs to walls, not spheres; take parallel-bond for a wall in space.");
    const double reference = reference_length(link);
    numbers[bonded]        = k.layout->size();
    numbers[installed]     = (link.distance - reference) / reference;
    // A joint to a face has one particle only.
    const double smaller = link.second_radius > 0 ? std::min(link.first_radius, link.second_radius) : link.first_radius;
    numbers[radius]      = k.radius_multiplier * smaller;
  }

  void FlatJoint::begin_rows(const Constants &k, const NewLink &link, const int m, double *numbers, double *row)
  {
    if (k.gapped_fraction + k.slit_fraction == 0)
      return;
    UniformRandom random = random_of(k.seed, link);
    const double  lot    = random();
    if (lot >= k.gapped_fraction + k.slit_fraction)
      return;
    const bool gap  = lot < k.gapped_fraction;
    numbers[bonded] = 0;
    for (int e = 0; e < k.layout->size(); ++e)
      row[elements + row_width(m) * e] = gap ? gapped : slit;
    if (gap)
      row[initial_gap] = drawn_gap(k, random) / reference_length(link);
    numbers[installed] -= row[initial_gap];
  }

  template <typename S>
  LinkStiffnesses FlatJoint::stiffness(const Constants &k, const LinkGeometry &link, const S &state)
  {
    if (state.rows.get(replaced) > 0.5)
      return {k.normal, k.shear, 0, 0};
    const double section = link.area * state.number[radius] * state.number[radius] / link.reference;
    return {k.area_factor * k.joint_normal, k.area_factor * k.joint_shear, section * k.bending_modulus,
            section * k.twisting_modulus};
  }

  template <typename S>
  LinkStiffnesses FlatJoint::damaged_stiffness(const Constants &k, const LinkGeometry &link, const S &state)
  {
    const LinkStiffnesses all = stiffness(k, link, state);
    if (state.rows.get(replaced) > 0.5)
      return link.strain < state.number[installed] ? all : LinkStiffnesses{};
    const auto at   = opening_at(link, state);
    double     left = 0;
    for (int e = 0; e < k.layout->size(); ++e)
      if (state.rows.get(row_of<S>(e)) < 0.5 || at.gap_at(k.layout->elements[static_cast<std::size_t>(e)]) < 0)
        left += k.layout->elements[static_cast<std::size_t>(e)].share;
    return {left * all.normal, left * all.shear, left * all.bending, left * all.twist};
  }

  template <typename S>
  LinkPhase FlatJoint::phase(const Constants &k, const LinkGeometry &link, const S &state)
  {
    if (state.number[bonded] > 0.5)
      return LinkPhase::whole;
    const bool apart = link.strain > joint_reach<double>(state);
    if (state.rows.get(replaced) > 0.5)
      return apart ? LinkPhase::gone : LinkPhase::broken;
    if (apart && lowest_gap(*k.layout, opening_at(link, state)) >= 0)
      return LinkPhase::gone;
    return state.rows.get(broken) > 0.5 ? LinkPhase::broken : LinkPhase::whole;
  }

  template <typename S>
  std::vector<BrokenElement> FlatJoint::broken_elements(const Constants &k, const LinkGeometry &, const S &state)
  {
    std::vector<BrokenElement> found;
    for (int e = 0; e < k.layout->size(); ++e)
      {
        const double is = state.rows.get(row_of<S>(e));
        if (is < 0.5 * (holds + torn) || is > 0.5 * (sheared + gapped))
          continue;
        const FlatJointLayout::Element &element = k.layout->elements[static_cast<std::size_t>(e)];
        const double                    wide    = state.number[radius];
        found.push_back({e,
                         is < 0.5 * (torn + sheared) ? BreakMode::tension : BreakMode::shear,
                         {wide * element.x1, wide * element.x2, 0},
                         k.area_factor * element.share});
      }
    return found;
  }

  template <typename S>
  double FlatJoint::stored(const Constants &k, const LinkGeometry &link, const S &state)
  {
    const auto   at     = opening_at(link, state);
    const double volume = link.area * link.reference;
    if (state.rows.get(replaced) > 0.5)
      {
        const double overlap = std::min(at.gap, 0.0);
        const int    first   = elements + 1;
        const double slip_2  = dimension_of<S> == 3 ? state.rows.get(first + 1) : 0.0;
        return 0.5 * volume *
               (k.normal * overlap * overlap +
                k.shear * (state.rows.get(first) * state.rows.get(first) + slip_2 * slip_2));
      }
    double sum = 0;
    for (int e = 0; e < k.layout->size(); ++e)
      {
        const auto          &element = k.layout->elements[static_cast<std::size_t>(e)];
        const bool           holding = state.rows.get(row_of<S>(e)) < 0.5;
        const Vec<double, 2> slip    = slip_of_element(state, e, at, *k.layout);
        const double push = holding ? bonded_push(element, at).energy : free_push(*k.layout, element, at).energy;
        sum += element.share * (k.joint_normal * push + 0.5 * k.joint_shear * dot(slip, slip));
      }
    return volume * k.area_factor * sum;
  }

  template <typename S>
  LinkExertion
  FlatJoint::exertion(const Constants &k, const LinkGeometry &link, const S &state, const double, const double)
  {
    if (state.number[bonded] < 0.5)
      return {std::numeric_limits<double>::infinity(), 0};
    const auto at    = opening_at(link, state);
    double     worst = 0;
    for (int e = 0; e < k.layout->size(); ++e)
      if (state.rows.get(row_of<S>(e)) < 0.5)
        {
          const auto          &element = k.layout->elements[static_cast<std::size_t>(e)];
          const double         stress  = k.joint_normal * at.gap_at(element);
          const Vec<double, 2> slip    = at.slip_at(element);
          const double         limit   = std::max(k.cohesion - stress * k.tan_angle, 0.0);
          worst = std::max({worst, stress / k.tensile_strength, k.joint_shear * std::sqrt(dot(slip, slip)) / limit});
        }
    return {worst, 0};
  }

  namespace
  {
    using Vector5  = Eigen::Matrix<double, 5, 1>;
    using Matrix5  = Eigen::Matrix<double, 5, 5>;
    using Matrix56 = Eigen::Matrix<double, 5, 6>;

    /** Derivative of stress and own moments of an unbonded segment element, by gap and bend about axis 2, over the modulus. */
    Eigen::Matrix2d free_segment_stiffness(const double gap, const double b2, const double half)
    {
      const double    bend = half * std::abs(b2);
      Eigen::Matrix2d k    = Eigen::Matrix2d::Zero();
      if (gap - bend >= 0)
        return k;
      const double part   = gap + bend <= 0 ? 1.0 : (bend - gap) / (2 * bend);
      const double middle = (b2 > 0 ? 1.0 : -1.0) * half * (1 - part); // of the closed part
      k << 1, -middle, -middle, middle * middle + half * half * part * part / 3;
      return part * k;
    }

    /** Of one element: of (gap, slip 1, slip 2, bend 1, bend 2) [Pa]. */
    struct ElementTangent
    {
      const FlatJointConstants       &k;
      const FlatJointLayout::Element &e;
      const JointOpening<double, 3>  &at;
      LinkTangent                     kind;

      Matrix5 bonded() const
      {
        Matrix5 d = Matrix5::Zero();
        d.diagonal() << k.joint_normal, k.joint_shear, k.joint_shear, e.own * k.joint_normal, e.own * k.joint_normal;
        return d;
      }

      /** @param trial slip before it slides */
      Matrix5 loose(const Vec<double, 2> &trial) const
      {
        constexpr double open = 1e-6, slack = 1e-3; // what a secant keeps of them
        const double     half = k.layout->half_width;
        Eigen::Matrix2d  push = Eigen::Matrix2d::Zero();
        if (half > 0)
          push = free_segment_stiffness(at.gap_at(e), at.b2, half);
        else
          push(0, 0) = at.gap_at(e) < 0 ? 1.0 : 0.0;
        const ElementPush<double> pushed = free_push(*k.layout, e, at);
        const double              cap    = -k.friction * k.joint_normal * pushed.stress,
                     size                = k.joint_shear * std::sqrt(dot(trial, trial));
        const bool slides                = size > cap && size > 0;
        Matrix5    d                     = Matrix5::Zero();
        if (kind.secant)
          {
            d.diagonal() << std::max(push(0, 0), open) * k.joint_normal,
              Eigen::Vector2d::Constant((slides ? std::max(cap / size, slack) : 1.0) * k.joint_shear), 0.0,
              std::max(push(1, 1), open * e.own) * k.joint_normal;
            return d;
          }
        d(0, 0) = k.joint_normal * push(0, 0);
        d(0, 4) = d(4, 0) = k.joint_normal * push(0, 1);
        d(4, 4)           = k.joint_normal * push(1, 1);
        if (!slides)
          {
            if (cap > 0 || size > 0)
              d(1, 1) = d(2, 2) = k.joint_shear;
            else
              d(1, 1) = d(2, 2) = pushed.stress < 0 && k.friction > 0 ? k.joint_shear : 0.0;
            return d;
          }
        const Eigen::Vector2d t(k.joint_shear / size * trial[0], k.joint_shear / size * trial[1]);
        d.block<2, 2>(1, 1) = cap / size * k.joint_shear * (Eigen::Matrix2d::Identity() - t * t.transpose());
        d.block<2, 1>(1, 0) = -k.friction * d(0, 0) * t;
        d.block<2, 1>(1, 4) = -k.friction * d(0, 4) * t;
        return d;
      }
    };
  } // namespace

  base::Matrix6 FlatJoint::tangent(const Constants        &k,
                                   const LinkStep         &step,
                                   const State<double, 3> &before,
                                   const State<double, 3> &after,
                                   const LinkTangent       kind)
  {
    const Eigen::Vector3d n      = step.direction, e1(after.axis[0][0], after.axis[0][1], after.axis[0][2]),
                          e2     = n.cross(e1);
    const double         per     = after.number[radius] / step.geometry.reference;
    const Vec<double, 2> slipped = {{e1.dot(step.shear_increment), e2.dot(step.shear_increment)}};
    base::Matrix6        all     = base::Matrix6::Zero();
    if (before.rows.get(replaced) > 0.5)
      {
        const Eigen::Vector3d trial =
          (before.rows.get(elements + 1) + slipped[0]) * e1 + (before.rows.get(elements + 2) + slipped[1]) * e2;
        all.topLeftCorner<3, 3>() =
          linear_contact_tangent(LinearContactConstants({k.normal, k.normal / k.shear, k.friction}), n,
                                 step.geometry.strain - before.number[installed], trial, kind);
        return all;
      }
    // The gap of this step, also where a linear contact has taken over at its end.
    JointOpening<double, 3> at = opening_of<3>(after, step.geometry.strain, per);
    at.gap                     = step.geometry.strain - before.number[installed];
    for (int e = 0; e < k.layout->size(); ++e)
      {
        const auto &element = k.layout->elements[static_cast<std::size_t>(e)];
        Matrix56    B       = Matrix56::Zero();
        B.row(0) << n.transpose(), per * (element.x2 * e1 - element.x1 * e2).transpose();
        B.row(1) << e1.transpose(), -per * element.x2 * n.transpose();
        B.row(2) << e2.transpose(), per * element.x1 * n.transpose();
        B.row(3).tail<3>() = per * e1.transpose();
        B.row(4).tail<3>() = per * e2.transpose();

        const ElementTangent of{k, element, at, kind};
        const int            row = elements + row_width(3) * e;
        Matrix5              d;
        if (after.rows.get(row) < 0.5)
          d = of.bonded();
        else if (before.rows.get(row) < 0.5)
          d = of.loose(at.slip_at(element)); // it broke in this step
        else
          {
            const double twisted = per * step.twist_increment;
            d                    = of.loose({{before.rows.get(row + 1) + slipped[0] - element.x2 * twisted,
                                              before.rows.get(row + 2) + slipped[1] + element.x1 * twisted}});
          }
        all += k.area_factor * element.share * B.transpose() * d * B;
      }
    all.bottomRows<3>() *= step.geometry.area * step.geometry.reference;
    return all;
  }

  FlatJointParameters FlatJointLaw::mean_of(const Material<FlatJointParameters> &one,
                                            const Material<FlatJointParameters> &other)
  {
    const FlatJointParameters &a = one.parameters, &b = other.parameters;
    const auto                 same = [&](const char *entry, const double first, const double second) {
      if (first != second)
        throw base::InputError(std::string("flat-joint/") + entry + " of the materials " + one.name + " and " +
                                               other.name + ": must be the same.");
    };
    same("Elements", a.elements, b.elements);
    same("Rings", a.rings, b.rings);
    same("Sectors", a.sectors, b.sectors);
    same("Own moments", a.own_moments, b.own_moments);
    same("Seed", a.seed, b.seed);
    const LinearContactParameters born_a = a.contact(), born_b = b.contact();
    FlatJointParameters           between = a;
    between.effective_modulus             = mean(a.effective_modulus, b.effective_modulus);
    between.stiffness_ratio               = mean(a.stiffness_ratio, b.stiffness_ratio);
    between.friction_coefficient          = mean_friction(a.friction_coefficient, b.friction_coefficient);
    between.tensile_strength              = mean(a.tensile_strength, b.tensile_strength);
    between.cohesion                      = mean(a.cohesion, b.cohesion);
    between.friction_angle                = mean(a.friction_angle, b.friction_angle);
    between.radius_multiplier             = mean(a.radius_multiplier, b.radius_multiplier);
    between.contact_effective_modulus     = mean(born_a.effective_modulus, born_b.effective_modulus);
    between.contact_stiffness_ratio       = mean(born_a.stiffness_ratio, born_b.stiffness_ratio);
    between.gapped_fraction               = mean(a.gapped_fraction, b.gapped_fraction);
    between.slit_fraction                 = mean(a.slit_fraction, b.slit_fraction);
    between.mean_gap                      = mean(a.mean_gap, b.mean_gap);
    between.gap_deviation                 = mean(a.gap_deviation, b.gap_deviation);
    return between;
  }

  std::shared_ptr<const LinkLaw>
  FlatJointLaw::bonds(const std::vector<FlatJointParameters> &pairs, const Physics &physics, const int vector_dimension)
  {
    std::vector<FlatJointConstants> constants;
    for (const FlatJointParameters &p : pairs)
      {
        constants.emplace_back(p, physics.dimension);
        if (!physics.damage)
          constants.back().tensile_strength = constants.back().cohesion = std::numeric_limits<double>::infinity();
      }
    return std::make_shared<LinkLawOf<FlatJoint>>(std::move(constants), vector_dimension, physics.rotations);
  }

  std::shared_ptr<const LinkLaw> FlatJointLaw::contacts(const std::vector<FlatJointParameters> &pairs,
                                                        const Physics                          &physics,
                                                        const int                               vector_dimension)
  {
    std::vector<LinearContactParameters> linear;
    for (const FlatJointParameters &p : pairs)
      linear.push_back(p.contact());
    return LinearContactLaw::contacts(linear, physics, vector_dimension);
  }
} // namespace dem

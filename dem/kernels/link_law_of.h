#pragma once

#include "base/column.h"
#include "dem/kernels/element_rows.h"
#include "dem/kernels/link_law_defaults.h"
#include "dem/kernels/link_update_types.h"
#include "dem/model/link_law.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace dem
{
  /** The passes of a law, compiled where dem/kernels/link_update.h is included. */
  template <typename Law>
  LinkPass link_pass_in_plane(bool rotations, Mixture mixture);
  template <typename Law>
  LinkPass link_pass_in_space(bool rotations, Mixture mixture);

  /**
   * Makes of a law, as it is written in its own file, the LinkLaw that all other code works with.
   *
   * `Law` is a type without data, derived from LinkLawDefaults. doc/theory/link-laws.md says what it declares:
   *
   *   name, bonds, moment, breaks_in_place, records                 constants
   *   waits, viscous, stiffens                                      constants, where they hold (LinkLawTraits)
   *   directed                                                      constant: the motion tells the direction of the link
   *   damping_ratio(constants)                                      of a viscous law
   *   rate_dependent(constants)                                     of a viscous law, where its force does so without a dashpot
   *   resting_shear, acts(state, strain)                            place of a shear vector that stays zero while acts() is false,
   *                                                                 for laws with a moment: it is neither turned nor written then
   *   Constants, State<T, m>                                        types; State is a LinkState
   *   has_rows, rows(constants, m), rows_of(constants, m), begin_rows(constants, link, m, numbers, rows)
   *                                                                 for laws that remember further numbers, as many as the
   *                                                                 constants say: quantities, their number, and those of a new
   *                                                                 link; the State has them as ElementRows<T> rows
   *   tells_elements, broken_elements(constants, geometry, state)   for laws that report how a bond, or which of its elements, broke:
   *                                                                 offsets along axis 1 and axis 2 = n x axis 1 of the link
   *   history()                                                     quantities of numbers (those in space, of which links in the
   *                                                                 plane may have only the first), shears, bendings, axes
   *   put(constants, record), gathered(packs, first)                constants as numbers in records of eight, and back as packs
   *   reference_length(link), begin(constants, link, numbers)       a new link
   *   update(constants, motion, state, work)                        one step, for double and for Pack
   *   changes_numbers(before, state)                                which numbers of the state must be stored, a bit for each
   *   stiffness, damaged_stiffness, phase, stored, damage_dissipation, damage, exertion(constants, geometry, state, ...),
   *   damaging_strain(constants, state)                             queries of single links
   *   tangent(constants, step, before, state, kind)                 linearisation of the update
   */
  template <typename Law>
  class LinkLawOf final : public LinkLaw
  {
  public:
    using Constants = typename Law::Constants;

    /**
     * @param of_pairs constants of every pair of materials, in the order of material_pair(), at least one
     * @param vector_dimension of the vectors across the link in the histories: 3, or 2 for links in the plane with one component
     */
    LinkLawOf(std::vector<Constants> of_pairs, const int vector_dimension, const bool particles_rotate)
      : LinkLaw(traits_of(of_pairs, vector_dimension, particles_rotate))
      , all(std::move(of_pairs))
      , dimension(vector_dimension)
      , rotations(particles_rotate)
      , table(record * all.size(), 0.0)
    {
      for (std::size_t l = 0; l < all.size(); ++l)
        Law::put(all[l], &table[record * l]);
    }

    const Constants &constants(const std::size_t pair) const { return all[pair]; }
    const double    *record_of(const std::size_t pair) const { return &table[record * pair]; }

    LinkPass pass(const Mixture mixture) const override
    {
      return (dimension == 3 ? link_pass_in_space<Law> : link_pass_in_plane<Law>)(rotations, mixture);
    }

    std::vector<LinkQuantity> columns() const override
    {
      using S                          = typename Law::template State<double, 3>;
      using InPlane                    = typename Law::template State<double, 1>;
      const auto                given  = Law::history();
      const int                 across = dimension == 3 ? 3 : 1;
      std::vector<LinkQuantity> all_columns;
      for (int i = 0; i < (dimension == 3 ? S::numbers : InPlane::numbers); ++i)
        all_columns.push_back(given[static_cast<std::size_t>(i)]);
      const int vectors = S::shears + S::bendings + (dimension == 3 ? S::axes : InPlane::axes);
      for (int i = 0; i < vectors; ++i)
        for (int c = 0; c < across; ++c)
          {
            LinkQuantity quantity = given[static_cast<std::size_t>(S::numbers + i)];
            quantity.name += "_" + std::to_string(c);
            all_columns.push_back(std::move(quantity));
          }
      if constexpr (Law::has_rows)
        for (const LinkQuantity &quantity : Law::rows(all.front(), across))
          all_columns.push_back(quantity);
      return all_columns;
    }

    double reference_length(std::size_t, const NewLink &link) const override { return Law::reference_length(link); }
    void   begin(const std::size_t pair, const NewLink &link, double *history) const override
    {
      Law::begin(all[pair], link, history);
      if constexpr (SpaceState::axes > 0)
        if (dimension == 3)
          for (int i = 0; i < SpaceState::axes; ++i)
            put_axis(link, history + SpaceState::columns - 3 * (SpaceState::axes - i));
      if constexpr (Law::has_rows)
        Law::begin_rows(all[pair], link, dimension == 3 ? 3 : 1, history, history + columns_before_rows());
    }

    LinkStiffnesses stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::stiffness(all[pair], link, state); });
    }
    LinkStiffnesses
    damaged_stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::damaged_stiffness(all[pair], link, state); });
    }
    LinkPhase phase(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::phase(all[pair], link, state); });
    }
    std::vector<BrokenElement> broken_elements(const std::size_t      pair,
                                               const LinkGeometry    &link,
                                               const Eigen::Vector3d &direction,
                                               const double          *history) const override
    {
      if constexpr (Law::tells_elements)
        {
          auto found =
            with_state(history, [&](const auto &state) { return Law::broken_elements(all[pair], link, state); });
          const Eigen::Vector3d first = first_axis(direction, history), second = direction.cross(first);
          for (BrokenElement &broken : found)
            broken.offset = Eigen::Vector3d(broken.offset[0] * first + broken.offset[1] * second);
          return found;
        }
      else
        return phase(pair, link, history) == LinkPhase::whole ? std::vector<BrokenElement>() :
                                                                std::vector<BrokenElement>(1);
    }
    double stored(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::stored(all[pair], link, state); });
    }
    double damage_dissipation(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::damage_dissipation(all[pair], link, state); });
    }
    LinkLoss damage(const std::size_t pair, const LinkGeometry &link, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::damage(all[pair], link, state); });
    }
    double damaging_strain(const std::size_t pair, const double *history) const override
    {
      return with_state(history, [&](const auto &state) { return Law::damaging_strain(all[pair], state); });
    }
    LinkExertion exertion(const std::size_t      pair,
                          const LinkGeometry    &link,
                          const Eigen::Vector3d &direction,
                          const Eigen::Vector3d &force,
                          const double          *history) const override
    {
      const double normal = force.dot(direction), shear = (force - normal * direction).norm();
      return with_state(history,
                        [&](const auto &state) { return Law::exertion(all[pair], link, state, normal, shear); });
    }

    LinkAnswer
    update(const std::size_t pair, const LinkStep &step, const double *before, double *history) const override
    {
      require_space();
      SpaceState state = state_of<3>(before);
      if constexpr (Law::has_rows)
        {
          const std::size_t first = columns_before_rows();
          if (before != history)
            std::copy_n(before + first, Law::rows_of(all.front(), 3), history + first);
          state.rows = {history + first, history + first};
        }
      const LinkMotion<double, 3> motion = motion_of(step, state);
      LinkWork<double>            work;
      const auto                  answer = Law::update(all[pair], motion, state, work);
      LinkAnswer                  result;
      result.force    = answer.normal * step.direction + vector(answer.shear);
      result.friction = work.friction;
      result.damage   = work.damage;
      result.released = work.released;
      result.viscous  = work.viscous;
      result.slides   = answer.slides;
      if constexpr (Law::moment)
        result.moment = vector(answer.bending_moment) + answer.twisting_moment * step.direction;
      put_state<3>(state, history);
      return result;
    }

    base::Matrix6 tangent(const std::size_t pair,
                          const LinkStep   &step,
                          const double     *before,
                          const double     *history,
                          const LinkTangent kind) const override
    {
      require_space();
      return Law::tangent(all[pair], step, state_of<3>(before), state_of<3>(history), kind);
    }

  private:
    static constexpr std::size_t record = 8 * Law::records;
    using SpaceState                    = typename Law::template State<double, 3>;

    static LinkLawTraits
    traits_of(const std::vector<Constants> &of_pairs, const int vector_dimension, const bool particles_rotate)
    {
      LinkLawTraits traits;
      traits.name            = Law::name;
      traits.pairs           = of_pairs.size();
      traits.planar          = vector_dimension != 3;
      traits.has_moment      = Law::moment && particles_rotate;
      traits.breaks_in_place = Law::breaks_in_place;
      traits.bonds           = Law::bonds;
      traits.waits           = Law::waits;
      traits.stiffens        = Law::stiffens;
      if constexpr (Law::viscous)
        for (const Constants &k : of_pairs)
          {
            traits.damping_ratio.push_back(Law::damping_ratio(k));
            traits.rate_dependent = traits.rate_dependent || Law::rate_dependent(k);
          }
      return traits;
    }

    /** Across the link: in the plane n turned by +90 degrees; in space the same where that can be. */
    static void put_axis(const NewLink &link, double *axis)
    {
      Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(link.direction);
      if (across.norm() < 0.1)
        across = Eigen::Vector3d::UnitX().cross(link.direction);
      across.normalize();
      std::copy_n(across.data(), 3, axis);
    }

    /** Axis 1 of the elements: kept by the state, or in the plane n turned by +90 degrees. */
    Eigen::Vector3d first_axis(const Eigen::Vector3d &direction, const double *history) const
    {
      if constexpr (SpaceState::axes > 0)
        if (dimension == 3)
          return vector(state_of<3>(history).axis[0]);
      return {-direction[1], direction[0], 0};
    }

    std::size_t columns_before_rows() const
    {
      return static_cast<std::size_t>(dimension == 3 ? SpaceState::columns : Law::template State<double, 1>::columns);
    }

    static Eigen::Vector3d vector(const Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }

    void require_space() const
    {
      if (dimension != 3)
        throw std::logic_error("a link law of the plane was asked for a link in space");
    }

    template <int m>
    static auto state_of(const double *history)
    {
      typename Law::template State<double, m> state;
      for (int i = 0; i < state.numbers; ++i)
        state.number[i] = *history++;
      for (int i = 0; i < state.shears; ++i)
        for (int c = 0; c < m; ++c)
          state.shear[i][c] = *history++;
      for (int i = 0; i < state.bendings; ++i)
        for (int c = 0; c < m; ++c)
          state.bending[i][c] = *history++;
      for (int i = 0; i < state.axes; ++i)
        for (int c = 0; c < m; ++c)
          state.axis[i][c] = *history++;
      if constexpr (Law::has_rows)
        state.rows.from = history;
      return state;
    }

    template <int m>
    static void put_state(const typename Law::template State<double, m> &state, double *history)
    {
      for (int i = 0; i < state.numbers; ++i)
        *history++ = state.number[i];
      for (int i = 0; i < state.shears; ++i)
        for (int c = 0; c < m; ++c)
          *history++ = state.shear[i][c];
      for (int i = 0; i < state.bendings; ++i)
        for (int c = 0; c < m; ++c)
          *history++ = state.bending[i][c];
      for (int i = 0; i < state.axes; ++i)
        for (int c = 0; c < m; ++c)
          *history++ = state.axis[i][c];
    }

    /** Add the step's increments to the state, as the kernel does. */
    static LinkMotion<double, 3> motion_of(const LinkStep &step, SpaceState &state)
    {
      LinkMotion<double, 3> motion;
      motion.strain            = step.geometry.strain;
      motion.strain_before     = step.strain_before;
      motion.length            = step.geometry.length;
      motion.reference         = step.geometry.reference;
      motion.inverse_reference = 1.0 / step.geometry.reference;
      motion.area              = step.geometry.area;
      motion.per_second        = step.per_second;
      for (int c = 0; c < 3; ++c)
        motion.direction[c] = step.direction[c];
      motion.twist_increment = step.twist_increment;
      for (int c = 0; c < 3; ++c)
        {
          motion.shear_increment[c]   = step.shear_increment[c];
          motion.bending_increment[c] = step.bending_increment[c];
          if (step.carried)
            continue;
          for (int i = 0; i < state.shears; ++i)
            state.shear[i][c] += step.shear_increment[c];
          for (int i = 0; i < state.bendings; ++i)
            state.bending[i][c] += step.bending_increment[c];
        }
      return motion;
    }

    template <typename Use>
    auto with_state(const double *history, const Use &use) const
    {
      return dimension == 3 ? use(state_of<3>(history)) : use(state_of<1>(history));
    }

    std::vector<Constants> all;
    int                    dimension;
    bool                   rotations;
    base::Column           table;
  };
} // namespace dem

#pragma once

#include "fem/materials/element_extent.h"
#include "fem/materials/initial_state.h"

#include <string>
#include <type_traits>
#include <utility>

namespace fem
{
  namespace traits
  {
    template <template <typename> class Question, typename Law, typename = void>
    struct Answers : std::false_type
    {
    };
    template <template <typename> class Question, typename Law>
    struct Answers<Question, Law, std::void_t<Question<Law>>> : std::true_type
    {
    };

    template <typename Law>
    using InitialState = decltype(std::declval<const Law &>().initial_state(std::declval<const InitialPointState &>(),
                                                                            std::declval<const ElementExtent &>()));
    template <typename Law>
    using AveragingLength = decltype(std::declval<const Law &>().averaging_length());
    template <typename Law>
    using Stiffened = decltype(Law::take_stiffness(std::declval<typename Law::Parameters &>(),
                                                   std::declval<const base::Stiffness &>()));
    template <typename Law>
    using LargestElement = decltype(std::declval<const Law &>().largest_element_size());
    template <typename Law>
    using Checked = decltype(Law::check(std::declval<const typename Law::Parameters &>()));
    template <typename Law>
    using Numerical = decltype(Law::is_numerical(std::declval<const std::string &>()));
  }

  // What a material may offer beside what every one has (doc/theory/materials.md).

  /// Its answer depends on its history.
  template <typename Law>
  inline constexpr bool has_history = !std::is_empty_v<typename Law::State>;

  /// Can begin with a stress and damage from elsewhere: initial_state(given, element), uniaxial_strengths().
  template <typename Law>
  inline constexpr bool takes_initial_state = traits::Answers<traits::InitialState, Law>::value;

  /// May average what drives its damage over its neighbours: averaging_length(), averaging_factor(), flow(), damage().
  template <typename Law>
  inline constexpr bool averages = traits::Answers<traits::AveragingLength, Law>::value;

  /// Constants that are a stiffness, and may be given as one: take_stiffness(parameters, stiffness).
  template <typename Law>
  inline constexpr bool takes_stiffness = traits::Answers<traits::Stiffened, Law>::value;

  /// Softens by the size of its element, which must not be too wide: largest_element_size(), require_size(size).
  template <typename Law>
  inline constexpr bool softens_by_element = traits::Answers<traits::LargestElement, Law>::value;

  /// Refuses constants that only a slip of units explains: check(parameters).
  template <typename Law>
  inline constexpr bool has_check = traits::Answers<traits::Checked, Law>::value;

  /// Has constants of the mesh or of its algorithm: is_numerical(key).
  template <typename Law>
  inline constexpr bool has_numerical_constants = traits::Answers<traits::Numerical, Law>::value;
}

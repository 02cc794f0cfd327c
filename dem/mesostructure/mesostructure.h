#pragma once

#include "dem/mesostructure/inclusion.h"
#include "dem/model/packing.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dem
{
  /** Aggregates in a box of mortar: the geometry by which particles, finite elements and peridynamic nodes are of one or the other. */
  struct Mesostructure
  {
    std::vector<Inclusion> inclusions;                         ///< largest first
    Eigen::Vector3d        box      = Eigen::Vector3d::Zero(); ///< [0, box] [m]
    bool                   periodic = false;                   ///< repeats along each edge

    double content() const; ///< part of the box that is aggregate [-]
  };

  constexpr std::int32_t in_mortar = -1;

  /**
   * Number of the aggregate that each place lies in, of several the first, or in_mortar (doc/theory/mesostructure.md, 4).
   * @param places points of elements, or nodes [m] @param inset how deep inside each must lie at least [m]; empty: on the surface is inside
   */
  std::vector<std::int32_t> aggregates_at(const Mesostructure                &mesostructure,
                                          const std::vector<Eigen::Vector3d> &places,
                                          const std::vector<double>          &inset = {});

  /** The same of particles, whose centres lie in an aggregate by half their radius at least. */
  std::vector<std::int32_t> aggregates_of(const Mesostructure &mesostructure, const Packing &packing);

  /** What a link joins. */
  enum class LinkClass
  {
    mortar,
    aggregate, ///< both ends in the same one
    interface  ///< one end in an aggregate, or both in different ones
  };

  /** @param one,other numbers of the aggregates of the ends, or in_mortar */
  constexpr LinkClass link_class(const std::int32_t one, const std::int32_t other)
  {
    return one != other ? LinkClass::interface : one == in_mortar ? LinkClass::mortar : LinkClass::aggregate;
  }
} // namespace dem

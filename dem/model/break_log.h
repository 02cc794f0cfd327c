#pragma once

#include "base/column.h"
#include "base/state.h"
#include "dem/model/link_law.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace dem
{
  /** A bond, or an element of one, that broke. */
  struct Break
  {
    double                      time    = 0;      ///< [s]
    std::int64_t                step    = 0;      ///< after so many steps
    std::array<std::int32_t, 2> ends    = {0, 0}; ///< the second is -1 where the first was glued to a surface
    std::int32_t                surface = -1;     ///< that the first was glued to; -1: to a particle
    std::int32_t                image   = 0;      ///< of the second end, where links are periodic
    std::int32_t                pair    = 0;      ///< of materials
    std::int32_t                element = 0;      ///< of the bond, from 0
    BreakMode                   mode    = BreakMode::gradual;
    Eigen::Vector3d             place   = {0, 0, 0}; ///< middle of what broke [m]
    Eigen::Vector3d             normal  = {1, 0, 0}; ///< across it, from the first end to the second, or to the surface
    double                      area    = 0;         ///< of what broke [m^2]
  };

  /** Everything that broke, in the order of time and of the links; each element once. */
  class BreakLog
  {
  public:
    bool        knows(const Break &event) const { return known.count(key(event)) > 0; }
    void        add(const Break &event);
    std::size_t size() const { return names.size() / names_of_one; }
    /** By its place in the log. */
    Break at(std::size_t number) const;
    void  visit_state(base::StateVisitor &visitor);

  private:
    using Key = std::array<std::int32_t, 4>;

    static constexpr std::size_t names_of_one = 6, numbers_of_one = 9;

    /** Second end by one number: a particle, or a surface below zero. */
    static std::int32_t second(const Break &event) { return event.surface < 0 ? event.ends[1] : -1 - event.surface; }
    static Key          key(const Break &event) { return {event.ends[0], second(event), event.image, event.element}; }

    std::vector<std::int32_t> names;   ///< of each: ends (2), image, pair, element, mode
    base::Column              numbers; ///< of each: time, step, place (3), normal (3), area
    std::set<Key>             known;
  };
} // namespace dem

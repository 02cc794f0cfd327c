#pragma once

#include <functional>
#include <type_traits>
#include <vector>

namespace fem
{
  /// A column of a material's history: its name in files and to observers, and its role for code that knows no material by name.
  struct PointQuantity
  {
    enum class Kind
    {
      number,
      strain, ///< six components xx yy zz yz zx xy, engineering shears
      stress  ///< six components, shears as they are
    };
    enum class Role
    {
      other,
      damage,         ///< lost part of the stiffness, 0 to 1
      damage_driving, ///< variable that the damage grows with
      hardening,      ///< grows from 0 to 1 at the peak, and on beyond
      crack_opening   ///< [m]
    };
    enum class Shown
    {
      nowhere, ///< kept for the next step and in checkpoints only
      fields,  ///< also in ParaView files and point-test
      series,  ///< its largest value also in series.csv, as largest_<name>
      counted  ///< 0 or 1; the number of points with 1 also in series.csv, as points_<name>
    };

    const char *name;    ///< without blanks: "plastic_strain"
    const char *unit;    ///< "-": a pure number
    const char *meaning; ///< "": the name says it
    Kind        kind  = Kind::number;
    Role        role  = Role::other;
    Shown       shown = Shown::fields;

    int values() const { return kind == Kind::number ? 1 : 6; }
  };

  /// Called with each column of a point's history and its first value.
  using StateColumn = std::function<void(const PointQuantity &, double *)>;

  /// The columns of a material, in the order of its history.
  template <typename Law>
  std::vector<PointQuantity> quantities_of()
  {
    std::vector<PointQuantity> all;
    typename Law::State        state;
    Law::describe_state(state, [&](const PointQuantity &quantity, double *) { all.push_back(quantity); });
    return all;
  }
}

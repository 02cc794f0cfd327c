#pragma once

namespace fem
{
  /// Energy that is lost, by mechanism: of a point per volume [J/m^3], of a solid [J].
  struct Dissipation
  {
    double plasticity = 0; ///< work of the stresses on plastic strains
    double damage     = 0; ///< elastic energy that is released as stiffness is lost

    double total() const { return plasticity + damage; }

    void add(const Dissipation &other, const double volume = 1)
    {
      plasticity += volume * other.plasticity;
      damage += volume * other.damage;
    }
  };
}

#pragma once

#include "apps/bench/scene_variant.h"
#include "apps/runs/particles/model.h"

#include <cstddef>
#include <string>

namespace apps
{
  /** What a case of a bench of mortar found, and what it cost. */
  struct MortarRow
  {
    std::string study, value;
    std::size_t particles = 0, bonds = 0;
    double      strength = 0, modulus = 0; ///< [Pa]; NaN: not determined
    double      imbalance = 0;             ///< of the platens' forces before the peak [-]; NaN likewise
    double      balance   = 0;             ///< of energies
    double      growth = 0, cost = 0;      ///< processor time of genesis and of the test [s]
  };

  /** The scene of such a bench: kind particles, with genesis and uniaxial compression. @throws base::InputError for another one */
  const ParticlesModel &mortar_in(const CheckedScene &checked);

  /** Crush a specimen that has grown already. */
  MortarRow crush(const SceneVariant &variant, const ParticlesModel &model, const dem::Packing &packing);
} // namespace apps

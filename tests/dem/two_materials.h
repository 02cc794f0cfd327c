#pragma once

#include "clusters.h"
#include "dem/laws/cpm.h"

/** Specimens of two materials for tests. */
namespace cluster
{
  /** Mortar as the concrete of concrete_uniaxial.prm, aggregate 2.5 times as stiff and 5 times as strong, with another friction. */
  inline dem::CpmMaterials mortar_and_aggregate(const double aggregate_density = 0)
  {
    dem::CpmParameters aggregate = concrete();
    aggregate.normal_modulus *= 2.5;
    aggregate.limit_elastic_strain *= 2;
    aggregate.cohesion *= 5;
    aggregate.friction_coefficient = 1.2;
    return dem::CpmMaterials({{"mortar", concrete(), 0}, {"aggregate", aggregate, aggregate_density}});
  }

  /** Every particle's material by lot. */
  inline dem::Packing mixed(dem::Packing packing, const std::uint64_t seed)
  {
    dem::UniformRandom random(seed);
    for (std::size_t i = 0; i < packing.size(); ++i)
      packing.material.push_back(random() < 0.5 ? 0 : 1);
    return packing;
  }
} // namespace cluster

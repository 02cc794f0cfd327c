#pragma once

#include "clusters.h"
#include "dem/laws/contact_bond.h"
#include "dem/laws/cpm.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/parallel_bond.h"
#include "dem/model/materials.h"

/** Bonds that break early, of three laws. */
namespace weak_bonds
{
  inline dem::ParallelBondParameters parallel()
  {
    dem::ParallelBondParameters p;
    p.effective_modulus    = 10e9;
    p.stiffness_ratio      = 2.5;
    p.friction_coefficient = 0.3;
    p.tensile_strength     = 0.3e6;
    p.cohesion             = 0.9e6;
    return p;
  }

  inline dem::ContactBondParameters point()
  {
    dem::ContactBondParameters p;
    p.effective_modulus    = 5e9;
    p.stiffness_ratio      = 1.5;
    p.friction_coefficient = 0.2;
    p.tensile_strength     = 0.1e6;
    p.cohesion             = 0.4e6;
    return p;
  }

  inline dem::FlatJointParameters flat()
  {
    dem::FlatJointParameters p;
    p.effective_modulus    = 8e9;
    p.stiffness_ratio      = 2;
    p.friction_coefficient = 0.2;
    p.tensile_strength     = 0.2e6;
    p.cohesion             = 0.6e6;
    p.friction_angle       = 20;
    return p;
  }

  /** The cohesive particle model with all its options. */
  inline dem::CpmParameters with_options()
  {
    dem::CpmParameters p               = cluster::concrete();
    p.relative_ductility               = 5;
    p.shear_contribution               = 0.4;
    p.options.compression_yield_strain = -1.2e-4;
    p.options.strength_surface         = dem::StrengthSurface::logarithmic;
    p.options.damage_time              = 1e-6;
    p.options.damage_exponent          = 0.4;
    p.options.plastic_time             = 1e-6;
    p.options.plastic_exponent         = 0.3;
    p.options.prestress                = -1e6;
    return p;
  }

  /** Two materials of the same constants. */
  template <typename Parameters>
  dem::LinkMaterials twice(const Parameters &p)
  {
    return dem::Materials<Parameters>({{"mortar", p, 0}, {"grains", p, 0}});
  }
} // namespace weak_bonds

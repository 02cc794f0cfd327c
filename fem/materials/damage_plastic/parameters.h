#pragma once

#include "fem/materials/damage_plastic/softening_curve.h"
#include "fem/materials/response.h"

#include <string>

namespace fem
{
  /// Damage-plastic concrete. Defaults are those of Grassl and Jirasek (2006); a constant without one is required.
  struct DamagePlasticParameters
  {
    double young_modulus        = required;  ///< E [Pa]
    double poisson_ratio        = required;  ///< nu [-]
    double compressive_strength = required;  ///< f_c [Pa]
    double tensile_strength     = required;  ///< f_t [Pa]
    double crack_opening        = 0.0;       ///< w_f [m]; 0: from the fracture energy
    double fracture_energy      = 0.0;       ///< G_f = w_f f_t [J/m^2]; 0: from the crack opening
    double eccentricity         = 0.525;     ///< e [-]
    double initial_hardening    = 0.1;       ///< q_0 [-]
    double hardening_a          = 0.08;      ///< A_h [-]
    double hardening_b          = 0.003;     ///< B_h [-]
    double hardening_c          = 2.0;       ///< C_h [-]
    double hardening_d          = 1e-6;      ///< D_h [-]
    double softening            = 15.0;      ///< A_s [-]
    double dilation             = -0.85;     ///< D_f [-]
    double element_size         = 0.0;       ///< h_el [m]; 0: from the mesh
    double reference_size       = 0.0;       ///< h_ref [m]; 0: off
    double vertex_norm          = 1.0 / 3.0; ///< factor of (3.2); 1/9 reproduces older results
    double softening_exponent   = 1.0;       ///< n [-]: 1 exponential, above it flat at first and steep then
    double residual_share       = 0.0;       ///< r [-]: of the strength, lost more slowly than the rest
    double residual_stretch     = 20.0;      ///< b [-]: how much more slowly
    double nonlocal_length      = 0.0;       ///< radius over which kappa_D is averaged [m]; 0: each point for itself
    double nonlocal_factor      = 2.0;       ///< m [-]: the average counts m times, the point itself 1 - m times
    double largest_increment    = 2e-4;      ///< strain increment above which a step is divided [-]; 0: never divided

    /// w_f [m] from whichever of crack opening and fracture energy was given.
    double softening_opening() const
    {
      return crack_opening > 0 ? crack_opening : fracture_energy / tensile_strength / softening_curve().area();
    }

    SofteningCurve softening_curve() const { return {softening_exponent, residual_share, residual_stretch}; }

    double bulk() const { return young_modulus / (3 * (1 - 2 * poisson_ratio)); }

    double shear() const { return young_modulus / (2 * (1 + poisson_ratio)); }

    /// @throws base::InputError naming the first entry that breaks a rule.
    void validate() const;

    /// Constants of the mesh and of the algorithm, which leave the material what it is.
    static bool is_numerical(const std::string &key)
    {
      return key == "Element size" || key == "Reference size" || key == "Largest increment";
    }

    template <typename Number> // number(key, member, unit, meaning, lower bound, upper bound, required)
    static void describe(DamagePlasticParameters &p, Number &&number)
    {
      number("Young modulus", p.young_modulus, "Pa", "E", 1e-300, 1e300, true);
      number("Poisson ratio", p.poisson_ratio, "-", "nu", 0.0, 0.4999999, true);
      number("Compressive strength", p.compressive_strength, "Pa", "f_c, uniaxial", 1e-300, 1e300, true);
      number("Tensile strength", p.tensile_strength, "Pa", "f_t, uniaxial, below f_c", 1e-300, 1e300, true);
      number("Crack opening", p.crack_opening, "m", "w_f, unit of the softening curve; 0: from G_f", 0.0, 1e300, false);
      number("Fracture energy", p.fracture_energy, "J/m^2", "G_f, w_f f_t where softening is exponential; 0: from w_f",
             0.0, 1e300, false);
      number("Eccentricity", p.eccentricity, "-", "e, roundness of the deviatoric section", 0.5 + 1e-9, 1.0, false);
      number("Initial hardening", p.initial_hardening, "-", "q_0, first yield over strength", 1e-6, 1.0 - 1e-9, false);
      number("Hardening A", p.hardening_a, "-", "A_h, hardening ductility", 1e-300, 1e300, false);
      number("Hardening B", p.hardening_b, "-", "B_h, hardening ductility", 1e-300, 1e300, false);
      number("Hardening C", p.hardening_c, "-", "C_h, hardening ductility", 1e-300, 1e300, false);
      number("Hardening D", p.hardening_d, "-", "D_h, hardening ductility", 1e-300, 1e300, false);
      number("Softening A", p.softening, "-", "A_s, softening ductility in compression", 0.0, 1e300, false);
      number("Dilation", p.dilation, "-", "D_f, lateral over axial plastic strain, uniaxial compression", -0.9999,
             -0.5001, false);
      number("Element size", p.element_size, "m", "h_el; 0: from the mesh", 0.0, 1e300, false);
      number("Reference size", p.reference_size, "m", "h_ref, element size before localisation; 0: off", 0.0, 1e300,
             false);
      number("Vertex norm", p.vertex_norm, "-", "factor of the volumetric part in the vertex return", 1.0 / 9.0,
             1.0 / 3.0, false);
      number("Softening exponent", p.softening_exponent, "-",
             "n: strength left (1 - r) exp(-y^n) + r exp(-y/b) at the opening y w_f; 1: exponential", 1.0, 4.0, false);
      number("Residual share", p.residual_share, "-", "r, part of the strength that is lost slowly", 0.0, 0.9, false);
      number("Residual stretch", p.residual_stretch, "-", "b, how much more slowly", 1.0, 1e6, false);
      number("Nonlocal length", p.nonlocal_length, "m",
             "radius over which kappa_D of neighbouring points is averaged; 0: each point for itself", 0.0, 1e300,
             false);
      number("Nonlocal factor", p.nonlocal_factor, "-",
             "m: the average counts m times, the point itself 1 - m times; 1 leaves localised plastic flow free", 1.0,
             10.0, false);
      number("Largest increment", p.largest_increment, "-", "strain per sub-step; 0: a step is one sub-step", 0.0,
             1e300, false);
    }
  };
}

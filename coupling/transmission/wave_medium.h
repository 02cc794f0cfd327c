#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace coupling
{
  /** Particles that a wave runs through. Of regular ones speeds are known in closed form. */
  struct WaveMedium
  {
    enum class Lattice
    {
      chain, ///< a row of discs that move along it only
      strip, ///< hexagonal rows of discs between two lines of symmetry: an unbounded plane for waves along the rows
      plane, ///< hexagonal rows of discs, as many as a narrow packet of any direction needs
      bar    ///< spheres without any order, in a bar
    };

    Lattice      lattice = Lattice::chain;
    double       spacing = 1; ///< a, of neighbours; diameter of the spheres [m]
    double       modulus = 1; ///< of the links, on average [Pa]
    double       scatter = 0; ///< of regular particles' links: evenly between 1 - scatter and 1 + scatter of that [-]
    double       shear_ratio = 0.2; ///< of the links of spheres, shear over normal modulus; the others have none [-]
    double       density     = 1;   ///< of the particles' medium, voids included [kg/m^3]
    std::int64_t rows        = 8;   ///< of a strip, between its lines of symmetry
    std::int64_t width       = 2;   ///< of a bar, in elements
    std::int64_t seed        = 1;   ///< of its packing, and of what is scattered

    double height() const; ///< of a row or strip, across the wave [m]
    /** Of a link that acts at a place, over the average: by the place alone. */
    double stiffness_at(const Eigen::Vector3d &place) const;
    /**
     * What links that are all alike would have for the same stiffness in the mean [Pa]: each strained by forces on its ends gives way, on average, as if it were one
     * of them (effective medium, Feng, Thorpe and Garboczi, 1985, Phys. Rev. B 31, 276). In a row that is exact.
     */
    double effective_modulus() const;
    double young() const;                         ///< of the same medium as a continuum, in plane strain [Pa]
    double poisson() const;                       ///< likewise
    double wave_speed(bool shear) const;          ///< of long waves along x [m/s]
    double frequency(bool shear, double k) const; ///< of a wave of this wave number [rad/s]
    double group_speed(bool shear, double k) const;
    /** Of what lies at a height: half of what is on a line of symmetry is in the strip. */
    double share_across(double y) const;
  };

  constexpr double hexagonal_row_pitch = 0.8660254037844386; ///< sqrt(3)/2, over the spacing

  /**
   * Reflected energy where elements of so many spacings begin at a particle, without overlap, and share a node with it (doc/theory/volume-coupling.md, 6).
   * @param wavelength over the spacing
   */
  double edge_to_edge_reflection(std::int64_t element, double wavelength);
} // namespace coupling

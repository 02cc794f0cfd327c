#pragma once

#include "coupling/volume/parameters.h"

#include <cstdint>
#include <string>

namespace apps
{
  /** Regular particles that a wave runs through: what its speeds are is known in closed form. */
  struct WaveMedium
  {
    enum class Lattice
    {
      chain, ///< a row of discs that move along it only
      strip  ///< hexagonal rows of discs between two lines of symmetry: an unbounded plane for waves along the rows
    };

    Lattice      lattice = Lattice::chain;
    double       spacing = 1; ///< a, of neighbours [m]
    double       modulus = 1; ///< of the links [Pa]
    double       density = 1; ///< of the particles' medium, voids included [kg/m^3]
    std::int64_t rows    = 8; ///< of a strip, between its lines of symmetry

    double height() const;                        ///< across the wave [m]
    double young() const;                         ///< of the same medium as a continuum, in plane strain [Pa]
    double poisson() const;                       ///< likewise
    double wave_speed(bool shear) const;          ///< of long waves along x [m/s]
    double frequency(bool shear, double k) const; ///< of a wave of this wave number [rad/s]
    double group_speed(bool shear, double k) const;
  };

  /** How particles and continuum meet. */
  struct WaveMethod
  {
    std::string                   name; ///< in tables
    coupling::VolumeMethod        method        = coupling::VolumeMethod::multipliers;
    coupling::Compatibility       compatibility = coupling::Compatibility::coarse;
    bool                          lumped        = false;
    bool                          absorbs       = false;
    int                           sharpness     = 3; ///< p
    coupling::AbsorberProportions proportions   = {};
  };

  /** A packet of waves that runs through particles, on along x, and into a continuum. */
  struct WaveCase
  {
    WaveMedium   medium;
    WaveMethod   method;
    std::int64_t element = 8, overlap = 4; ///< size of an element over the spacing; width of the overlap in elements
    bool         shear       = false;
    double       wavelength  = 0;   ///< [m]
    double       step_factor = 0.8; ///< of the particles' stable step
  };

  /** Where the energy of the packet went, over what it had; particles alone are taken off first (doc/theory/volume-coupling.md, 6). */
  struct WaveAnswer
  {
    double       reflected = 0, transmitted = 0; ///< in the particles' own region; in the continuum
    double       absorbed      = 0;              ///< by the absorber, as its account says
    double       balance_error = 0;              ///< of all energies of the coupled run
    double       cost          = 0; ///< processor time of a particle's step, over the same of particles alone
    double       made          = 0; ///< by the multipliers, over the packet's energy
    std::int64_t steps = 0, particles = 0;
  };

  /**
   * Reflected energy where elements of so many spacings begin at a particle, without overlap, and share a node with it (doc/theory/volume-coupling.md, 6).
   * @param wavelength over the spacing
   */
  double edge_to_edge_reflection(std::int64_t element, double wavelength);

  /** What a case costs, in particle steps. */
  double wave_cost(const WaveCase &wave);

  /** Run it. @throws base::InputError for a wavelength that the particles cannot carry */
  WaveAnswer transmit(const WaveCase &wave);
} // namespace apps

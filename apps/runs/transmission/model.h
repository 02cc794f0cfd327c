#pragma once

#include "base/entry_path.h"
#include "coupling/transmission/wave_case.h"

#include <string>
#include <vector>

namespace apps
{
  /** Packets of waves from particles into a continuum, by several methods, over the wavelength. */
  struct TransmissionModel
  {
    coupling::WaveCase            common;                                          ///< without method and wavelength
    std::vector<std::string>      methods = {"absorber", "coarse", "constrained"}; ///< names of wave_methods()
    std::vector<double>           wavelengths;                                     ///< [m]
    coupling::AbsorberProportions proportions;
    double                        degrees = 0; ///< between the packets' way and the normal of the overlap

    /** Rules between entries. @throws base::InputError */
    void                              check(const base::EntryPath &root) const;
    std::vector<coupling::WaveMethod> chosen() const; ///< none if a name is not known
    /** @pre checked */
    coupling::WaveCase wave(const coupling::WaveMethod &method, double length) const;
  };
} // namespace apps

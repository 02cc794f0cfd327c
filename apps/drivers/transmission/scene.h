#pragma once

#include "apps/scene/scene.h"
#include "coupling/transmission/wave_case.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Scene kind "transmission": packets of waves from particles into a continuum, by several methods, over the wavelength.
   *
   * In the result folder: reflection.csv, reflection.png, summary.json, scene.prm.
   */
  class TransmissionScene : public Scene
  {
  public:
    void        declare(Section &root) override;
    void        check() const override;
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    std::vector<double> lengths() const; ///< [m]
    /** @pre validated */
    coupling::WaveCase wave(const coupling::WaveMethod &method, double length) const;

  private:
    std::vector<coupling::WaveMethod> chosen() const;

    coupling::WaveCase            common; ///< without method and wavelength
    std::string                   methods = "absorber, coarse, slaved", wavelengths;
    coupling::AbsorberProportions proportions;
    double                        degrees = 0; ///< between the packets' way and the normal of the overlap
  };
} // namespace apps

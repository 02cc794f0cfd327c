#pragma once

#include "coupling/transmission/wave_case.h"
#include "postprocess/pictures/plot.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** One packet of a table. */
  struct WavePoint
  {
    std::string          method;
    double               wavelength = 0; ///< [m]
    coupling::WaveAnswer answer;
  };

  /** reflection.csv. */
  std::string csv_of_waves(const std::vector<WavePoint> &points);
  /** A list for summary.json. */
  nlohmann::json json_of_waves(const std::vector<WavePoint> &points);
  /** Shares of each packet, as figures of summary.json. */
  nlohmann::json figures_of_waves(const std::vector<WavePoint> &points);
  /** Shares over the wavelength; of a row of particles beside what elements reflect that begin at a particle. @param common medium and mesh of all */
  std::vector<postprocess::PlotPanel> wave_panels(const std::vector<WavePoint> &points,
                                                  const coupling::WaveCase     &common);
} // namespace apps

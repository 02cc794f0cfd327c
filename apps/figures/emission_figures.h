#pragma once

#include "base/column.h"
#include "dem/specimen/observation.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What a run says of the acoustic emission of a specimen. */
  class EmissionFigures
  {
  public:
    EmissionFigures() = default;
    /** Of what has been heard so far. */
    explicit EmissionFigures(const dem::ObservedSpecimen &specimen);
    /** As row() gave them. Nothing was listened to where there is none. */
    explicit EmissionFigures(const base::Column &row);

    base::Column row() const;
    bool         listened() const { return heard; }

    /** Figures by name, as a summary holds them; none where nothing was listened to. @param prefix of the names, "tension_" */
    nlohmann::json                  json(const std::string &prefix = "") const;
    static std::vector<std::string> names(const std::string &prefix = "");
    /** A line for the terminal; none where nothing was listened to. */
    std::string text() const;

  private:
    bool   heard  = false;
    double events = 0, largest = 0;                        ///< number and magnitude; of no event there is none
    double of_law = 0, completeness = 0, b = 0, error = 0; ///< see dem::FrequencyLaw; without one 0
  };

  /**
   * NAMEevents.csv, NAMEemission.vtp and, where something was heard, NAMEemission.png; nothing where nothing was listened to.
   * @param looking_along see postprocess::picture_of_emission() @throws postprocess::OutputError
   */
  void write_emission(const dem::ObservedSpecimen &specimen,
                      const std::filesystem::path &folder,
                      const std::string           &name,
                      int                          looking_along);
} // namespace apps

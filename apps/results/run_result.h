#pragma once

#include "apps/results/run_work.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dem
{
  class ObservedSpecimen;
}

namespace apps
{
  /** A number that a run found, or why there is none. */
  struct Figure
  {
    std::optional<double> value;
    std::string           unit;           ///< "-" of a pure number; "" of a count
    std::string           not_determined; ///< why there is no value; "" where there is one
  };

  /**
   * What a run found and what it took, in memory: what its files show, and a program needs not read back. Under MPI the first rank has
   * it.
   */
  struct RunResult
  {
    enum class End
    {
      complete,
      interrupted ///< by a signal or by its request; without a summary
    };

    End                   end = End::complete;
    std::string           stage;   ///< in which it was interrupted
    std::string           go_on;   ///< the command that goes on with it, where a checkpoint was left
    postprocess::CsvTable series;  ///< every row, also those from before a resumption
    nlohmann::json        summary; ///< what summary.json holds; numbers that are not finite stand as such
    std::string           words;   ///< the same for a terminal, lines
    std::filesystem::path folder;  ///< of its files; "": none were requested

    std::shared_ptr<const dem::ObservedSpecimen>
      specimen; ///< the particles at the end, of the last test; nullptr: there are none

    /**
     * A figure of the summary. @param path names from "figures" on, "compressive_strength" or "gauge/largest"
     * @throws base::InputError that lists the figures there are
     */
    Figure figure(const std::string &path) const;
    /** Paths of all figures, in the order of the summary. */
    std::vector<std::string> figures() const;
    /** What a user should doubt, a sentence each. */
    std::vector<std::string> warnings() const;
    /** Error of the energy balance, over the largest energy, at worst [-]; nothing where no energies are counted. */
    std::optional<double> balance_error() const;

    int exit_status() const; ///< 0, or 130 after an interrupt
  };

  /** Columns without rows. @param origin for messages */
  postprocess::CsvTable empty_series(const std::vector<postprocess::SeriesColumn> &columns, const std::string &origin);

  /** @throws std::invalid_argument for another number of values */
  void append(postprocess::CsvTable &series, const SeriesRow &row);
} // namespace apps

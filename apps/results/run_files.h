#pragma once

#include "apps/results/result_folder.h"
#include "apps/results/run_request.h"
#include "apps/results/run_work.h"
#include "postprocess/hdf5/checkpoint.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace apps
{
  /** Request that a run goes on: under the name of the scene that it was begun with, not of its copy in the folder. */
  void ask_to_go_on(RunRequest &request);

  /**
   * The files that every run has: in the folder "running" below the results scene.prm, series.csv and checkpoint.h5; at the end
   * summary.json. Under MPI the first rank has them.
   */
  class RunFiles
  {
  public:
    /** Opens the folder. @param request must outlive it @throws base::InputError, postprocess::OutputError: see ResultFolder */
    explicit RunFiles(const RunRequest &request);

    const std::filesystem::path &running() const { return folder.running(); }

    /** Of a run that starts: scene and series. */
    void begin(const std::vector<postprocess::SeriesColumn> &columns);

    /** The checkpoint of a run that is resumed. @throws base::InputError if the files that the scene names are others now */
    std::unique_ptr<postprocess::CheckpointReader> last_checkpoint() const;
    /** Go on with the series after so many rows. @return these */
    postprocess::CsvTable go_on(const std::vector<postprocess::SeriesColumn> &columns, std::int64_t rows);

    void record(const SeriesRow &row);
    void flush() { series->flush(); }

    /** A new checkpoint, to be filled and committed; knows of the rows so far. @param rows their number */
    std::unique_ptr<postprocess::CheckpointWriter> new_checkpoint(std::int64_t &rows);

    /** The run is complete. @throws postprocess::OutputError */
    void publish(const nlohmann::json &summary);

  private:
    const RunRequest                          &request;
    ResultFolder                               folder;
    std::unique_ptr<postprocess::SeriesWriter> series;
  };
} // namespace apps

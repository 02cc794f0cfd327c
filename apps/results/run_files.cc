#include "apps/results/run_files.h"

#include "apps/results/input_files.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/files/summary.h"

namespace apps
{
  namespace
  {
    constexpr const char *scene_name  = "scene.prm";
    constexpr const char *series_name = "series.csv";
    constexpr const char *begun_with  = "scene_file"; // text of a checkpoint
  }                                                   // namespace

  void ask_to_go_on(RunRequest &request)
  {
    request.resume = true;
    const std::string begun =
      postprocess::text_of_checkpoint(request.output_folder / "running" / checkpoint_name, begun_with);
    if (!begun.empty())
      request.scene_file = begun;
  }

  RunFiles::RunFiles(const RunRequest &requested)
    : request(requested)
    , folder(requested.output_folder, requested.resume ? ResultFolder::Start::resume : ResultFolder::Start::afresh)
  {
  }

  void RunFiles::begin(const std::vector<postprocess::SeriesColumn> &columns)
  {
    postprocess::write_text(running() / scene_name, request.scene_text);
    series = std::make_unique<postprocess::SeriesWriter>(running() / series_name, columns);
  }

  std::unique_ptr<postprocess::CheckpointReader> RunFiles::last_checkpoint() const
  {
    auto checkpoint =
      std::make_unique<postprocess::CheckpointReader>(running() / checkpoint_name, request.deciding_text);
    require_same_content(request.inputs, checkpoint->text("inputs"));
    return checkpoint;
  }

  postprocess::CsvTable RunFiles::go_on(const std::vector<postprocess::SeriesColumn> &columns, const std::int64_t rows)
  {
    std::vector<std::string> words;
    for (const postprocess::SeriesColumn &column : columns)
      if (column.words)
        words.push_back(column.name);
    series = std::make_unique<postprocess::SeriesWriter>(running() / series_name, columns, rows);
    postprocess::write_text(running() / scene_name, request.scene_text); // entries of output may have changed
    return postprocess::read_csv_table(running() / series_name, true, words);
  }

  void RunFiles::record(const SeriesRow &row) { series->append(row.first, row.values, row.last); }

  std::unique_ptr<postprocess::CheckpointWriter> RunFiles::new_checkpoint(std::int64_t &rows)
  {
    series->flush();
    rows = series->rows();
    auto checkpoint =
      std::make_unique<postprocess::CheckpointWriter>(running() / checkpoint_name, request.deciding_text);
    checkpoint->text("inputs", listed(request.inputs));
    checkpoint->text(begun_with, request.scene_file);
    return checkpoint;
  }

  void RunFiles::publish(const nlohmann::json &summary)
  {
    postprocess::write_json(running() / "summary.json", summary);
    folder.publish();
  }
} // namespace apps

#include "python/run_of_scene.h"

#include "apps/results/run_files.h"
#include "apps/results/run_observer.h"
#include "apps/results/run_report.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/reader.h"
#include "base/errors.h"
#include "python/signals.h"
#include "python/until_exit.h"

namespace py = pybind11;

namespace python
{
  namespace
  {
    /** Hands the rows of a run to a function of Python. */
    class RowsToPython : public apps::RunObserver
    {
    public:
      explicit RowsToPython(py::object callback)
        : on_sample(std::move(callback))
      {
      }

      void begins(const apps::RunOutline &outline) override { columns = outline.columns; }
      void row(const apps::SeriesRow &row) override
      {
        const py::gil_scoped_acquire holding;
        py::dict                     named;
        std::size_t                  c = 0;
        for (const std::string &word : row.first)
          named[py::str(columns.at(c++).name)] = word;
        for (const double value : row.values)
          named[py::str(columns.at(c++).name)] = value;
        for (const std::string &word : row.last)
          named[py::str(columns.at(c++).name)] = word;
        try
          {
            if (const py::object answer = on_sample(named); answer.cast<bool>())
              stops = true;
          }
        catch (const py::error_already_set &raised)
          {
            if (!raised.matches(PyExc_KeyboardInterrupt))
              throw;
            interrupted = true; // Ctrl-C while the callback ran: the state is saved all the same
          }
      }

      bool interrupted = false;
      bool stops       = false; ///< that is requested

    private:
      py::object                             on_sample;
      std::vector<postprocess::SeriesColumn> columns;
    };

  } // namespace

  apps::RunRequest request_for(const apps::CheckedScene &scene, const RunChoice &choice)
  {
    if (scene.replicates > 1)
      throw base::InputError(scene.file +
                             ": Replicates: several runs are made by \"breccia run\"; here the seeds are changed.");
    apps::RunRequest request = apps::request_of(scene);
    request.output_folder    = choice.folder;
    if (choice.resume)
      apps::ask_to_go_on(request);
    request.overrides = scene.overrides;
    return request;
  }

  std::shared_ptr<apps::RunResult>
  run_scene(const std::string &file, const std::vector<std::string> &changes, const RunChoice &choice)
  {
    const apps::CheckedScene scene   = apps::read_scene(file, changes);
    apps::RunRequest         request = request_for(scene, choice);

    RowsToPython    rows(choice.on_sample);
    SignalsOfPython signals;
    apps::RunReport report(request);
    if (!choice.on_sample.is_none())
      request.observers.push_back(&rows);
    if (scene.report)
      request.observers.push_back(&report);
    request.stop = [&] { return rows.stops || rows.interrupted || signals.raised(); };

    auto result = std::make_shared<apps::RunResult>();
    {
      const py::gil_scoped_release letting_go;
      apps::with_places(*scene.root, [&] { *result = scene.scene->run(request); });
    }
    if (result->end == apps::RunResult::End::interrupted && (rows.interrupted || signals.raised()))
      {
        PyErr_SetString(PyExc_KeyboardInterrupt,
                        result->go_on.empty() ? "interrupted" : ("interrupted. " + result->go_on).c_str());
        throw py::error_already_set();
      }
    keep_until_exit(result);
    return result;
  }
} // namespace python

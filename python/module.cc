// What Python sees of the libraries; breccia/__init__.py makes dictionaries and tables of it.
#include "apps/process/version.h"
#include "apps/runs/homogenisation/report.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/link_driver.h"
#include "apps/scene/link_law_named.h"
#include "apps/scene/material_driver.h"
#include "base/errors.h"
#include "postprocess/files/errors.h"
#include "postprocess/packings/packing_io.h"
#include "python/arrays.h"
#include "python/coupled_steps.h"
#include "python/live_cell.h"
#include "python/moving_particles.h"
#include "python/moving_solid.h"
#include "python/run_of_scene.h"
#include "python/specimen_arrays.h"
#include "python/until_exit.h"

#include <nlohmann/json.hpp>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

namespace py = pybind11;

namespace
{
  using python::array_of;
  using Result = std::shared_ptr<apps::RunResult>;

  /** Every entry of a section that counts: (path, value as text or None, unit, type, meaning). */
  void add_entries(const apps::Section &section, py::list &entries)
  {
    if (!section.needed())
      return;
    for (const auto &entry : section.entries())
      if (entry->needed())
        entries.append(
          py::make_tuple(section.path_of(entry->name), entry->value, entry->unit, entry->type, entry->meaning));
    for (const auto &inner : section.sections())
      add_entries(*inner, entries);
  }

  py::list entries_of(const std::string &file, const std::vector<std::string> &changes)
  {
    py::list                 entries;
    const apps::CheckedScene scene = apps::read_scene(file, changes);
    add_entries(*scene.root, entries);
    return entries;
  }

  std::string forecast(const std::string &file, const std::vector<std::string> &changes)
  {
    const apps::CheckedScene     scene = apps::read_scene(file, changes);
    const py::gil_scoped_release letting_go;
    return scene.scene->forecast();
  }

  /** Columns of the series by name, each with its unit: (name, unit, numbers or words). Numbers are the result's own, which cannot be written to. */
  py::list series_of(const Result &result)
  {
    py::list                     columns;
    const postprocess::CsvTable &series = result->series;
    const py::object             owner  = py::cast(result);
    for (std::size_t c = 0; c < series.names.size(); ++c)
      {
        py::object values;
        if (c < series.words.size() && !series.words[c].empty())
          values = py::cast(series.words[c]);
        else
          {
            py::array_t<double> numbers(static_cast<py::ssize_t>(series.columns[c].size()), series.columns[c].data(),
                                        owner);
            numbers.attr("flags").attr("writeable") = false;
            values                                  = numbers;
          }
        columns.append(py::make_tuple(series.names[c], series.units[c], values));
      }
    return columns;
  }

  py::tuple figure_of(const Result &result, const std::string &path)
  {
    const apps::Figure figure = result->figure(path);
    return py::make_tuple(figure.value, figure.unit, figure.not_determined);
  }

  /** Columns of the particles at the end of a run, in the order of the packing; None where there are none. */
  py::object particles_of(const Result &result)
  {
    return result->specimen ? python::particles_in(*result->specimen) : py::object(py::none());
  }

  /** Columns of its links, likewise. */
  py::object links_of(const Result &result)
  {
    return result->specimen ? python::links_in(*result->specimen) : py::object(py::none());
  }

  /** A path of named columns as a table. @throws base::InputError for no columns, unlike lengths, and numbers that are not finite */
  postprocess::CsvTable table_of_path(const std::map<std::string, std::vector<double>> &path)
  {
    postprocess::CsvTable table;
    table.origin = "path";
    if (path.empty())
      throw base::InputError("path: has no columns. Give at least one, with a value a step.");
    for (const auto &[name, values] : path)
      {
        if (values.empty() || values.size() != path.begin()->second.size())
          throw base::InputError("path: column \"" + name + "\" has " + std::to_string(values.size()) +
                                 " values: all columns must have as many, at least one.");
        if (!std::all_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); }))
          throw base::InputError("path: column \"" + name + "\": expected finite numbers.");
        table.names.push_back(name);
        table.units.emplace_back();
        table.columns.push_back(values);
      }
    return table;
  }

  /** Columns of what a link answers along a path of named columns: (name, unit, values); and why it broke off, "" if it did not. */
  py::tuple link_test(const std::string                                &law_name,
                      const std::vector<std::string>                   &constants,
                      const std::map<std::string, std::vector<double>> &path,
                      const dem::LinkPair                              &pair,
                      const double                                      row_time)
  {
    const dem::LinkLawKind     &law   = apps::link_law_named(law_name);
    const postprocess::CsvTable table = table_of_path(path);
    const dem::LinkHistory answer = apps::drive_link(law, *apps::constants_of(law, constants), pair, table, row_time);
    py::list               columns;
    for (const auto &column : answer.columns)
      columns.append(py::make_tuple(column.name, column.unit, array_of(column.values)));
    return py::make_tuple(columns, answer.broke_off);
  }

  /** Columns of what a point of a continuum answers along a path of named columns: (name, unit, values). */
  py::list point_test(const std::string                                &material,
                      const std::vector<std::string>                   &constants,
                      const std::map<std::string, std::vector<double>> &path)
  {
    fem::MaterialHistory answer;
    {
      const py::gil_scoped_release letting_go;
      answer = apps::drive_point(material, constants, table_of_path(path));
    }
    py::list columns;
    for (std::size_t c = 0; c < answer.names.size(); ++c)
      {
        std::vector<double> values;
        values.reserve(answer.rows.size());
        for (const std::vector<double> &row : answer.rows)
          values.push_back(row[c]);
        columns.append(py::make_tuple(answer.names[c], answer.units[c], array_of(values)));
      }
    return columns;
  }

  /** The stiffness of a periodic packing, as text of JSON. @param law of the links; "": moduli instead */
  std::string homogenise(const std::string              &file,
                         const std::string              &law,
                         const std::vector<std::string> &constants,
                         const dem::NetworkParameters   &links)
  {
    apps::HomogenisationQuestion question;
    question.links = links;
    if (!law.empty())
      {
        const dem::LinkLawKind &kind = apps::link_law_named(law);
        question.materials           = kind.materials({{"", apps::constants_of(kind, constants).get(), 0}});
      }
    const py::gil_scoped_release letting_go;
    return apps::json_of(apps::homogenise(postprocess::read_packing(file), question, file)).dump();
  }
} // namespace

PYBIND11_MODULE(_breccia, m)
{
  m.attr("version") = apps::version();
  py::register_exception<base::InputError>(m, "InputError", PyExc_ValueError);
  py::register_exception<base::NumericalError>(m, "NumericalError", PyExc_ArithmeticError);
  py::register_exception<postprocess::OutputError>(m, "OutputError", PyExc_OSError);
  // MPI, which solids start, must be over before the interpreter is, and solids before MPI.
  py::module_::import("atexit").attr("register")(py::cpp_function(&python::leave));

  py::class_<apps::RunResult, Result>(m, "Result")
    .def_property_readonly("complete", [](const Result &r) { return r->end == apps::RunResult::End::complete; })
    .def_property_readonly("go_on", [](const Result &r) { return r->go_on; })
    .def_property_readonly("words", [](const Result &r) { return r->words; })
    .def_property_readonly("folder", [](const Result &r) { return r->folder.string(); })
    .def_property_readonly("summary", [](const Result &r) { return r->summary.dump(); })
    .def_property_readonly("warnings", [](const Result &r) { return r->warnings(); })
    .def_property_readonly("balance_error", [](const Result &r) { return r->balance_error(); })
    .def("figure_names", [](const Result &r) { return r->figures(); })
    .def("figure", &figure_of)
    .def("series", &series_of)
    .def("particles", &particles_of)
    .def("links", &links_of);

  m.def("link_test",
        [](const std::string &law, const std::vector<std::string> &constants,
           const std::map<std::string, std::vector<double>> &path, const int dimension, const double thickness,
           const double radius_1, const double radius_2, const double gap, const double row_time) {
          return link_test(law, constants, path, {dimension, thickness, radius_1, radius_2, gap}, row_time);
        });
  m.def("point_test", &point_test);
  m.def("homogenise", [](const std::string &file, const std::string &law, const std::vector<std::string> &constants,
                         const double interaction_ratio, const double normal_modulus, const double shear_ratio,
                         const double thickness) {
    dem::NetworkParameters links;
    links.dimension         = thickness > 0 ? 2 : 3;
    links.thickness         = thickness;
    links.interaction_ratio = interaction_ratio;
    links.normal_modulus    = normal_modulus;
    links.shear_ratio       = shear_ratio;
    return homogenise(file, law, constants, links);
  });
  m.def("entries", &entries_of);
  m.def("forecast", &forecast);
  m.def("run", [](const std::string &file, const std::vector<std::string> &changes, const std::string &folder,
                  const bool resume, const py::object &on_sample) {
    return python::run_scene(file, changes, {folder, resume, on_sample});
  });
  python::bind_coupled_steps(m);
  python::bind_live_cell(m);
  python::bind_moving_particles(m);
  python::bind_moving_solid(m);
}

#include "python/live_cell.h"

#include "apps/scene/link_law_named.h"
#include "base/errors.h"
#include "base/flat_state.h"
#include "postprocess/packings/packing_io.h"
#include "python/arrays.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>

namespace py = pybind11;

namespace python
{
  namespace
  {
    coupling::PreparedCell prepare(const std::string              &file,
                                   const std::string              &law_name,
                                   const std::vector<std::string> &constants,
                                   coupling::CellParameters        parameters)
    {
      const dem::Packing packing = postprocess::read_packing(file);
      if (std::any_of(packing.material.begin(), packing.material.end(), [](const auto number) { return number != 0; }))
        throw base::InputError(file + ": has particles of several materials, and a cell from Python has one.");
      const dem::LinkLawKind &law = apps::link_law_named(law_name);
      parameters.from_start       = true;
      return {packing, law.materials({{"", apps::constants_of(law, constants).get(), 0}}), parameters};
    }
  } // namespace

  LiveCell::LiveCell(const std::string              &file,
                     const std::string              &law,
                     const std::vector<std::string> &constants,
                     const coupling::CellParameters &parameters)
    : shared(new Shared{prepare(file, law, constants, parameters), {}})
    , own(shared->cell.promoted_at(base::Voigt::Zero(), shared->cell.system_of_thread(0)))
  {
  }

  LiveCell::LiveCell(const LiveCell &other)
    : shared(other.shared)
    , own(std::make_unique<dem::RespondingCell>(*other.own))
  {
  }

  dem::CellResponse LiveCell::respond(const base::Voigt &strain, const bool with_tangent)
  {
    base::Voigt requested = strain;
    if (prepared().of_discs())
      requested[2] = requested[3] = requested[4] = 0;
    const std::lock_guard<std::mutex> alone(shared->busy);
    dem::CellResponse                 answer = own->respond(requested, shared->cell.system_of_thread(0), with_tangent);
    if (with_tangent)
      answer.tangent = prepared().in_space(answer.tangent);
    return answer;
  }

  base::Column LiveCell::state() const
  {
    base::Column          row;
    base::FlatStateWriter writer(row);
    dem::RespondingCell   read = *own; // visiting is for writing, too
    read.visit_state(writer);
    return row;
  }

  void LiveCell::set_state(const base::Column &row)
  {
    const std::string what = "state: has " + std::to_string(row.size()) + " numbers, and is not one of this cell.";
    if (row.size() != state().size())
      throw base::InputError(what);
    dem::RespondingCell   next = *own;
    base::FlatStateReader reader(row);
    try
      {
        next.visit_state(reader);
      }
    catch (const std::out_of_range &)
      {
        throw base::InputError(what);
      }
    *own = next;
    own->begin_step();
  }

  namespace
  {
    std::unique_ptr<LiveCell> make(const std::string              &file,
                                   const std::string              &law,
                                   const std::vector<std::string> &constants,
                                   const double                    interaction_ratio,
                                   const double                    thickness,
                                   const bool                      rotations,
                                   const double                    contact_reach,
                                   const double                    tolerance,
                                   const double                    growth_step)
    {
      coupling::CellParameters parameters;
      parameters.links.dimension         = thickness > 0 ? 2 : 3;
      parameters.links.thickness         = thickness > 0 ? thickness : 1;
      parameters.links.rotations         = rotations;
      parameters.links.interaction_ratio = interaction_ratio;
      parameters.links.contact_reach     = contact_reach;
      parameters.response.tolerance      = tolerance;
      parameters.response.growth_step    = growth_step;
      const py::gil_scoped_release letting_go;
      return std::make_unique<LiveCell>(file, law, constants, parameters);
    }

    py::dict energies(const LiveCell &cell)
    {
      const dem::CellEnergy e = cell.cell().energy();
      py::dict              named;
      named["external_work"] = e.external_work;
      named["stored"]        = e.stored;
      named["damage"]        = e.damage;
      named["friction"]      = e.friction;
      named["damped"]        = e.damped;
      named["residual"]      = e.residual();
      return named;
    }

    py::array_t<double> array_of_row(const base::Column &row)
    {
      return py::array_t<double>(static_cast<py::ssize_t>(row.size()), row.data());
    }
  } // namespace

  void bind_live_cell(py::module_ &module)
  {
    py::class_<dem::CellResponse>(module, "CellResponse")
      .def_property_readonly("stress", [](const dem::CellResponse &r) { return base::Vector6(r.stress); })
      .def_property_readonly("tangent", [](const dem::CellResponse &r) { return base::Matrix6(r.tangent); })
      .def_readonly("iterations", &dem::CellResponse::iterations)
      .def_readonly("parts", &dem::CellResponse::parts)
      .def_readonly("relaxation_steps", &dem::CellResponse::relaxation_steps)
      .def_readonly("residual", &dem::CellResponse::residual);
    py::class_<LiveCell>(module, "LiveCell")
      .def(py::init(&make))
      .def("copy", [](const LiveCell &cell) { return std::make_unique<LiveCell>(cell); })
      .def("respond", &LiveCell::respond, py::call_guard<py::gil_scoped_release>())
      .def("commit", &LiveCell::commit)
      .def("begin_step", &LiveCell::begin_step)
      .def("state", [](const LiveCell &cell) { return array_of_row(cell.state()); })
      .def("set_state",
           [](LiveCell &cell, const py::array_t<double, py::array::c_style | py::array::forcecast> &row) {
             cell.set_state(base::Column(row.data(), row.data() + row.size()));
           })
      .def("energies", &energies)
      .def_property_readonly("strain", [](const LiveCell &cell) { return base::Vector6(cell.cell().strain()); })
      .def_property_readonly("stiffness",
                             [](const LiveCell &cell) { return base::Matrix6(cell.prepared().stiffness()); })
      .def_property_readonly("volume", [](const LiveCell &cell) { return cell.prepared().volume(); })
      .def_property_readonly("particles", [](const LiveCell &cell) { return cell.prepared().particles(); })
      .def_property_readonly("links", [](const LiveCell &cell) { return cell.prepared().links(); });
  }
} // namespace python

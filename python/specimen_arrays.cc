#include "python/specimen_arrays.h"

#include "dem/model/particles.h"
#include "dem/specimen/particle_columns.h"
#include "python/arrays.h"

namespace py = pybind11;

namespace python
{
  py::dict particles_in(const dem::ObservedSpecimen &specimen)
  {
    const dem::ParticleOutput found = specimen.particles();
    py::dict                  columns;
    columns["position"]         = array_of(found.position);
    columns["displacement"]     = array_of(found.displacement);
    columns["velocity"]         = array_of(found.velocity);
    columns["angular_velocity"] = array_of(found.angular_velocity);
    columns["radius"]           = array_of(found.radius);
    columns["damage"]           = array_of(found.damage);
    columns["broken_links"]     = array_of(found.broken_links);
    columns["volume"]           = array_of(found.volume);
    return columns;
  }

  py::dict links_in(const dem::ObservedSpecimen &specimen)
  {
    const dem::LinkOutput     found = specimen.links();
    py::array_t<std::int64_t> ends({static_cast<py::ssize_t>(found.ends.size()), py::ssize_t{2}});
    auto                      numbers = ends.mutable_unchecked<2>();
    for (std::size_t i = 0; i < found.ends.size(); ++i)
      for (std::size_t e = 0; e < 2; ++e)
        numbers(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(e)) = static_cast<std::int64_t>(found.ends[i][e]);
    py::dict columns;
    columns["ends"]          = ends;
    columns["kind"]          = array_of(found.kind);
    columns["normal_force"]  = array_of(found.normal_force);
    columns["shear_force"]   = array_of(found.shear_force);
    columns["normal_stress"] = array_of(found.normal_stress);
    columns["shear_stress"]  = array_of(found.shear_stress);
    columns["normal_strain"] = array_of(found.normal_strain);
    columns["damage"]        = array_of(found.damage);
    columns["dissipated"]    = array_of(found.dissipated);
    return columns;
  }

  namespace
  {
    /** Three numbers of each particle's record, where they lie. */
    py::array_t<double> vectors_in(const py::object &owner, const base::Column &column, const std::size_t particles)
    {
      constexpr auto      size = static_cast<py::ssize_t>(sizeof(double));
      py::array_t<double> view({static_cast<py::ssize_t>(particles), py::ssize_t{3}}, {dem::record_size * size, size},
                               column.data(), owner);
      view.attr("flags").attr("writeable") = false;
      return view;
    }

    template <typename Value>
    py::array_t<Value>
    numbers_in(const py::object &owner, const Value *first, const std::size_t stride, const std::size_t n)
    {
      py::array_t<Value> view({static_cast<py::ssize_t>(n)}, {static_cast<py::ssize_t>(stride * sizeof(Value))}, first,
                              owner);
      view.attr("flags").attr("writeable") = false;
      return view;
    }
  } // namespace

  py::dict views_of(const py::object &owner, const dem::Specimen &specimen)
  {
    const dem::Particles &p = dem::particle_columns(specimen);
    py::dict              views;
    views["position"]     = vectors_in(owner, p.pose, p.count);
    views["velocity"]     = vectors_in(owner, p.velocity, p.count);
    views["force"]        = vectors_in(owner, p.force, p.count);
    views["radius"]       = numbers_in(owner, p.pose.data() + 6, dem::record_size, p.count);
    views["mass"]         = numbers_in(owner, p.mass.data(), 1, p.count);
    views["number"]       = numbers_in(owner, p.number.data(), 1, p.count);
    views["broken_links"] = numbers_in(owner, p.broken_links.data(), 1, p.count);
    return views;
  }
} // namespace python

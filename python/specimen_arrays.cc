#include "python/specimen_arrays.h"

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
} // namespace python

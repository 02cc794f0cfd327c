#include "python/node_arrays.h"

#include "python/arrays.h"

namespace py = pybind11;

namespace python
{
  namespace
  {
    template <typename VectorOfNode>
    py::array_t<double> of_nodes(const apps::SolidNodes &nodes, const VectorOfNode &vector_of)
    {
      return array_of_vectors(nodes.participant().carriers(), vector_of);
    }
  } // namespace

  py::array_t<double> places_of(const apps::SolidNodes &nodes)
  {
    return of_nodes(nodes, [&](const std::size_t i) { return nodes.place(i); });
  }

  py::array_t<double> displacements_of(const apps::SolidNodes &nodes)
  {
    return of_nodes(nodes, [&](const std::size_t i) { return nodes.displacement(i); });
  }

  py::array_t<double> velocities_of(const apps::SolidNodes &nodes)
  {
    return of_nodes(nodes, [&](const std::size_t i) { return nodes.participant().velocity(i); });
  }
} // namespace python

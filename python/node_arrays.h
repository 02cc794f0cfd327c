#pragma once

#include "apps/runs/continuum/solid_nodes.h"

#include <pybind11/numpy.h>

namespace python
{
  // Of the nodes of a solid, (n, 3): copies.

  pybind11::array_t<double> places_of(const apps::SolidNodes &nodes);        ///< undeformed [m]
  pybind11::array_t<double> displacements_of(const apps::SolidNodes &nodes); ///< [m]
  pybind11::array_t<double> velocities_of(const apps::SolidNodes &nodes);    ///< half a step back [m/s]
} // namespace python

#pragma once

#include "dem/specimen/observation.h"
#include "dem/specimen/specimen.h"

#include <pybind11/pybind11.h>

namespace python
{
  /** Columns of the particles by name, in the order of the packing: copies. */
  pybind11::dict particles_in(const dem::ObservedSpecimen &specimen);

  /** Columns of bonds, contacts and bonds that are gone by name (dem::LinkOutput): copies. */
  pybind11::dict links_in(const dem::ObservedSpecimen &specimen);

  /** Columns of the particles by name, views of what moves. @param owner of the specimen, which they keep alive */
  pybind11::dict views_of(const pybind11::object &owner, const dem::Specimen &specimen);
} // namespace python

#pragma once

#include "fem/mesh/mesh.h"
#include "fem/solid/loads.h"
#include "fem/solvers/linear_solver.h"

#include <string>
#include <vector>

namespace apps
{
  /** A problem with a known answer, and how it is solved. */
  struct ContinuumCase
  {
    fem::ElementFamily family   = fem::ElementFamily::hypercube;
    unsigned int       degree   = 1;
    unsigned int      divisions = 4; ///< of each edge of the unit cube (for tetrahedra: of the cells they are cut from)
    fem::LinearMethod method    = fem::LinearMethod::direct;

    std::string element_name() const; ///< Q1, Q2, P1, P2
    std::string solver_name() const;
  };

  struct ContinuumError
  {
    ContinuumCase which;
    std::size_t   unknowns   = 0;
    unsigned int  iterations = 0;
    double        cost       = 0; ///< [s] of processor, from the mesh to the displacements
    double        error      = 0; ///< of the displacement, relative, in the mean square
  };

  /** All cases, cheapest first for each element and solver. */
  std::vector<ContinuumCase> continuum_cases(bool quick);

  /**
   * Solves a case on one rank: u = (sin pi x sin pi y sin pi z, 0, 0) in the unit cube, held at its surface, under the
   * body force that belongs to it.
   */
  ContinuumError solve_case(const ContinuumCase &which);

  /** The unit cube of elastic material, held at x = 0 and pulled at x = 1: what the rates are measured on. */
  fem::Mesh<3> unit_cube(fem::ElementFamily family, unsigned int divisions, MPI_Comm communicator);
} // namespace apps

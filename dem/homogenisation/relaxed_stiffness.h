#pragma once

#include "dem/homogenisation/macroscopic_stiffness.h"
#include "dem/linear/linear_solver.h"

#include <vector>

namespace dem
{
  /** Stiffness of the cell as it is: particles at rest in equilibrium under each macroscopic strain. */
  struct RelaxedStiffness
  {
    MacroscopicStiffness stiffness;    ///< [Pa]; exactly zero in strains that the cell does not resist
    int                  resisted = 0; ///< how many independent strains it does resist, see strains_of()
    SolverReport         solver;

    /**
     * Motion of each particle per unit of macroscopic strain, beyond the affine field (total motion if so formulated): rows
     * displacement [m] and rotation [-], a column per strain component. Mechanisms are at rest.
     */
    std::vector<base::Matrix6> motion;
  };

  /**
   * Solve the cell for all macroscopic strains at once: D = (K_EE - K_Eu K_uu^+ K_uE)/V, doc/theory/homogenisation.md, 3,
   * evaluated as the energy of the solution, which is symmetric and whose error is that of the motions squared.
   *
   * @throws std::invalid_argument if the network is not periodic.
   */
  RelaxedStiffness relaxed_stiffness(const ElasticNetwork   &network,
                                     const SolverParameters &parameters  = {},
                                     CellFormulation         formulation = CellFormulation::fluctuation);

  /**
   * Strain localisation of a link: link strain (slip over length) = M E; doc/theory/homogenisation.md, 3.
   * @pre relaxed was found with CellFormulation::fluctuation
   */
  Eigen::Matrix<double, 3, 6> strain_localisation(const ElasticLink &link, const RelaxedStiffness &relaxed);
} // namespace dem

#include "apps/scene/entries/path_steps.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare_path_steps(
    Section &section, double &growth_step, double &tolerance, double &damping, const std::string &forces)
  {
    section.number("Growth step", growth_step, "-", Range::between(1e-4, 1), Need::optional)
      .means("Largest growth of any link's damaging strain in a step, over itself; it controls the steps where damage "
             "is fast");
    section.number("Tolerance", tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Unbalanced force over " + forces + ", both as root of the sum of squares");
    section.number("Damping", damping, "-", Range::from_up_to(0.01, 1), Need::optional)
      .means("Local (Cundall) damping where cracks run away and dynamics finds the next equilibrium");
  }

  void declare_path_solver(Section &section, dem::SolverMethod &method)
  {
    section
      .choice("Linear solver", method,
              {{"automatic", dem::SolverMethod::automatic},
               {"direct", dem::SolverMethod::direct},
               {"iterative", dem::SolverMethod::iterative}},
              Need::optional)
      .means(
        "iterative: minimal residuals with a factor of each brick of particles, shared by the processes of mpirun; "
        "automatic: iterative under mpirun and for 5000 particles and more in space, otherwise direct (UMFPACK)");
  }
} // namespace apps

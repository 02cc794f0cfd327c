#include "fem/materials/anisotropic_elastic.h"

#include "fem/materials/refuse.h"

namespace fem
{
  namespace
  {
    base::Stiffness from_upper(const std::array<double, 21> &upper)
    {
      base::Stiffness full;
      unsigned int    next = 0;
      for (int i = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j)
          full(i, j) = full(j, i) = upper[next++];
      return full;
    }
  }

  AnisotropicElastic::AnisotropicElastic(const Parameters &parameters)
    : AnisotropicElastic(from_upper(parameters.upper))
  {
  }

  AnisotropicElastic::AnisotropicElastic(const base::Stiffness &given)
    : stiffness((given + given.transpose()) / 2)
  {
    demand(given.allFinite(), "stiffness", given.sum(), "every entry must be a finite number.");
    const double largest = given.cwiseAbs().maxCoeff();
    const double skew    = (given - given.transpose()).cwiseAbs().maxCoeff();
    demand(skew <= 1e-10 * largest, "largest |D_ij - D_ji|", skew, "the stiffness must be symmetric.");
    const double lowest =
      Eigen::SelfAdjointEigenSolver<base::Stiffness>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[0];
    demand(lowest > 0, "lowest eigenvalue of the stiffness", lowest, "must be positive.");
  }
}

#pragma once

#include <array>
#include <vector>

namespace coupling::references
{
  struct Continuation
  {
    double strain, stress; ///< [-], [MPa]
  };

  struct PublishedCase
  {
    const char               *name;
    std::array<double, 6>     stress;               ///< of the particles, order xx yy zz yz zx xy [Pa]
    std::array<double, 3>     published, corrected; ///< eigenvalues of the tensors with 12/(2N) and 15/(2N)
    double                    raw, damage, kappa_d, kappa_p;
    std::vector<Continuation> after;
  };

  /**
   * Six of the twelve transfers of Stransky (2018): what the particles had, what was mapped, and how the continuum went on
   * (doc/theory/sequential-transfer.md, 3).
   */
  const std::vector<PublishedCase> &published_cases();
} // namespace coupling::references

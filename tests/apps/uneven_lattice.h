#pragma once

#include <cmath>
#include <sstream>
#include <string>

namespace apps_tests
{
  /** Text of n^3 touching spheres of 1 mm on a cubic lattice that are a little displaced, periodic. */
  inline std::string uneven_lattice(const int n)
  {
    std::ostringstream text;
    text << "# periodic_cell " << 2e-3 * n << ' ' << 2e-3 * n << ' ' << 2e-3 * n << '\n';
    for (int i = 0; i < n * n * n; ++i)
      text << 2e-3 * (i % n + 0.03 * std::sin(7 * i)) << ' ' << 2e-3 * (i / n % n + 0.03 * std::sin(11 * i)) << ' '
           << 2e-3 * (i / (n * n) + 0.03 * std::sin(13 * i)) << " 1e-3\n";
    return text.str();
  }
} // namespace apps_tests

// Divides by zero, which a build with BRECCIA_TRAP_FPE does not survive.
#include "dem/core/floating_point_traps.h"

#include <iostream>

int main()
{
  dem::enable_floating_point_traps();
  volatile double zero = 0.0;
  std::cout << 1.0 / zero << '\n';
}

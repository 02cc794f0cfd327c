// The main function of every test executable.
#define CATCH_CONFIG_RUNNER
#include "dem/floating_point_traps.h"

#include <catch2/catch.hpp>

int main(int argc, char *argv[])
{
  dem::enable_floating_point_traps();
  return Catch::Session().run(argc, argv);
}

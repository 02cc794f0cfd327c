// Non-linear problems of the Statistical Reference Datasets (National Institute of Standards and Technology).
#include "apps/optimisation/references.h"
#include "tests/compare.h"

TEST_CASE("least squares: reference problems from both starts to six digits, with their standard errors",
          "[optimisation]")
{
  compare(optimisation::all_references(), "least squares: non-linear problems from two starts");
}

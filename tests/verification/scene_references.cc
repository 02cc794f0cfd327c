// Shipped scenes against closed forms, run within this process as "breccia validate" runs them.
#include "apps/validation/scene_references.h"

#include "tests/compare.h"

TEST_CASE("The hole in the plate widens and narrows as Kirsch found", "[verification]")
{
  compare(apps::scene_references(), "scene plate_with_hole: the hole widens and narrows");
}

TEST_CASE("The bar on a wall carries the force rho c v A, and its wave comes back after 2 L/c", "[verification]")
{
  compare(apps::scene_references(), "scene bar_impact: wave in a bar that meets a wall");
}

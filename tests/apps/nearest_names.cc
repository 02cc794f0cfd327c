#include "apps/scene/nearest_name.h"

#include <catch2/catch.hpp>

TEST_CASE("The edit distance counts insertions, deletions, substitutions and swaps of neighbours", "[apps]")
{
  // Levenshtein's textbook pair has distance 3; a swap counts once (Damerau, 1964, Comm. ACM 7, 171).
  CHECK(apps::edit_distance("kitten", "sitting") == 3);
  CHECK(apps::edit_distance("modulsu", "modulus") == 1);
  CHECK(apps::edit_distance("", "abc") == 3);
  CHECK(apps::edit_distance("abc", "") == 3);
  CHECK(apps::edit_distance("Cohesion", "cohesion") == 0);
}

TEST_CASE("The nearest name is the candidate with the smallest edit distance", "[apps]")
{
  CHECK(apps::nearest_name("Cohesoin", {"Normal modulus", "Cohesion", "Shear ratio"}) == "Cohesion");
  CHECK(apps::nearest_name("anything", {}).empty());
}

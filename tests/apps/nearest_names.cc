#include "apps/text/nearest_name.h"

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

TEST_CASE("A name that contains what was typed is nearer than one of fewer letters", "[apps]")
{
  const std::vector<std::string> materials = {"isotropic elastic", "anisotropic elastic", "damage-plastic concrete"};
  CHECK(apps::nearest_name("Concrete", materials) == "damage-plastic concrete");
  CHECK(apps::nearest_name("elastic", materials) == "isotropic elastic");
  CHECK(apps::nearest_name("isotropc elastic", materials) == "isotropic elastic");
  CHECK(apps::nearest_name("MPI", {"Damping", "Motion"}).empty()); // within a word, and no word like it
  CHECK(apps::nearest_name("Python", {"Damping", "Motion"}).empty());
  CHECK(apps::did_you_mean_or_known("Poisson ratio", {"Shear ratio", "Cohesion"}) == "Known: Shear ratio, Cohesion.");
  CHECK(apps::nearest_name("st", {"material", "step", "test"}).empty()); // too short to be a word
  CHECK(apps::nearest_name("wing", {"Kind", "Density"}).empty());        // half of its letters would be wrong
  CHECK(apps::nearest_name("lode", {"all", "load"}) == "load");          // likewise, but it begins as that does
  CHECK(apps::nearest_name("Kidn", {"Kind", "Density"}) == "Kind");
}

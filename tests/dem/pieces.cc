#include "dem/neighbours/pieces.h"

#include "clusters.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace
{
  constexpr double r = 1e-3;

  dem::Pieces pieces_of(const dem::Packing &packing)
  {
    return dem::find_pieces(packing.size(), dem::find_pairs(packing.centre, packing.radius, 1.2, 0.0, std::nullopt));
  }

  void append(dem::Packing &to, const dem::Packing &what, const Eigen::Vector3d &shift)
  {
    for (const auto &x : what.centre)
      to.centre.push_back(x + shift);
    to.radius.insert(to.radius.end(), what.radius.begin(), what.radius.end());
  }
} // namespace

TEST_CASE("a body in one piece is found as one, without strays", "[dem]")
{
  const dem::Pieces pieces = pieces_of(cluster::cubic_lattice(4, 5, 6, r));
  CHECK(pieces.size == std::vector<std::size_t>{120});
  CHECK(pieces.strays() == 0);
}

TEST_CASE("pieces of a specimen are counted, the largest first, strays among them", "[dem]")
{
  dem::Packing packing = cluster::cubic_lattice(1, 1, 1, r);
  append(packing, cluster::cubic_lattice(2, 2, 3, r), {0.04, 0, 0});
  append(packing, cluster::cubic_lattice(3, 3, 3, r), {0, 0.04, 0});
  append(packing, cluster::cubic_lattice(1, 1, 1, r), {0, 0, 0.5});
  const dem::Pieces pieces = pieces_of(packing);
  CHECK(pieces.size == std::vector<std::size_t>{27, 12, 1, 1});
  CHECK(pieces.strays() == 2);
  CHECK(pieces.piece.front() == 2);
  CHECK(pieces.piece[1] == 1);
  CHECK(pieces.piece[13] == 0);
  CHECK(pieces.piece.back() == 3);
}

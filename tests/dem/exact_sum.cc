// Sums without loss: against integers of 128 bits, against expansions of doubles (Shewchuk), and against closed cases.
#include "dem/ranks/exact_sum.h"

#include "clusters.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace
{
  using Limits                = std::numeric_limits<double>;
  __extension__ using Integer = __int128;

  double exact_sum(const std::vector<double> &all)
  {
    dem::ExactSum sum;
    for (const double each : all)
      sum.add(each);
    return sum.value();
  }

  /**
   * A second method: the sum as an expansion, doubles that do not overlap and add up to it exactly (Shewchuk, 1997, Discrete Comput. Geom. 18,
   * 305), added up from the largest; what is left decides a tie.
   */
  double sum_of_expansion(const std::vector<double> &all)
  {
    std::vector<double> parts;
    for (double next : all)
      {
        std::vector<double> kept;
        for (const double part : parts)
          {
            const bool   swapped = std::abs(next) < std::abs(part);
            const double large = swapped ? part : next, small = swapped ? next : part;
            const double sum = large + small, lost = small - (sum - large);
            if (lost != 0)
              kept.push_back(lost);
            next = sum;
          }
        kept.push_back(next);
        parts = kept;
      }
    double sum = 0, lost = 0;
    while (!parts.empty() && lost == 0)
      {
        const double part = parts.back(), before = sum;
        parts.pop_back();
        sum  = before + part;
        lost = part - (sum - before);
      }
    if (!parts.empty() &&
        (lost > 0) == (parts.back() > 0)) // a tie that was rounded to even, with more of the same sign below it
      {
        const double away = sum + 2 * lost;
        if (away - sum == 2 * lost)
          return away;
      }
    return sum;
  }

  bool same_bits_of(const double a, const double b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

  /** Doubles of random bits, with exponents in a range of places below and above one. */
  std::vector<double> random_doubles(const std::uint64_t seed, const std::size_t count, const int least, const int most)
  {
    std::mt19937_64     bits(seed);
    std::vector<double> all(count);
    for (double &each : all)
      {
        const int place = least + static_cast<int>(bits() % static_cast<std::uint64_t>(most - least + 1));
        each            = std::ldexp(1.0 + std::ldexp(static_cast<double>(bits() >> 12), -52), place);
        each            = bits() % 2 == 0 ? each : -each;
      }
    return all;
  }
} // namespace

TEST_CASE("an exact sum is the nearest double of the sum of integers of 128 bits", "[ranks]")
{
  std::mt19937_64 bits(11);
  for (int trial = 0; trial < 2000; ++trial)
    {
      dem::ExactSum sum;
      Integer       integers = 0;
      for (int i = 0; i < 40; ++i)
        {
          const auto   mantissa = static_cast<std::int64_t>(bits()) >> (11 + bits() % 50);
          const int    place    = static_cast<int>(bits() % 60);
          const double value    = std::ldexp(static_cast<double>(mantissa), place);
          integers += static_cast<Integer>(mantissa) * (static_cast<Integer>(1) << place);
          sum.add(std::ldexp(value, -700));
        }
      REQUIRE(same_bits_of(sum.value(), std::ldexp(static_cast<double>(integers), -700)));
    }
}

TEST_CASE("an exact sum is that of an expansion, whatever the exponents and however much cancels", "[ranks]")
{
  for (const auto &[least, most] :
       {std::pair{-1022, 1000}, std::pair{-60, 60}, std::pair{-1022, -960}, std::pair{-3, 3}})
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
      {
        std::vector<double> all = random_doubles(seed, 30, least, most);
        const std::size_t   n   = all.size();
        for (std::size_t i = 0; i + 3 < n; ++i) // all but a few cancel, or nearly so
          all.push_back(seed % 2 == 0 ? -all[i] : std::nextafter(-all[i], 0.0));
        REQUIRE(same_bits_of(exact_sum(all), sum_of_expansion(all)));
      }
}

TEST_CASE("an exact sum rounds once, to the nearest, and ties to even", "[ranks]")
{
  const double two53 = std::ldexp(1.0, 53), tiny = Limits::denorm_min();
  CHECK(exact_sum({1e16, 1.0, 1e-16}) == 10000000000000002.0);
  CHECK(exact_sum({two53, 1.0}) == two53);
  CHECK(exact_sum({two53, 1.0, tiny}) == two53 + 2);
  CHECK(exact_sum({two53, 1.0, -tiny}) == two53);
  CHECK(exact_sum({two53 + 2, 1.0}) == two53 + 4);
  CHECK(exact_sum({two53 + 2, 1.0, -tiny}) == two53 + 2);
  CHECK(exact_sum({-two53, -1.0, -tiny}) == -two53 - 2);
  CHECK(exact_sum(std::vector<double>(10, 0.1)) == 1.0);
  CHECK(exact_sum({2 * two53 - 2, 1.0}) == 2 * two53); // up into the next exponent
}

TEST_CASE("an exact sum has the smallest doubles, and sums that overflow on their way", "[ranks]")
{
  const double tiny = Limits::denorm_min(), least = Limits::min(), most = Limits::max();
  CHECK(exact_sum({}) == 0.0);
  CHECK_FALSE(std::signbit(exact_sum({-0.0, 1.0, -1.0})));
  CHECK(same_bits_of(exact_sum({tiny, tiny, tiny}), 3 * tiny));
  CHECK(same_bits_of(exact_sum({least, -tiny}), least - tiny));
  CHECK(same_bits_of(exact_sum({least - tiny, tiny}), least));
  CHECK(same_bits_of(exact_sum({1e300, -tiny, -1e300}), -tiny));
  CHECK(exact_sum({most, most, most, -most, -most}) == most);
  const double half_digit = std::ldexp(1.0, 970); // half of the last digit of the largest double
  CHECK(exact_sum({most, half_digit, -tiny}) == most);
  CHECK(exact_sum({most, half_digit}) == Limits::infinity());
  CHECK(exact_sum({-most, -most}) == -Limits::infinity());
  dem::ExactSum doubled; // as far beyond the largest double as the highest limb alone reaches
  doubled.add(most);
  for (int i = 0; i < 29; ++i)
    {
      const dem::ExactSum same = doubled;
      doubled.add(same);
    }
  CHECK(doubled.value() == Limits::infinity());
}

TEST_CASE("an exact sum keeps infinities and NaN as IEEE 754 adds them", "[ranks]")
{
  const double infinite = Limits::infinity();
  CHECK(exact_sum({1.0, infinite, -1e300}) == infinite);
  CHECK(exact_sum({-infinite, 1e300, -infinite}) == -infinite);
  CHECK(std::isnan(exact_sum({infinite, 1.0, -infinite})));
  CHECK(std::isnan(exact_sum({1.0, Limits::quiet_NaN()})));
  dem::ExactSum one, other;
  one.add(infinite);
  other.add(-1.0);
  other.add(one);
  CHECK(other.value() == infinite);
  one.add(Limits::quiet_NaN());
  other.add(one);
  CHECK(std::isnan(other.value()));
}

TEST_CASE("an exact sum is the same for any order and any split", "[ranks]")
{
  std::vector<double> all      = random_doubles(5, 3000, -400, 400);
  const double        expected = sum_of_expansion(all);
  std::mt19937_64     bits(6);
  for (int trial = 0; trial < 30; ++trial)
    {
      std::shuffle(all.begin(), all.end(), bits);
      std::vector<dem::ExactSum> parts(1 + bits() % 9);
      for (const double each : all)
        parts[bits() % parts.size()].add(each);
      std::shuffle(parts.begin(), parts.end(), bits);
      dem::ExactSum sum;
      for (const dem::ExactSum &part : parts)
        sum.add(part);
      REQUIRE(same_bits_of(sum.value(), expected));
    }
}

TEST_CASE("mean damage is the exact sum over links in whatever order", "[ranks]")
{
  const dem::Packing packing = cluster::random_cluster(7, 300, 0.7e-3, 1e-3);
  dem::Specimen      body(packing, cluster::bonded(1.4), cluster::concrete());
  for (std::size_t i = 0; i < packing.size(); ++i)
    body.set_velocity(i, 300 * packing.centre[i], Eigen::Vector3d::Zero());
  body.advance(300);
  const dem::LinkOutput links = body.links();
  dem::ExactSum         sum;
  double                made = 0;
  for (std::size_t l = links.kind.size(); l-- > 0;)
    if (links.kind[l] != dem::LinkOutput::contact)
      {
        sum.add(links.kind[l] == dem::LinkOutput::broken ? 1.0 : links.damage[l]);
        ++made;
      }
  REQUIRE(body.mean_damage() > 0.1);
  REQUIRE(body.counts().broken > 0);
  CHECK(same_bits_of(body.mean_damage(), sum.value() / made));
}

TEST_CASE("an exact sum passes on its carries before they overflow", "[ranks][slow]")
{
  dem::ExactSum          sum;
  const double           value = std::ldexp(2 - std::ldexp(1.0, -52), 40); // every bit of its limbs set
  constexpr std::int64_t count = (std::int64_t{1} << 31) + 5;
  for (std::int64_t i = 0; i < count; ++i)
    sum.add(value);
  const Integer integers = static_cast<Integer>(count) * ((std::int64_t{1} << 53) - 1);
  CHECK(sum.value() == std::ldexp(static_cast<double>(integers), -12));
}

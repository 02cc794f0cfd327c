// Packs against single numbers: doc/theory/numbers.md.
#include "dem/core/exponential.h"
#include "dem/core/records.h"
#include "dem/core/simd.h"
#include "dem/core/uniform_random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace
{
  std::uint64_t bits_of(const double number)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof(bits));
    return bits;
  }

  /** Numbers of all magnitudes and both signs, and those at which operations turn. */
  std::vector<double> numbers()
  {
    std::vector<double> all = {0.0, -0.0, 1.0, -1.0, 0.5, 1.5, 2.5, -2.5, 1e100, -1e-100};
    dem::UniformRandom  random(11);
    while (all.size() < 4096)
      {
        const double sign = random() < 0.5 ? -1 : 1, mantissa = 1 + random(), power = std::floor(120 * random()) - 60;
        all.push_back(sign * std::ldexp(mantissa, static_cast<int>(power)));
      }
    return all;
  }

  dem::Pack from(const std::vector<double> &all, const std::size_t first)
  {
    return dem::Pack::load_unaligned(&all[first]);
  }

  /** How many lanes differ in a bit from what single numbers give. */
  template <typename OfPacks, typename OfNumbers>
  int differing(const OfPacks &of_packs, const OfNumbers &of_numbers)
  {
    const std::vector<double> all   = numbers();
    const std::size_t         last  = all.size() - dem::pack_size;
    int                       count = 0;
    for (std::size_t n = 0; n < last; ++n)
      {
        const std::size_t a = n, b = (7 * n + 3) % last, c = (13 * n + 5) % last;
        const dem::Pack   result = of_packs(from(all, a), from(all, b), from(all, c));
        for (int lane = 0; lane < dem::pack_size; ++lane)
          {
            const auto at = static_cast<std::size_t>(lane);
            count += bits_of(result[lane]) != bits_of(of_numbers(all[a + at], all[b + at], all[c + at]));
          }
      }
    return count;
  }

  /** The same function of both. */
  template <typename Function>
  int differing(const Function &f)
  {
    return differing(f, f);
  }
} // namespace

TEST_CASE("a pack does to each lane what one number has done to it, to the last bit", "[dem]")
{
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return a + b - c; }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &) { return a * b; }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &) { return a / (b * b + a * a); }) == 0);
  CHECK(differing([](const auto &a, const auto &, const auto &) { return square_root(maximum(a, a * a)); },
                  [](const double a, const double, const double) { return std::sqrt(a > a * a ? a : a * a); }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &) { return maximum(a, b); },
                  [](const double a, const double b, const double) { return a > b ? a : b; }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &) { return minimum(a, b); },
                  [](const double a, const double b, const double) { return a < b ? a : b; }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return multiply_add(a, b, c); },
                  [](const double a, const double b, const double c) { return std::fma(a, b, c); }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return multiply_subtract(a, b, c); },
                  [](const double a, const double b, const double c) { return std::fma(a, b, -c); }) == 0);
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return negative_multiply_add(a, b, c); },
                  [](const double a, const double b, const double c) { return std::fma(-a, b, c); }) == 0);
  CHECK(differing([](const auto &a, const auto &, const auto &) { return dem::exponential(dem::Pack(minimum(a, -a))); },
                  [](const double a, const double, const double) { return dem::exponential(a < -a ? a : -a); }) == 0);
}

TEST_CASE("lanes of a pack are compared and chosen one by one", "[dem]")
{
  const auto chosen = [](const bool where, const double a, const double b) { return where ? a : b; };
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return select(a > b && !(b <= c), a, b); },
                  [&](const double a, const double b, const double c) { return chosen(a > b && !(b <= c), a, b); }) ==
        0);
  CHECK(differing([](const auto &a, const auto &b, const auto &c) { return select(a >= b || b < c, c, b); },
                  [&](const double a, const double b, const double c) { return chosen(a >= b || b < c, c, b); }) == 0);
  const double    nan   = std::numeric_limits<double>::quiet_NaN();
  const dem::Pack mixed = dem::pack_of([&](const int lane) { return lane == 5 ? nan : 1.0; });
  CHECK(std::isnan(maximum(dem::Pack(0.0), mixed)[5])); // the second one, where either is not a number
  CHECK(maximum(mixed, dem::Pack(2.0))[5] == 2.0);
  for (int lane = 0; lane < dem::pack_size; ++lane)
    CHECK(any(dem::pack_of([&](const int l) { return l == lane ? 1.0 : 0.0; }) > dem::Pack(0.5)));
  CHECK_FALSE(any(dem::Pack(0.0) > dem::Pack(0.5)));
  CHECK(any(dem::PackMask(true)));
  CHECK_FALSE(any(dem::PackMask(false)));
}

TEST_CASE("a multiply-add in parts is rounded as the fused one", "[dem]")
{
  // Random products and sums, those that cancel to the last digits, and ties.
  using Two [[gnu::vector_size(16)]] = double;
  dem::UniformRandom random(2);
  const auto number = [&] { return (2 * random() - 1) * std::ldexp(1.0, static_cast<int>(80 * random()) - 40); };
  int        wrong  = 0;
  for (int n = 0; n < 200000; ++n)
    {
      const double a = number(), b = number(), product = a * b;
      const double whole = std::floor(1e6 * a), other = std::floor(1e6 * b);
      for (const double c :
           {number(), -product, product * (1e-16 * (n % 7) - 1), std::ldexp(product, n % 120 - 60), 0.0})
        {
          wrong +=
            bits_of(dem::multiply_add_in_parts(Two{a, a}, Two{b, b}, Two{c, c})[1]) != bits_of(std::fma(a, b, c));
          wrong += dem::multiply_add_in_parts(Two{whole}, Two{other}, Two{c})[0] != std::fma(whole, other, c);
        }
    }
  CHECK(wrong == 0);
}

TEST_CASE("a multiply-add in parts is rounded as the fused one where rounding twice would err", "[dem]")
{
  // Few bits, or all of them, make ties of the second rounding: with c a power of two near a unit of the product above all.
  using Two [[gnu::vector_size(16)]] = double;
  dem::UniformRandom random(3);
  const auto         whole  = [&](const int below) { return static_cast<int>(below * random()); };
  const auto         number = [&] {
    const double scale = std::ldexp(1.0, whole(53)), fraction = 1 + random();
    const double bits = random() < 0.5 ? std::floor(fraction * scale) / scale : 2 - 1 / (2 * scale);
    return std::ldexp(random() < 0.5 ? bits : -bits, whole(60) - 30);
  };
  int wrong = 0, twice = 0;
  for (int n = 0; n < 1000000; ++n)
    {
      const double a = number(), b = number(), product = a * b;
      const double c =
        std::ldexp(n % 2 == 0 ? 1.0 : number(), std::ilogb(product) + whole(112) - 56) + (n % 3 == 0 ? -product : 0.0);
      const double fused = std::fma(a, b, c);
      wrong += bits_of(dem::multiply_add_in_parts(Two{a, b}, Two{b, a}, Two{c, c})[n % 2]) != bits_of(fused);
      twice += product + c != fused;
    }
  CHECK(wrong == 0);
  CHECK(twice > 10000); // what a test could not miss
}

TEST_CASE("a multiply-add in parts is rounded as the fused one at both ends of the range, with the sign of zeros",
          "[dem]")
{
  using Two [[gnu::vector_size(16)]] = double;
  using Limits                       = std::numeric_limits<double>;
  dem::UniformRandom random(4);
  const double       ends[] = {
          0.0, 1.0, Limits::denorm_min(), Limits::min(), Limits::max(), Limits::infinity(), Limits::quiet_NaN()};
  // Of any size, the ends themselves, and pairs whose product lies around the smallest or the largest numbers.
  const auto sized = [&](const int exponent) {
    return std::ldexp(random() < 0.5 ? -1 - random() : 1 + random(), exponent);
  };
  const auto number = [&] {
    const double end = ends[static_cast<int>(7 * random())];
    return random() < 0.2 ? std::copysign(end, random() - 0.5) : sized(static_cast<int>(2098 * random()) - 1074);
  };
  int wrong = 0, subnormal = 0, infinite = 0, negative_zeros = 0;
  for (int n = 0; n < 1000000; ++n)
    {
      const int    size = static_cast<int>(1000 * random()), edge = n % 3 == 0 ? -1074 : 1020;
      const double a     = n % 3 == 2 ? number() : sized(edge < 0 ? -size : size),
                   b     = n % 3 == 2 ? number() : sized(edge + (edge < 0 ? size + n % 220 : -size - n % 60)),
                   c     = n % 5 == 0 ? -(a * b) :
                           n % 5 == 1 ? number() :
                                        sized(edge + (edge < 0 ? n % 240 : -n % 120));
      const Two    parts = dem::multiply_add_in_parts(Two{a, 1.0}, Two{b, 2.0}, Two{c, 3.0});
      const double fused = std::fma(a, b, c);
      wrong += std::isnan(fused) ? !std::isnan(parts[0]) : bits_of(parts[0]) != bits_of(fused);
      wrong += parts[1] != 5.0;
      subnormal += fused != 0 && std::fabs(fused) < Limits::min();
      infinite += std::isinf(fused);
      negative_zeros += fused == 0 && std::signbit(fused);
    }
  CHECK(wrong == 0);
  CHECK(subnormal > 10000);
  CHECK(infinite > 10000);
  CHECK(negative_zeros > 1000);
}

TEST_CASE("sums over a pack have one order for every width", "[dem]")
{
  const std::vector<double> all   = numbers();
  int                       wrong = 0;
  for (std::size_t n = 0; n + dem::pack_size < all.size(); ++n)
    {
      const double *v = &all[n];
      wrong +=
        bits_of(sum_of(from(all, n))) != bits_of(((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])));
    }
  CHECK(wrong == 0);
}

TEST_CASE("records become packs and packs records, lane by lane", "[dem]")
{
  dem::Pack rows[8];
  for (int i = 0; i < 8; ++i)
    rows[i] = dem::pack_of([&](const int lane) { return 10.0 * i + lane; });
  dem::transpose(rows);
  for (int i = 0; i < 8; ++i)
    for (int lane = 0; lane < 8; ++lane)
      CHECK(rows[i][lane] == 10.0 * lane + i);
}

TEST_CASE("halves of a pack hold its first and its last four lanes", "[dem]")
{
  const dem::Pack all = dem::pack_of([](const int lane) { return 1.0 + lane; });
  for (int lane = 0; lane < 4; ++lane)
    {
      CHECK(dem::low_half(all)[lane] == 1.0 + lane);
      CHECK(dem::high_half(all)[lane] == 5.0 + lane);
    }
}

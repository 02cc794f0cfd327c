#pragma once

#include <cstdint>
#include <random>

namespace dem
{
  /**
   * Random numbers that are the same on every machine and with every standard library.
   *
   * The generator is fixed by the C++ standard (64-bit Mersenne twister, Matsumoto and Nishimura, 1998); the distributions
   * of the standard library are not, hence the conversion of the upper 53 bits by hand.
   */
  class UniformRandom
  {
  public:
    explicit UniformRandom(const std::uint64_t seed)
      : engine(seed)
    {
    }

    /** The next number in [0, 1), a multiple of 2^-53. */
    double operator()() { return static_cast<double>(engine() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine;
  };

  /** Bits of a number well mixed (finaliser of splitmix64; Steele, Lea, Flood, OOPSLA 2014). */
  constexpr std::uint64_t mixed(std::uint64_t z)
  {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
} // namespace dem

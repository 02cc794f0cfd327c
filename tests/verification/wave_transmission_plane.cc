// Waves from particles into a continuum in the plane and in a bar of spheres: doc/theory/volume-coupling.md, 6.
#include "tests/verification/wave_fixture.h"

using namespace waves;

TEST_CASE("wave transmission: the table of a hexagonal plane, waves of compression and of shear",
          "[verification][volume][slow]")
{
  const auto wave = [](const std::string &name, const bool shear) {
    return [name, shear](const double wavelength) { return strip(name, wavelength, shear); };
  };
  check_table({{8, 0.003, 0},
               {12, 0.007, 0.071},
               {14, 0.002, 0.555},
               {16, 0.001, 0.824},
               {20, 0, 0.974},
               {24, 0, 0.996},
               {32, 0, 1}},
              0.01, wave("absorber", false));
  check_table({{8, 0.001, 0},
               {12, 0.001, 0.027},
               {14, 0.001, 0.269},
               {16, 0.001, 0.535},
               {20, 0, 0.854},
               {24, 0, 0.955},
               {32, 0, 0.994}},
              0.01, wave("absorber p=2", false));
  check_table({{8, 1, 0}, {12, 0.788, 0.217}, {16, 0, 1}, {24, 0, 1}}, 0.01, wave("coarse", false));
  check_table({{8, 0.004, 0}, {12, 0.002, 0.037}, {16, 0.001, 0.709}, {24, 0, 0.988}}, 0.01,
              [](const double wavelength) {
                coupling::WaveCase one      = strip("absorber", wavelength, true);
                one.method.proportions.grid = 0.875;
                return one;
              });
}

TEST_CASE("wave transmission: waves that come at an angle pass where elements carry them, and none comes back",
          "[verification][volume][slow]")
{
  struct Way
  {
    double degrees;
    bool   shear;
    double wavelength;
  };
  for (const Way &way : std::vector<Way>{{30, false, 8},
                                         {30, false, 12},
                                         {45, false, 12},
                                         {45, false, 24},
                                         {30, true, 8},
                                         {30, true, 12},
                                         {45, true, 12},
                                         {30, true, 24}})
    {
      INFO(way.degrees << " degrees, " << (way.shear ? "shear, " : "compression, ") << way.wavelength << " spacings");
      coupling::WaveCase wave = chain("absorber", way.wavelength);
      wave.medium.lattice     = coupling::WaveMedium::Lattice::plane;
      wave.element            = 4;
      wave.shear              = way.shear;
      wave.angle              = way.degrees * M_PI / 180;
      const auto answer       = coupling::transmit(wave);
      CHECK(answer.reflected <= 0.03);
      if (way.wavelength >= 24)
        CHECK(answer.transmitted >= 0.95);
    }
}

TEST_CASE("wave transmission: in a bar of spheres without order little comes back, and long waves pass",
          "[verification][volume][slow]")
{
  constexpr std::int64_t bars = 3; // of the same kind, of which each sends another part back
  for (const double wavelength : {8.0, 16.0, 24.0})
    {
      double reflected = 0;
      for (std::int64_t bar = 1; bar <= bars; ++bar)
        {
          INFO(wavelength << " diameters, bar " << bar);
          coupling::WaveCase wave = chain("absorber", wavelength);
          wave.medium.lattice     = coupling::WaveMedium::Lattice::bar;
          wave.medium.seed        = bar;
          wave.element            = 4;
          const auto answer       = coupling::transmit(wave);
          reflected += answer.reflected / bars;
          CHECK(answer.left_behind <= answer.left_behind_alone + 0.005);
          if (wavelength >= 24)
            CHECK(answer.transmitted >= 0.95 * answer.unhindered);
        }
      INFO(wavelength << " diameters");
      // Particles without order scatter short waves themselves: what is beyond the overlap sends some back too, and then does not.
      if (wavelength >= 16)
        CHECK(reflected <= 0.03);
    }
}

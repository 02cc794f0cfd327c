// Waves from particles into a continuum: tables of spec/coupling.md, 3.5 and 3.6, as doc/theory/volume-coupling.md, 6, has them.
#include "tests/verification/wave_fixture.h"

using namespace waves;

TEST_CASE("wave transmission: elements that begin at a particle reflect as the closed form says, by simulation too",
          "[verification][volume][slow]")
{
  struct Known
  {
    std::int64_t element;
    double       wavelength, reflected;
  };
  for (const Known &known : std::vector<Known>{{2, 8, 0.0320},
                                               {2, 12, 0.0037},
                                               {4, 12, 1},
                                               {4, 16, 0.0490},
                                               {4, 20, 0.0138},
                                               {8, 24, 1},
                                               {8, 26, 0.3350},
                                               {8, 28, 0.1457},
                                               {8, 32, 0.0537},
                                               {8, 40, 0.0151},
                                               {8, 64, 0.0017}})
    {
      INFO(known.element << " spacings, wavelength " << known.wavelength);
      CHECK(coupling::edge_to_edge_reflection(known.element, known.wavelength) == Approx(known.reflected).margin(6e-5));
    }
  // A packet has more than one wavelength: 0.01 where the form is not steep.
  for (const Known &known : std::vector<Known>{{4, 20, 0.0138}, {8, 32, 0.0537}, {8, 40, 0.0151}, {2, 12, 0.0037}})
    {
      coupling::WaveCase wave = chain("constrained", known.wavelength);
      wave.element            = known.element;
      wave.overlap            = 0;
      wave.step_factor        = 0.1;
      const auto answer       = coupling::transmit(wave);
      CHECK(answer.reflected == Approx(known.reflected).margin(0.01));
      CHECK(answer.reflected + answer.transmitted == Approx(1).margin(2e-3));
    }
}

TEST_CASE(
  "S12: a packet reflects at most 2 % at any wavelength, 1 % where elements carry it, and is absorbed where not",
  "[verification][volume][slow][S12]")
{
  for (const double wavelength : {4.0, 5.0, 6.0, 8.0, 12.0, 16.0, 20.0, 22.0, 24.0, 28.0, 32.0, 40.0, 48.0, 64.0, 96.0})
    {
      INFO("wavelength " << wavelength << " spacings");
      const auto sharp = coupling::transmit(chain("absorber", wavelength)),
                 soft  = coupling::transmit(chain("absorber p=2", wavelength));
      CHECK(sharp.reflected <= 0.02);
      CHECK(soft.reflected <= 0.005);
      if (wavelength >= 28) // elements of eight spacings carry waves from 25 on
        CHECK(sharp.reflected <= 0.01);
      if (wavelength <= 12) // and nothing of these: what does not come back is absorbed
        CHECK(sharp.absorbed >= 0.98);
      if (wavelength >= 40)
        CHECK(sharp.transmitted >= 0.97);
      if (wavelength >= 48)
        {
          CHECK(sharp.transmitted >= 0.99);
          CHECK(soft.transmitted >= 0.96);
        }
      for (const auto &answer : {sharp, soft})
        {
          CHECK(answer.reflected + answer.transmitted + answer.absorbed == Approx(1).margin(2e-3));
          CHECK(std::fabs(answer.made) <= 1e-9);
        }
    }
  for (const double wavelength : {6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 24.0, 32.0})
    {
      INFO("elements of 4 spacings, wavelength " << wavelength << " spacings");
      for (const auto &[name, limit] : {std::pair<const char *, double>{"absorber", 0.035}, {"absorber p=2", 0.006}})
        {
          coupling::WaveCase wave = chain(name, wavelength);
          wave.element            = 4;
          CHECK(coupling::transmit(wave).reflected <= limit);
        }
    }
}

namespace
{
  /** With the time step of the tables without an absorber, and their masses of nodes. */
  auto quarter(const std::string &name)
  {
    return [name](const double wavelength) {
      coupling::WaveCase wave = chain(name, wavelength);
      wave.step_factor        = 0.25;
      wave.nearest_masses     = true;
      return wave;
    };
  }
} // namespace

TEST_CASE("wave transmission: the table of a row of particles, constrained with double stiffness",
          "[verification][volume][slow]")
{
  check_table({{8, 1, 0},
               {16, 1, 0},
               {20, 0.99, 0.01},
               {24, 0.90, 0.10},
               {28, 0.26, 0.74},
               {32, 0.149, 0.852},
               {48, 0.014, 0.986},
               {96, 0.109, 0.897}},
              0.01, quarter("legacy"));
}

TEST_CASE("wave transmission: the tables of a row of particles, multipliers without an absorber",
          "[verification][volume][slow]")
{
  check_table({{8, 1, 0},
               {16, 1, 0},
               {20, 1, 0},
               {24, 0.85, 0.15},
               {28, 0.036, 0.964},
               {32, 0.003, 0.998},
               {48, 0.001, 1},
               {96, 0, 1}},
              0.01, quarter("strict"));
  check_table(
    {{8, 1, 0}, {16, 1, 0}, {20, 1, 0}, {24, 0.83, 0.18}, {28, 0.024, 0.976}, {32, 0, 1}, {48, 0, 1}, {96, 0, 1}}, 0.01,
    quarter("coarse"));
}

TEST_CASE("wave transmission: multipliers in a row of particles answer as a program of their own does",
          "[verification][volume][slow]")
{
  using row_and_elements::Ties;
  for (const auto &[name, ties] :
       {std::pair<const char *, Ties>{"strict", Ties::strict}, {"coarse", Ties::coarse}, {"lumped", Ties::lumped}})
    for (const double wavelength : {8.0, 16.0, 24.0, 28.0, 48.0})
      {
        INFO(name << ", wavelength " << wavelength << " spacings");
        const auto answer = coupling::transmit(quarter(name)(wavelength));
        const auto own    = row_and_elements::transmit({ties, wavelength, 8, 4, 0.25, {0, 0, 0, 0, 0}, true});
        // Close to the cut-off a part of the packet is still on its way when it is measured.
        const double within = wavelength == 24 ? 5e-3 : 2e-3;
        CHECK(answer.reflected == Approx(own.reflected).margin(within));
        CHECK(answer.transmitted == Approx(own.transmitted).margin(within));
      }
}

TEST_CASE("wave transmission: the table of a row of particles, lumped multipliers", "[verification][volume][slow]")
{
  check_table({{8, 0.015, 0},
               {12, 0.11, 0},
               {16, 0.32, 0},
               {20, 0.52, 0},
               {24, 0.28, 0.11},
               {28, 0.022, 0.72},
               {32, 0.002, 0.82},
               {48, 0, 0.949},
               {96, 0, 0.997}},
              0.01, quarter("lumped"));
}

namespace
{
  /** A table of absorbers: p, where the layer begins [elements], rate [over wave speed and element size]. */
  struct AbsorberTable
  {
    int                sharpness;
    double             layer, rate;
    double             grid; ///< of averages that go on beyond the particles, for the same answer [elements]
    std::vector<Entry> entries;
  };

  const std::vector<AbsorberTable> absorber_tables = {{3,
                                                       4,
                                                       8,
                                                       0.8243,
                                                       {{8, 0, 0},
                                                        {12, 0.002, 0},
                                                        {16, 0.006, 0},
                                                        {20, 0.010, 0},
                                                        {24, 0.020, 0.077},
                                                        {28, 0.002, 0.643},
                                                        {32, 0.001, 0.873},
                                                        {40, 0, 0.986},
                                                        {48, 0, 1},
                                                        {64, 0, 1},
                                                        {96, 0, 1}}},
                                                      {2,
                                                       4,
                                                       8,
                                                       0.8243,
                                                       {{8, 0, 0},
                                                        {12, 0.001, 0},
                                                        {16, 0.003, 0},
                                                        {20, 0.001, 0},
                                                        {24, 0.003, 0.033},
                                                        {28, 0.001, 0.343},
                                                        {32, 0.001, 0.607},
                                                        {40, 0.001, 0.885},
                                                        {48, 0, 0.967},
                                                        {64, 0, 0.996},
                                                        {96, 0, 1}}},
                                                      {3,
                                                       2,
                                                       16,
                                                       0.817,
                                                       {{8, 0, 0},
                                                        {12, 0.001, 0},
                                                        {16, 0.009, 0},
                                                        {20, 0.015, 0},
                                                        {24, 0.012, 0.067},
                                                        {28, 0.002, 0.585},
                                                        {32, 0.001, 0.836},
                                                        {40, 0, 0.976},
                                                        {48, 0, 0.997},
                                                        {64, 0, 1}}}};
} // namespace

TEST_CASE("wave transmission: the tables of a row of particles, absorbers", "[verification][volume][slow]")
{
  for (const AbsorberTable &table : absorber_tables)
    {
      INFO("p = " << table.sharpness << ", " << table.layer << " elements before the overlap");
      check_table(table.entries, 0.01, [&](const double wavelength) {
        // In time as the exponential does; what lies beyond the particles takes part in averages, which shifts them a little.
        coupling::WaveCase wave       = chain(table.sharpness == 3 ? "absorber" : "absorber p=2", wavelength);
        wave.method.proportions.layer = table.layer;
        wave.method.proportions.rate  = table.rate;
        wave.method.proportions.grid  = table.grid;
        wave.method.proportions.phase = 0.25;
        return wave;
      });
    }
}

TEST_CASE(
  "wave transmission: averages that end with the particles, the last of them light, give the tables of absorbers",
  "[verification][volume][slow]")
{
  using namespace row_and_elements;
  for (const AbsorberTable &table : absorber_tables)
    {
      INFO("p = " << table.sharpness << ", " << table.layer << " elements before the overlap");
      check_row(table.entries, 0.005, [&](const double wavelength) {
        Row row{Ties::coarse, wavelength};
        row.step     = 0.8;
        row.absorber = {table.sharpness, 0.875 * row.element, table.layer * row.element, table.rate / row.element,
                        1e-3};
        return row;
      });
    }
}

TEST_CASE("wave transmission: the figures of elements of four spacings, by both programs",
          "[verification][volume][slow]")
{
  using namespace row_and_elements;
  const std::vector<Entry> soft{{20, 0, 0.899}, {24, 0, 0.976}, {32, 0, 0.998}};
  // Here a thousandth of the last particle's mass and where the grid lies are a hundredth of what passes.
  const auto row = [](const int sharpness) {
    return [sharpness](const double wavelength) {
      Row one{Ties::coarse, wavelength, 4};
      one.step     = 0.8;
      one.absorber = {sharpness, 3.5, 16, 2, 1e-4, Smooth::grid, 0.6};
      return one;
    };
  };
  check_row(soft, 0.01, row(2));
  check_row({{16, 0, 0.908}, {24, 0, 1}}, 0.01, row(3));
  check_row({{20, 0, 1.0}}, 0.05, row(3)); // printed with one decimal
  check_table(soft, 0.01, [](const double wavelength) {
    coupling::WaveCase wave       = chain("absorber p=2", wavelength);
    wave.element                  = 4;
    wave.method.proportions.grid  = 0.81;
    wave.method.proportions.phase = 0.25;
    return wave;
  });
}

TEST_CASE("wave transmission: averages by a normal distribution give the table of such an absorber",
          "[verification][volume][slow]")
{
  using namespace row_and_elements;
  check_row({{8, 0, 0},
             {12, 0, 0},
             {16, 0.001, 0},
             {20, 0.006, 0},
             {24, 0.013, 0.067},
             {28, 0.002, 0.581},
             {32, 0.002, 0.837},
             {40, 0, 0.980},
             {48, 0, 0.999},
             {64, 0, 1},
             {96, 0, 1}},
            0.005, [](const double wavelength) {
              Row row{Ties::coarse, wavelength};
              row.step     = 0.8;
              row.absorber = {3, 0.75 * row.element, 32, 1, 1e-3, Smooth::normal};
              return row;
            });
}

TEST_CASE("wave transmission: a fit by splines to the particles of the layer gives the table of what reflects",
          "[verification][volume][slow]")
{
  using namespace row_and_elements;
  check_row({{8, 0, 0},
             {12, 0, 0},
             {16, 0, 0},
             {20, 0.003, 0},
             {24, 0.049, 0.013},
             {28, 0.161, 0.226},
             {32, 0.096, 0.546},
             {40, 0.003, 0.890},
             {48, 0, 0.980},
             {64, 0, 1},
             {96, 0, 1}},
            0.01, [](const double wavelength) {
              Row row{Ties::coarse, wavelength};
              row.step     = 0.8;
              row.absorber = {1, 16, 64, 0.3, 1e-3, Smooth::projection};
              return row;
            });
}

TEST_CASE("wave transmission: damping what a fit by the overlap's elements leaves gives the tables of that scheme",
          "[verification][volume][slow]")
{
  using namespace row_and_elements;
  const auto damped = [](const int overlap) {
    return [overlap](const double wavelength) {
      Row row{Ties::coarse, wavelength};
      row.overlap       = overlap;
      row.residual_rate = 0.3;
      row.point_masses  = true;
      row.followed      = 7.5;
      return row;
    };
  };
  check_row({{8, 0.001, 0},
             {12, 0.042, 0},
             {16, 0.17, 0},
             {20, 0.47, 0},
             {24, 0.59, 0.16},
             {28, 0.018, 0.918},
             {32, 0, 0.970},
             {48, 0, 0.996},
             {96, 0, 1}},
            0.01, damped(4));
  check_row({{8, 0, 0},
             {12, 0.009, 0},
             {16, 0.22, 0},
             {20, 0.53, 0},
             {24, 0.37, 0.15},
             {28, 0.009, 0.847},
             {32, 0, 0.934},
             {48, 0, 0.992},
             {96, 0, 1}},
            0.01, damped(8));
}

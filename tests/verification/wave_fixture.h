#pragma once

#include "apps/runs/transmission/methods.h"
#include "coupling/transmission/wave_case.h"
#include "tests/verification/row_and_elements.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

/** Packets of waves that run from particles into elements, and tables of what becomes of them. */
namespace waves
{
  constexpr double spacing = 0.01;

  inline coupling::WaveMethod method(const std::string &name)
  {
    const auto &all = apps::wave_methods();
    return *std::find_if(all.begin(), all.end(), [&](const coupling::WaveMethod &m) { return m.name == name; });
  }

  inline coupling::WaveCase chain(const std::string &name, const double spacings)
  {
    coupling::WaveCase wave;
    wave.medium.spacing = spacing;
    wave.medium.modulus = 25e9;
    wave.medium.density = 2400;
    wave.method         = method(name);
    wave.wavelength     = spacings * spacing;
    return wave;
  }

  inline coupling::WaveCase strip(const std::string &name, const double spacings, const bool shear)
  {
    coupling::WaveCase wave       = chain(name, spacings);
    wave.medium.lattice           = coupling::WaveMedium::Lattice::strip;
    wave.element                  = 4;
    wave.shear                    = shear;
    wave.step_factor              = 0.69; // 0.4 of the table's unit
    wave.method.proportions.grid  = 0.8675;
    wave.method.proportions.phase = 0.25;
    return wave;
  }

  /** An entry of a table: wavelength in spacings, reflected, transmitted. */
  struct Entry
  {
    double wavelength, reflected, transmitted;
  };

  /** `answer` gives what becomes of a wavelength, in spacings. */
  template <typename Answer>
  inline void check_answers(const std::vector<Entry> &table, const double within, const Answer &answer)
  {
    for (const Entry &entry : table)
      {
        INFO("wavelength " << entry.wavelength << " spacings");
        const auto found = answer(entry.wavelength);
        CHECK(found.reflected == Approx(entry.reflected).margin(within));
        CHECK(found.transmitted == Approx(entry.transmitted).margin(within));
      }
  }

  template <typename Case>
  inline void check_table(const std::vector<Entry> &table, const double within, const Case &make)
  {
    check_answers(table, within, [&](const double wavelength) { return coupling::transmit(make(wavelength)); });
  }

  /** By the second program. */
  template <typename Make>
  inline void check_row(const std::vector<Entry> &table, const double within, const Make &make)
  {
    check_answers(table, within, [&](const double wavelength) { return row_and_elements::transmit(make(wavelength)); });
  }
} // namespace waves

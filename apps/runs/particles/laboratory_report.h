#pragma once

#include "apps/runs/particles/laboratory_section.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** "compressive_strength": the strength of a test, as summaries name it. */
  const char *strength_name(const SpecimenTestSection &test);

  /** Names of all figures that LaboratoryReport::json() can have. @pre test.given() */
  std::vector<std::string> names_of_figures(const SpecimenTestSection &test);

  /** What a test of section "Laboratory" found: for programs, for the eye, for the terminal. */
  struct LaboratoryReport
  {
    const SpecimenTestSection &requested;
    const dem::LabTest        &test;
    const dem::LabTest        *slower = nullptr; ///< its loading at half the speed; nullptr: there was none

    /** Every figure with its unit; where one is not determined, null and the reason. */
    nlohmann::json json() const;
    /** stress_strain.csv, that at half the speed, and stress_strain.png. @throws postprocess::OutputError */
    void write(const std::filesystem::path &folder, const std::string &title) const;
    /** What casts doubt on these figures, one sentence each. */
    std::vector<std::string> warnings() const;
    /** Strength, moduli, ratio of Poisson and the criteria of a static loading. */
    std::string text() const;

  private:
    nlohmann::json   fracture_json(const dem::TestFigures &found) const; ///< work and friction over the section
    std::string      strength_text(const dem::TestFigures &found) const;
    dem::QuasiStatic how_static() const;
  };
} // namespace apps

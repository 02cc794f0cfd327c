#pragma once

#include "apps/drivers/particles/laboratory_section.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /** What a test of section "Laboratory" found: for programs, for the eye, for the terminal. */
  struct LaboratoryReport
  {
    const SpecimenTestSection &asked;
    const dem::LabTest        &test;

    /** Every figure with its unit; where one is not determined, null and the reason. */
    nlohmann::json json() const;
    /** stress_strain.csv and stress_strain.png. @throws postprocess::OutputError */
    void write(const std::filesystem::path &folder, const std::string &title) const;
    /** Strength, moduli, ratio of Poisson and the criteria of a static loading. */
    std::string text() const;

  private:
    const char *strength_name() const;
  };
} // namespace apps

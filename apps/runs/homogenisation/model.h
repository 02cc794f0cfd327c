#pragma once

#include "apps/models/specimen.h"
#include "apps/runs/homogenisation/moduli.h"
#include "base/entry_path.h"
#include "base/length_unit.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Everything that a sweep of macroscopic stiffness computes from. */
  struct HomogenisationModel
  {
    SpecimenSection::Source         source = SpecimenSection::Source::generator;
    std::string                     file;
    std::optional<base::LengthUnit> length_unit; ///< of the file
    double                          radius = 1e-3, friction = 1;
    std::int64_t                    particles = 1000, seeds = 1;
    double                          normal_modulus = 0, thickness = 0, tolerance = 1e-10;
    std::vector<double>             interaction_ratios, shear_ratios;

    /** Rules between entries. @throws base::InputError */
    void check(const base::EntryPath &root) const;
    /** One for each seed, or that of the file. @throws base::InputError */
    std::vector<dem::Packing> packings() const;
    dem::Packing              made_packing(std::int64_t seed) const;
    HomogenisationQuestion    question(double interaction_ratio, double shear_ratio) const;
  };
} // namespace apps

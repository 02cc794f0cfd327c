#pragma once

#include "apps/drivers/homogenisation/moduli.h"
#include "apps/scene/scene.h"
#include "apps/scene/specimen_section.h"
#include "base/length_unit.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** Scene kind "homogenisation": macroscopic stiffness three ways over interaction ratio and shear ratio, over seeds. */
  class HomogenisationScene : public Scene
  {
  public:
    void        declare(Section &root) override;
    void        check() const override;
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

  private:
    std::vector<dem::Packing> packings() const;
    dem::Packing              made_packing(std::int64_t seed) const;
    HomogenisationQuestion    question(double interaction_ratio, double shear_ratio) const;

    SpecimenSection::Source         source = SpecimenSection::Source::generator;
    std::string                     file;
    std::optional<base::LengthUnit> length_unit; ///< of the file
    double                          radius = 1e-3, friction = 1;
    std::int64_t                    particles = 1000, seeds = 1;
    double                          normal_modulus = 0, thickness = 0, tolerance = 1e-10;
    std::string                     interaction_ratios, shear_ratios;
  };
} // namespace apps

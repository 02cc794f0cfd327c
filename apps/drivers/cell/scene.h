#pragma once

#include "apps/scene/material_section.h"
#include "apps/scene/output_section.h"
#include "apps/scene/scene.h"
#include "apps/scene/specimen_section.h"
#include "apps/scene/time_section.h"
#include "dem/loading/periodic_cell.h"

#include <array>
#include <string>

namespace apps
{
  /** Everything that a run of a periodic cell computes from. */
  struct CellModel
  {
    SpecimenSection         source;
    dem::SpecimenParameters specimen;
    MaterialSection         material;
    dem::CellTestParameters loading;
    OutputSection           output;
  };

  /** Scene kind "cell": a periodic cell led in time along a path of strains and stresses (doc/theory/periodic-cell.md). */
  class CellScene : public Scene
  {
  public:
    static constexpr int most_legs = 9;

    void        declare(Section &root) override;
    void        check() const override;
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

  private:
    struct Leg
    {
      double                     duration = 0; ///< [s]
      std::array<std::string, 6> target;       ///< "strain VALUE" or "stress VALUE"
    };

    void      declare_loading(Section &root);
    CellModel model() const;

    SpecimenSection            source;
    MaterialSection            material;
    dem::Physics               physics;
    TimeSection                time;
    std::int64_t               legs = 1;
    std::array<Leg, most_legs> path;
    double                     servo_time = 1, strain_limit = 0.1, localised_above = 0.5;
    OutputSection              output;
  };
} // namespace apps

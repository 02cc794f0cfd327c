#pragma once

#include "apps/drivers/uniaxial/model.h"
#include "apps/scene/material_section.h"
#include "apps/scene/scene.h"
#include "apps/scene/time_section.h"

namespace apps
{
  /**
   * Scene kind "uniaxial": a bonded-particle specimen pulled and crushed between grips (doc/theory/laboratory-test.md).
   */
  class UniaxialScene : public Scene
  {
  public:
    void        declare(Section &root) override;
    void        check() const override;
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    /** What the scene says, ready to compute. */
    UniaxialModel model() const;

  private:
    SpecimenSection        specimen;
    MaterialSection        material;
    dem::Physics           physics;
    TimeSection            time;
    GravitySection         gravity;
    UniaxialLoadingSection loading;
    OutputSection          output;
  };
} // namespace apps

#pragma once

#include "apps/drivers/particles/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "particles": specimens and loose particles that are held, moved, thrown and measured as the scene says. */
  class ParticlesScene : public Scene
  {
  public:
    void        declare(Section &root) override { model.declare(root); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    const ParticlesModel &parameters() const { return model; }

  private:
    ParticlesModel model;
  };
} // namespace apps

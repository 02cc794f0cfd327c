#pragma once

#include "apps/drivers/structure/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "structure": particles, and a solid around them, led along their equilibria without inertia (doc/theory/static-handshake.md). */
  class StructureScene : public Scene
  {
  public:
    void        declare(Section &root) override { model.declare(root); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    const StructureModel &parameters() const { return model; }

  private:
    StructureModel model;
  };
} // namespace apps

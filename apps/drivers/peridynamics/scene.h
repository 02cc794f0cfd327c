#pragma once

#include "apps/drivers/peridynamics/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "peridynamics": bonds over a horizon, with tractions as integrals over the boundary (doc/theory/peridynamics.md). */
  class PeridynamicsScene : public Scene
  {
  public:
    void        declare(Section &root) override { model.declare(root); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    const PeridynamicsModel &parameters() const { return model; }

  private:
    PeridynamicsModel model;
  };
} // namespace apps

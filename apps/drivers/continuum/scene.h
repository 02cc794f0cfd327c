#pragma once

#include "apps/drivers/continuum/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "continuum": a solid of finite elements under loads, in equilibrium or in motion. */
  class ContinuumScene : public Scene
  {
  public:
    void        declare(Section &root) override { model.declare(root); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    bool        shares_ranks() const override { return true; }
    RunResult   run(const RunRequest &request) const override;

    const ContinuumModel &parameters() const { return model; }

  private:
    ContinuumModel model;
  };
} // namespace apps

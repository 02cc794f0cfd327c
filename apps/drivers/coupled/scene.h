#pragma once

#include "apps/drivers/coupled/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "coupled": particles and a solid of finite elements that touch, in motion. */
  class CoupledScene : public Scene
  {
  public:
    void        declare(Section &root) override { model.declare(root); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    const CoupledModel &parameters() const { return model; }

  private:
    CoupledModel model;
  };
} // namespace apps

#pragma once

#include "apps/drivers/peridynamic_core/model.h"
#include "apps/scene/scene.h"

namespace apps
{
  /** Scene kind "peridynamic_core": a solid of finite elements with a peridynamic core, in motion. */
  class PeridynamicCoreScene : public Scene
  {
  public:
    void        declare(Section &root) override { apps::declare(root, model); }
    void        check() const override { model.check({}); }
    std::string forecast() const override;
    RunResult   run(const RunRequest &request) const override;

    const PeridynamicCoreModel &parameters() const { return model; }

  private:
    PeridynamicCoreModel model;
  };
} // namespace apps

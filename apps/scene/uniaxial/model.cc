#include "apps/scene/uniaxial/model.h"

#include "apps/scene/entries/emission.h"
#include "apps/scene/entries/gravity.h"
#include "apps/scene/entries/joints.h"
#include "apps/scene/entries/loading.h"
#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/entries/time.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, UniaxialModel &model)
  {
    declare(root, model.source, model.physics.dimension);
    declare(*root.find_section("Specimen"), model.mix);
    declare(*root.find_section("Specimen"), model.joints);
    declare(root, model.material);
    declare_physics(root, model.physics);
    declare(root, model.time);
    declare(root, model.gravity);
    declare(root, model.loading);
    declare(root, model.output);
    declare(root, model.emission);
  }
} // namespace apps

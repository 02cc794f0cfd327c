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
    SpecimenSection::Use use;
    use.laboratory = true;
    declare(root, model.source, model.physics.dimension, use);
    declare(*root.find_section("Specimen"), model.mix);
    declare(root, model.joints);
    declare(root, model.material);
    declare_physics(root, model.physics);
    declare(root, model.time);
    declare(root, model.gravity);
    declare(root, model.loading);
    declare_for_ranks(root, model.output);
    root.find_section("Output")
      ->flag("Fracture zone", model.fracture_zone)
      .means("Figures tension_fracture_zone_width and the like: how wide the zone is in which links dissipate energy "
             "by their damage after "
             "the stress has fallen to 0.8 of its peak; of laws that say what each link dissipates");
    declare(root, model.emission);
  }
} // namespace apps

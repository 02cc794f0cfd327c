#include "apps/scene/coupled/model.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/coupled/couplings.h"
#include "apps/scene/coupled/handshakes.h"
#include "apps/scene/coupled/laboratory.h"
#include "apps/scene/entries/contact_figures.h"
#include "apps/scene/particles/model.h"
#include "apps/scene/section.h"

#include <fmt/ranges.h>

namespace apps
{
  namespace
  {
    void declare_sub_cycling(Section &time, CoupledModel &model)
    {
      time.integer("Largest ratio", model.largest_ratio, "", Range::between(1, 100), Need::optional)
        .means("Steps that either side may take in one of the other, where its stable step is the shorter one by two "
               "or more. "
               "1: both take the same, which keeps energy to rounding; more saves time and costs energy in proportion "
               "to the "
               "longer step, as much as Sub-cycling loss allows");
      time.number("Sub-cycling loss", model.sub_cycling_loss, "-", Range::between(1e-9, 1), Need::optional)
        .means(
          "Part of the largest energy that such steps may lose in all: the ratio is the largest that holds it, by what "
          "couplings have lost so far")
        .only_if([&model] { return model.largest_ratio > 1; }, "Largest ratio > 1");
      time.flag("Checked windows", model.checked_windows)
        .means("A window of several steps that has lost more than half of what Sub-cycling loss still allows is taken "
               "back, and again with shorter ones: for what hits hard, where the loss of the next window cannot be "
               "known from the last. Costs a copy of the state in each")
        .only_if([&model] { return model.largest_ratio > 1; }, "Largest ratio > 1");
    }
  } // namespace

  void declare(Section &scene, CoupledModel &model)
  {
    declare_as_part(scene.section("Continuum", "The solid; sections of a scene of kind continuum, in explicit motion"),
                    model.continuum);
    declare_as_part(scene.section("Particles", "The particles; sections of a scene of kind particles"),
                    model.particles);
    declare(scene, model.couplings);
    declare(scene, model.handshakes, model.continuum);
    model.particles.gravity.start = GravitySection::Start::none;
    declare_course(scene, model.particles,
                   "Weight of everything, particles and solid: the solid needs no other load for its own");
    scene.find_section("Gravity")
      ->find_entry("Acceleration")
      ->means("Of all that falls; 0, 0, -9.81 on earth with z upwards");
    declare_sub_cycling(*scene.find_section("Time"), model);
    declare(scene, model.laboratory);
    declare(scene, model.references);
  }
} // namespace apps

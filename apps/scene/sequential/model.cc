#include "apps/scene/sequential/model.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/section.h"
#include "apps/scene/sequential/law_identification.h"
#include "apps/scene/sequential/law_origin.h"
#include "apps/scene/sequential/particle_event.h"
#include "apps/scene/sequential/transfer_section.h"

namespace apps
{
  namespace
  {
    SequentialModel::Digests digests_in(const Section &scene, const SequentialModel &model)
    {
      SequentialModel::Digests found;
      if (model.particles.source != ParticleEventSection::Source::file)
        found.particles = digest_of_particles(*scene.find_section("Particles"));
      const Section &materials = *scene.find_section("Continuum")->find_section("Materials");
      for (const MaterialOfGroup *group : model.receivers())
        found.materials[group->group] =
          digest_of_material(*materials.find_section(group->group)->find_section(group->law->name()), *group->law);
      return found;
    }
  } // namespace

  void declare(Section &scene, SequentialModel &model)
  {
    model.particles.strained_too = [&model] { return model.transfer.identifies(); };
    declare(scene, model.particles);
    declare(scene, model.transfer);
    declare(*scene.find_section("Transfer"), model.identification, model.transfer);
    Section &continuum =
      scene.section("Continuum", "The solid that carries on; the sections of a scene of kind continuum");
    declare_alone(continuum, model.continuum);
    Section &s = scene.section("Study", "How the continuations are read and compared");
    s.number("Length", model.study.length, "m", Range::positive(), Need::optional)
      .means("Displacement over it is the strain of the continuation; 1: displacements as they are")
      .housekeeping();
    s.number("Area", model.study.area, "m^2", Range::positive(), Need::optional)
      .means("Force over it is the stress; 1: forces as they are")
      .housekeeping();
    s.number("Sign", model.study.sign, "-", Range::between(-1, 1), Need::optional)
      .means("-1 turns both around")
      .housekeeping();
    s.number("Least force", model.study.least_force, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "A continuation of which every point softens, in ten steps in a row, ends when no more than this part of its "
        "largest force (Output/Curve vertical) is left; 0: it goes on");
    s.text("Horizontal", model.study.horizontal, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
    s.text("Vertical", model.study.vertical, Need::required)
      .means("Column of the continuation's series.csv")
      .housekeeping();
    model.digests = [&scene, &model] { return digests_in(scene, model); };
  }
} // namespace apps

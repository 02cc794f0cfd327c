#include "apps/bench/mortar_crush.h"

#include "apps/bench/laboratory_run.h"
#include "apps/runs/particles/model.h"

namespace apps
{
  const ParticlesModel &mortar_in(const CheckedScene &checked)
  {
    const ParticlesModel &model = model_of_kind<ParticlesModel>(checked, "particles");
    if (model.source.source != SpecimenSection::Source::genesis)
      refuse_scene(checked, "Specimen/Source: this bench needs genesis.");
    if (model.laboratory.test != SpecimenTestSection::Test::compression)
      refuse_scene(checked, "Laboratory/Test: this bench needs uniaxial compression.");
    return model;
  }

  MortarRow crush(const SceneVariant &variant, const ParticlesModel &model, const dem::Packing &packing)
  {
    MortarRow     row{variant.study, variant.value};
    ParticlesBody body(model, packing);
    body.start();
    row.particles                  = body.specimen().counts().particles;
    row.bonds                      = body.specimen().counts().links;
    const LaboratoryRun run        = run_test(body, model.last_time());
    row.balance                    = run.balance;
    row.cost                       = run.cost;
    const dem::TestFigures figures = body.test()->figures();
    row.strength                   = value_of(figures.strength);
    row.modulus                    = value_of(figures.modulus);
    row.imbalance                  = value_of(body.test()->how_static().imbalance);
    return row;
  }
} // namespace apps

#include "apps/bench/mortar_crush.h"

#include "apps/drivers/particles/body.h"
#include "apps/drivers/particles/scene.h"
#include "apps/process/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    double value_of(const dem::Finding &finding) { return finding.found ? finding.value : unknown_figure; }
  } // namespace

  std::string in_table(const double value, const double unit, const char *digits)
  {
    return std::isnan(value) ? "-" : fmt::format(fmt::runtime(digits), value / unit);
  }

  std::string in_csv(const double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

  const ParticlesModel &mortar_in(const CheckedScene &checked)
  {
    const ParticlesModel &model = scene_of_kind<ParticlesScene>(checked, "particles").parameters();
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
    row.particles      = body.specimen().counts().particles;
    row.bonds          = body.specimen().counts().links;
    const double start = processor_seconds();
    while (!body.test_is_over() && body.specimen().time() < model.end_time)
      {
        body.advance(1000);
        row.balance = std::max(row.balance, body.specimen().energy().balance_error());
      }
    row.cost                       = processor_seconds() - start;
    const dem::TestFigures figures = body.test()->figures();
    row.strength                   = value_of(figures.strength);
    row.modulus                    = value_of(figures.modulus);
    row.imbalance                  = value_of(body.test()->how_static().imbalance);
    return row;
  }
} // namespace apps

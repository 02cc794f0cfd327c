#include "apps/bench/uniaxial.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/bench/uniaxial_cases.h"
#include "apps/bench/uniaxial_table.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "apps/runs/uniaxial/lab_test.h"
#include "apps/runs/uniaxial/model.h"
#include "apps/specimens/specimen_packing.h"

#include <fmt/format.h>

#include <map>

namespace apps
{
  namespace
  {
    /** Packings by radius and seed: most cases share one. */
    class PackingStore
    {
    public:
      const dem::Packing &of(const UniaxialModel &model)
      {
        const SpecimenSection &source = model.source;
        const auto             key    = std::make_pair(source.generator.radius, source.generator.seed);
        const auto             found  = packings.find(key);
        return found != packings.end() ?
                 found->second :
                 packings.emplace(key, make_packing(source, model.material, model.physics.dimension)).first->second;
      }

    private:
      std::map<std::pair<double, std::int64_t>, dem::Packing> packings;
    };

    UniaxialModel model_of(const UniaxialBench &bench)
    {
      const CheckedScene  scene = read_scene(bench.scene, bench.overrides);
      const UniaxialModel model = model_of_kind<UniaxialModel>(scene, "uniaxial");
      if (model.source.source != SpecimenSection::Source::generator)
        refuse_scene(scene, "Specimen/Source = file: this bench varies the particle size and needs the generator.");
      if (!model.loading.asks_for(UniaxialLoad::tension) || !model.loading.asks_for(UniaxialLoad::compression))
        refuse_scene(scene, "Loading/Tests: this bench needs tension and compression.");
      return model;
    }

    /** @return nothing if interrupted. */
    bool
    measure(const UniaxialModel &model, const dem::Packing &packing, Progress &progress, UniaxialMeasurement &measured)
    {
      for (std::size_t i = 0; i < model.loading.tests.size(); ++i)
        {
          UniaxialLabTest test(model, packing, i);
          while (!test.finished())
            {
              test.advance();
              progress.update(test.done(), test.details());
              if (interrupted())
                return false;
            }
          test.complete();
          measured.add(test.result);
        }
      return true;
    }
  } // namespace

  int run_uniaxial_bench(const UniaxialBench &bench)
  {
    const UniaxialModel             scene = model_of(bench);
    const std::vector<UniaxialCase> cases = uniaxial_cases(bench.quick);
    const BenchResults              results(bench.folder, "uniaxial");
    catch_interrupts();
    UniaxialTable table;
    PackingStore  packings;
    for (std::size_t i = 0; i < cases.size(); ++i)
      {
        UniaxialMeasurement measured;
        measured.which = cases[i];
        for (int seed = 0; seed < bench.seeds; ++seed)
          {
            UniaxialModel model = cases[i].apply(scene);
            model.source.generator.seed += seed;
            const std::string title =
              fmt::format("case {} of {}, {} {} {}, seed {}", i + 1, cases.size(), cases[i].study, cases[i].value,
                          cases[i].unit, model.source.generator.seed);
            Progress progress(title);
            if (!measure(model, packings.of(model), progress, measured))
              return exit_interrupted; // the table has every complete case
          }
        fmt::print("{}\n", measured.text());
        table.add(std::move(measured));
        table.write(results);
      }
    return results.finish(table.panels());
  }
} // namespace apps

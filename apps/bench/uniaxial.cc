#include "apps/bench/uniaxial.h"

#include "apps/bench/uniaxial_cases.h"
#include "apps/bench/uniaxial_table.h"
#include "apps/drivers/load.h"
#include "apps/drivers/parts/specimen_packing.h"
#include "apps/drivers/uniaxial/scene.h"
#include "apps/drivers/uniaxial/stage.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/progress.h"
#include "dem/core/errors.h"
#include "postprocess/errors.h"

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
                 packings.emplace(key, make_packing(source, model.material, model.specimen.physics.dimension))
                   .first->second;
      }

    private:
      std::map<std::pair<double, std::int64_t>, dem::Packing> packings;
    };

    UniaxialModel model_of(const UniaxialBench &bench)
    {
      const LoadedScene loaded = load_scene(bench.scene, bench.overrides);
      const auto       *scene  = dynamic_cast<const UniaxialScene *>(loaded.scene.get());
      if (!scene)
        throw dem::InputError(bench.scene + ": Kind = " + loaded.kind + ": this bench needs a scene of kind uniaxial.");
      const UniaxialModel model = scene->model();
      if (model.source.source != SpecimenSection::Source::generator)
        throw dem::InputError(bench.scene +
                              ": Specimen/Source = file: this bench varies the particle size and needs the generator.");
      if (!model.loading.asks_for(UniaxialLoad::tension) || !model.loading.asks_for(UniaxialLoad::compression))
        throw dem::InputError(bench.scene + ": Loading/Tests: this bench needs tension and compression.");
      return model;
    }

    /** @return nothing if interrupted. */
    bool
    measure(const UniaxialModel &model, const dem::Packing &packing, Progress &progress, UniaxialMeasurement &measured)
    {
      for (std::size_t i = 0; i < model.loading.tests.size(); ++i)
        {
          UniaxialStage stage(model, packing, i);
          while (!stage.finished())
            {
              stage.advance();
              progress.update(stage.done(), stage.details());
              if (interrupted())
                return false;
            }
          stage.finish();
          measured.add(stage.result);
        }
      return true;
    }

    void make_folder(const std::filesystem::path &folder)
    {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error)
        throw postprocess::OutputError(folder.string() + ": the output folder cannot be made: " + error.message() +
                                       ".");
    }
  } // namespace

  int run_uniaxial_bench(const UniaxialBench &bench)
  {
    const UniaxialModel             scene = model_of(bench);
    const std::vector<UniaxialCase> cases = uniaxial_cases(bench.quick);
    make_folder(bench.folder);
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
        table.write(bench.folder);
      }
    const std::string problem = table.draw(bench.folder / "uniaxial.png");
    if (!problem.empty())
      fmt::print(stderr, "breccia: warning: no picture: {}\n", problem);
    fmt::print("written to {}: uniaxial.csv, uniaxial.md, uniaxial.png\n", bench.folder.string());
    return exit_success;
  }
} // namespace apps

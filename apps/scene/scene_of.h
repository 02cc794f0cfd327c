#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/scene/scene.h"
#include "base/errors.h"

#include <memory>
#include <string>

namespace apps
{
  // What a kind of scene does with its model, by the functions of that name beside the model; found by the type of the model.
  template <typename Model>
  void declare_model(Section &root, Model &model)
  {
    declare(root, model);
  }
  template <typename Model>
  std::string forecast_of_model(const Model &model)
  {
    return forecast(model);
  }
  template <typename Model>
  RunResult run_of_model(const Model &model, const RunRequest &request)
  {
    return run(model, request);
  }

  template <typename Model>
  auto outcome_of_model(const Model &model, int) -> decltype(std::optional<RunOutcome>(outcome(model)))
  {
    return outcome(model);
  }
  template <typename Model> // of a model without one
  std::optional<RunOutcome> outcome_of_model(const Model &, long)
  {
    return std::nullopt;
  }

  template <typename Model>
  auto forecast_of_ranks(const Model &model, const std::size_t ranks, int) -> decltype(forecast(model, ranks))
  {
    return forecast(model, ranks);
  }
  template <typename Model> // of a model that has no particles to share out
  std::string forecast_of_ranks(const Model &, std::size_t, long)
  {
    throw base::InputError("--ranks: shares are forecast for scenes of kind cell, particles and uniaxial only.");
  }

  /**
   * The kind of scene that fills a model: `declare(root, model)` binds its entries, `model.check(path)` has the rules between them,
   * `forecast(model)` and `run(model, request)` work with it; `outcome(model)`, if there is one, names what a run can find, and
   * `forecast(model, ranks)` says how its particles would be shared out.
   */
  template <typename Model>
  class SceneOf : public Scene
  {
  public:
    explicit SceneOf(const bool by_ranks = false)
      : ranks(by_ranks)
    {
    }

    void        declare(Section &root) override { declare_model(root, scene_model); }
    void        check() const override { scene_model.check({}); }
    std::string forecast() const override { return forecast_of_model(scene_model); }
    std::string forecast_over(const std::size_t number) const override
    {
      return forecast_of_ranks(scene_model, number, 0);
    }
    std::optional<RunOutcome> outcome() const override { return outcome_of_model(scene_model, 0); }
    bool                      shares_ranks() const override { return ranks; }
    RunResult    run(const RunRequest &request) const override { return run_of_model(scene_model, request); }
    const Model &model() const { return scene_model; }

  private:
    bool  ranks;
    Model scene_model;
  };

  /** For the list of kinds (kinds.h). @tparam by_ranks whether processes started by mpirun share the work */
  template <typename Model, bool by_ranks = false>
  std::unique_ptr<Scene> make_scene()
  {
    return std::make_unique<SceneOf<Model>>(by_ranks);
  }
} // namespace apps

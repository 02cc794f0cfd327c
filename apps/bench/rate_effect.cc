#include "apps/bench/rate_effect.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/runs/uniaxial/lab_test.h"
#include "apps/runs/uniaxial/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace apps
{
  namespace
  {
    /** Multiplies the times of a law with viscous mechanisms. */
    class TimeScaler final : public dem::ConstantVisitor
    {
    public:
      explicit TimeScaler(const double factor)
        : by(factor)
      {
      }
      void number(const char *key, double &member, const char *, const char *, double, double, bool) override
      {
        const std::string name = key;
        if (name != "Damage time" && name != "Plastic time")
          return;
        any = any || member > 0;
        member *= by;
      }
      void choice(const char *,
                  const std::vector<std::string> &,
                  std::size_t,
                  std::function<void(std::size_t)>,
                  const char *) override
      {
      }
      bool any = false; ///< such a time is not zero

    private:
      double by;
    };

    /** @return whether the law depends on the rate */
    bool scale_times(MaterialSection &material, const double factor)
    {
      TimeScaler scaler(factor);
      for (auto &[name, constants] : material.only.constants)
        {
          constants = constants->copy();
          constants->visit(scaler);
        }
      return scaler.any;
    }

    UniaxialLoadingSection::Test &test_of(UniaxialModel &model, const UniaxialLoad load)
    {
      return load == UniaxialLoad::tension ? model.loading.tension : model.loading.compression;
    }

    struct StrengthRow
    {
      double rate = 0, strength = 0, inertia_alone = 0; ///< [1/s], [Pa]; the last of the law without its times
      double run_rate = 0, balance_error = 0;
    };

    double strength_of(const UniaxialModel &model, const dem::Packing &packing, double &balance_error)
    {
      UniaxialLabTest test(model, packing, 0);
      while (!test.finished())
        test.advance();
      balance_error = std::max(balance_error, test.result.worst_balance_error);
      return test.result.notes.figures.strength;
    }

    StrengthRow
    strength_at(UniaxialModel model, const UniaxialLoad load, const double rate, const dem::Packing &packing)
    {
      StrengthRow row;
      model.loading.tests = {load};
      double &run_rate    = test_of(model, load).rate;
      row.rate            = rate;
      row.run_rate        = std::max(rate, run_rate);
      run_rate            = row.run_rate;
      scale_times(model.material, rate / row.run_rate);
      row.strength = strength_of(model, packing, row.balance_error);
      scale_times(model.material, 0);
      row.inertia_alone = strength_of(model, packing, row.balance_error);
      return row;
    }

    struct LoadRows
    {
      UniaxialLoad             load;
      std::string              name;
      std::vector<StrengthRow> rows;

      bool   tension() const { return load == UniaxialLoad::tension; }
      double ratio(const StrengthRow &r) const { return r.strength / rows.front().strength; }
      double inertia(const StrengthRow &r) const { return r.inertia_alone / rows.front().inertia_alone; }
      double published(const StrengthRow &r) const
      {
        return fib_strength_ratio(tension(), r.rate) / fib_strength_ratio(tension(), rows.front().rate);
      }
    };

    void write_rates(const BenchResults &results, const std::vector<LoadRows> &loads)
    {
      std::string csv =
        "test,rate [1/s],strength [Pa],over_slowest [-],inertia_alone [-],fib_model_code [-],run_at [1/s],"
        "balance_error [-]\n";
      std::string md = "| Test | Rate [1/s] | Strength [MPa] | Over the slowest | Inertia alone | fib Model Code 2010 "
                       "| Run at [1/s] | "
                       "Energy balance |\n|---|---|---|---|---|---|---|---|\n";
      for (const LoadRows &of : loads)
        for (const StrengthRow &r : of.rows)
          {
            csv += fmt::format("{},{},{},{},{},{},{},{}\n", of.name, r.rate, r.strength, of.ratio(r), of.inertia(r),
                               of.published(r), r.run_rate, r.balance_error);
            md +=
              fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} | {:.1e} |\n", of.name, r.rate,
                          1e-6 * r.strength, of.ratio(r), of.inertia(r), of.published(r), r.run_rate, r.balance_error);
          }
      results.write(csv, md);
    }

    postprocess::PlotPanel rate_panel(const LoadRows &of)
    {
      postprocess::PlotPanel panel;
      panel.title   = of.name;
      panel.x_label = "Strain rate [1/s]";
      panel.y_label = "Strength over that at the slowest rate";
      panel.log_x   = true;
      postprocess::PlotSeries law, inertia, published;
      law.name        = "delayed damage";
      inertia.name    = "inertia alone";
      published.name  = "fib Model Code 2010";
      published.style = postprocess::PlotSeries::Style::line;
      for (const StrengthRow &r : of.rows)
        {
          law.x.push_back(r.rate);
          law.y.push_back(of.ratio(r));
          inertia.y.push_back(of.inertia(r));
          published.y.push_back(of.published(r));
        }
      inertia.x = published.x = law.x;
      panel.series            = {law, inertia, published};
      return panel;
    }
  } // namespace

  double fib_strength_ratio(const bool tension, const double rate)
  {
    if (tension)
      return rate <= 10 ? std::pow(rate / 1e-6, 0.018) : 0.0062 * std::cbrt(rate / 1e-6);
    return rate <= 30 ? std::pow(rate / 30e-6, 0.014) : 0.012 * std::cbrt(rate / 30e-6);
  }

  int run_rate_effect_bench(const RateEffectBench &requested)
  {
    RateEffectBench bench = requested;
    if (bench.quick)
      bench.rates = {1e-6, 1e-3, 1, 30};
    std::sort(bench.rates.begin(), bench.rates.end());
    const CheckedScene scene = read_scene(bench.scene, bench.overrides);
    UniaxialModel      model = model_of_kind<UniaxialModel>(scene, "uniaxial");
    if (!model.material.named.empty() || !scale_times(model.material, 1))
      refuse_scene(scene, "Material: this bench needs one law with a Damage time or a Plastic time.");
    const BenchResults results(bench.folder, "rate_effect");
    const dem::Packing packing = model.packing();
    fmt::print("{} particles\n", packing.size());
    std::vector<LoadRows> loads;
    for (const UniaxialLoad load : model.loading.tests)
      {
        LoadRows &of = loads.emplace_back();
        of.load      = load;
        of.name      = of.tension() ? "tension" : "compression";
        for (const double rate : bench.rates)
          {
            of.rows.push_back(strength_at(model, load, rate, packing));
            const StrengthRow &r = of.rows.back();
            fmt::print("{:<12} {:>8} 1/s: {:.3f} MPa, over the slowest {:.3f}, inertia alone {:.3f}, fib {:.3f}\n",
                       of.name, r.rate, 1e-6 * r.strength, of.ratio(r), of.inertia(r), of.published(r));
            std::fflush(stdout);
          }
      }
    write_rates(results, loads);
    std::vector<postprocess::PlotPanel> panels;
    for (const LoadRows &of : loads)
      panels.push_back(rate_panel(of));
    return results.finish(panels);
  }
} // namespace apps

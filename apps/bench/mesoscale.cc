#include "apps/bench/mesoscale.h"

#include "apps/bench/beygi_mixes.h"
#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/bench/uniaxial_table.h"
#include "apps/runs/uniaxial/lab_test.h"
#include "apps/runs/uniaxial/model.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace apps
{
  namespace
  {
    using beygi::Ratios;

    constexpr std::array<const char *, beygi::properties> names = {"E", "f_t", "f_c", "G_f"};
    constexpr double long_enough = 0.02; ///< strain in tension by which the stress has fallen far

    /** One geometry of one mix. */
    struct Specimen
    {
      const beygi::Mix *mix        = nullptr;
      double            ductility  = 0; ///< of the interface
      std::int64_t      seed       = 0;
      std::size_t       aggregates = 0;
      Ratios            found{}; ///< [Pa], [Pa], [Pa], [J/m^2]
      double            balance_error = 0, seconds = 0;
    };

    /** Area under a curve of tension until its stress has fallen to a part of the largest for good [J/m^3]. */
    double work_until_fallen(const UniaxialResult &tension, const double part)
    {
      const double limit = part * *std::max_element(tension.stress.begin(), tension.stress.end());
      std::size_t  last  = tension.stress.size() - 1;
      while (last > 0 && tension.stress[last] < limit)
        --last;
      double work = 0;
      for (std::size_t i = 1; i <= last; ++i)
        work += 0.5 * (tension.stress[i] + tension.stress[i - 1]) * (tension.strain[i] - tension.strain[i - 1]);
      return work;
    }

    /** A curve that its stop strain has ended has not all of its work. @throws base::InputError */
    void require_fallen(const UniaxialResult &tension, const double stop_strain, const Specimen &specimen)
    {
      if (tension.strain.back() >= stop_strain)
        throw base::InputError(fmt::format(
          "Loading/Tension/Stop strain = {:.3g}: there {}, seed {}, still bears {:.3g} of its strength, more than that "
          "until which the work of fracture is counted. Raise it.",
          stop_strain, specimen.mix->name, specimen.seed,
          tension.stress.back() / *std::max_element(tension.stress.begin(), tension.stress.end())));
    }

    void run_test(const UniaxialModel &model, const dem::Packing &packing, const double work_until, Specimen &specimen)
    {
      UniaxialLabTest test(model, packing, 0);
      while (!test.finished())
        test.advance();
      test.complete();
      const UniaxialResult &result = test.result;
      specimen.balance_error       = std::max(specimen.balance_error, result.worst_balance_error);
      if (result.load == UniaxialLoad::compression)
        {
          specimen.found[beygi::compression] = result.notes.figures.strength;
          return;
        }
      require_fallen(result, model.loading.tension.stop_strain, specimen);
      specimen.found[beygi::modulus]  = result.notes.figures.young_modulus;
      specimen.found[beygi::tension]  = result.notes.figures.strength;
      specimen.found[beygi::fracture] = result.notes.gauge_length * work_until_fallen(result, work_until);
    }

    Specimen run_specimen(UniaxialModel      model,
                          const beygi::Mix  &mix,
                          const double       ductility,
                          const std::int64_t seed,
                          const double       work_until)
    {
      const base::Stopwatch watch;
      Specimen              specimen;
      specimen.mix                  = &mix;
      specimen.ductility            = ductility;
      specimen.seed                 = seed;
      model.mix                     = mix.section(model.mix);
      model.mix.seed                = seed;
      model.mix.interface.ductility = ductility;
      const dem::Packing packing    = model.packing();
      specimen.aggregates           = model.mix.sizes_in(model.source.box_edges()).diameters.size();
      for (const UniaxialLoad load : {UniaxialLoad::tension, UniaxialLoad::compression})
        {
          model.loading.tests = {load};
          run_test(model, packing, work_until, specimen);
        }
      specimen.seconds = watch.seconds();
      return specimen;
    }

    /** Of the geometries of a mix, each property. */
    using Scatters = std::array<Scatter, beygi::properties>;

    Scatters scatters_of(const std::vector<Specimen> &all, const beygi::Mix &mix, const double ductility)
    {
      Scatters found;
      for (const Specimen &s : all)
        if (s.mix == &mix && s.ductility == ductility)
          for (std::size_t p = 0; p < found.size(); ++p)
            found[p].values.push_back(s.found[p]);
      return found;
    }

    /** A mix with one set of factors: means over those of the mix with the smallest aggregates. */
    struct MixRow
    {
      const beygi::Mix *mix;
      double            ductility;
      Scatters          found, of_smallest;

      double ratio(const std::size_t p) const { return found[p].mean() / of_smallest[p].mean(); }
      /** Standard error of the ratio, of geometries independent of each other. */
      double error(const std::size_t p) const
      {
        const auto part = [](const Scatter &s) {
          return s.deviation() / s.mean() / std::sqrt(static_cast<double>(s.values.size()));
        };
        return mix == smallest() ? 0.0 : ratio(p) * std::hypot(part(found[p]), part(of_smallest[p]));
      }
      const beygi::Mix *smallest() const { return &mix->reference(); }
      std::string       judged(const std::size_t p) const
      {
        return beygi::judgement(*mix, ductility, static_cast<beygi::Property>(p), ratio(p));
      }
    };

    std::vector<MixRow>
    rows_of(const MesoscaleBench &bench, const std::vector<const beygi::Mix *> &mixes, const std::vector<Specimen> &all)
    {
      std::vector<MixRow> rows;
      for (const double ductility : bench.ductility)
        for (const beygi::Mix *mix : mixes)
          {
            MixRow row{mix, ductility, scatters_of(all, *mix, ductility), {}};
            row.of_smallest = scatters_of(all, *row.smallest(), ductility);
            rows.push_back(row);
          }
      return rows;
    }

    std::string csv_of(const std::vector<Specimen> &all)
    {
      std::string csv =
        "mix,ductility_factor [-],seed,aggregates,E [Pa],f_t [Pa],f_c [Pa],G_f [J/m^2],balance_error [-],seconds [s]\n";
      for (const Specimen &s : all)
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{:.1f}\n", s.mix->name, s.ductility, s.seed, s.aggregates,
                           s.found[0], s.found[1], s.found[2], s.found[3], s.balance_error, s.seconds);
      return csv;
    }

    /** "1.05 ± 0.02"; of one geometry there is no error. */
    std::string with_error(const double value, const double error, const std::size_t geometries, const char *precise)
    {
      const std::string text = fmt::format(fmt::runtime(precise), value);
      return geometries > 1 ? text + " ± " + fmt::format(fmt::runtime(precise), error) : text;
    }

    /** "1.05 ± 0.02 (1.10, 1.05) within": ours, experiment, published simulation, and whether ours is in its band. */
    std::string cell_of(const MixRow &row, const std::size_t p)
    {
      const Ratios &measured  = row.mix->measured;
      const double  simulated = row.ductility == beygi::simulated_ductility ? row.mix->simulated[p] : 0.0;
      if (row.mix == row.smallest())
        return "1";
      const std::string ours = with_error(row.ratio(p), row.error(p), row.found[p].values.size(), "{:.3f}");
      const std::string said = row.judged(p);
      return fmt::format("{} ({:.3f}{}){}{}", ours, measured[p],
                         simulated > 0 ? fmt::format(", {:.3f}", simulated) : "", said.empty() ? "" : " ", said);
    }

    /** A row for each ratio; what is not published is empty. */
    std::string ratios_csv_of(const std::vector<MixRow> &rows)
    {
      const auto  number = [](const double value) { return value > 0 ? fmt::format("{:.4g}", value) : std::string(); };
      std::string csv    = "mix,ductility_factor [-],property,ratio [-],error [-],experiment [-],simulation [-],low "
                           "[-],high [-],judgement\n";
      for (const MixRow &row : rows)
        for (std::size_t p = 0; p < names.size() && row.mix != row.smallest(); ++p)
          {
            const auto band = beygi::band_of(*row.mix, row.ductility, static_cast<beygi::Property>(p));
            csv += fmt::format("{},{},{},{},{},{},{},{},{},\"{}\"\n", row.mix->name, row.ductility, names[p],
                               row.ratio(p), row.found[p].values.size() > 1 ? fmt::format("{}", row.error(p)) : "",
                               row.mix->measured[p], band ? number(row.mix->simulated[p]) : "",
                               band ? number(band->low) : "", band ? number(band->high) : "", row.judged(p));
          }
      return csv;
    }

    /** How many ratios are in their bands, and go the right way. */
    std::string verdict_on(const std::vector<MixRow> &rows)
    {
      int banded = 0, within = 0, all = 0, right = 0;
      for (const MixRow &row : rows)
        for (std::size_t p = 0; p < names.size() && row.mix != row.smallest(); ++p)
          {
            const auto property = static_cast<beygi::Property>(p);
            const auto band     = beygi::band_of(*row.mix, row.ductility, property);
            banded += band ? 1 : 0;
            within += band && band->holds(row.ratio(p)) ? 1 : 0;
            all += 1;
            right += beygi::right_trend(property, row.ratio(p)) ? 1 : 0;
          }
      return fmt::format(
        "{} of {} ratios within the band of the published simulation (0.06; work of fracture 0.25), {} of "
        "{} with its trend.\n",
        within, banded, right, all);
    }

    std::string table_of(const std::vector<MixRow> &rows)
    {
      std::string md =
        "Over the mix with 9.5 mm, with its standard error; in brackets the experiment and, of the low strength, the "
        "published simulation with ductility factor 0.1, and whether ours is within its band.\n\n"
        "| Mix | Ductility factor | E [GPa] | f_t [MPa] | f_c [MPa] | G_f [J/m²] | E | f_t | f_c | G_f |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n";
      constexpr std::array<double, beygi::properties> scale = {1e-9, 1e-6, 1e-6, 1};
      for (const MixRow &row : rows)
        {
          md += fmt::format("| {} | {} |", row.mix->name, row.ductility);
          for (std::size_t p = 0; p < scale.size(); ++p)
            md += " " +
                  with_error(scale[p] * row.found[p].mean(), scale[p] * row.found[p].deviation(),
                             row.found[p].values.size(), "{:.3g}") +
                  " |";
          for (std::size_t p = 0; p < scale.size(); ++p)
            md += " " + cell_of(row, p) + " |";
          md += "\n";
        }
      return md + "\n" + verdict_on(rows);
    }

    /** A property over the largest size, of one strength. */
    postprocess::PlotPanel panel_of_property(const std::vector<MixRow> &rows, const std::size_t p, const bool high)
    {
      postprocess::PlotPanel panel;
      panel.title   = fmt::format("{}, {} strength", names[p], high ? "high" : "low");
      panel.x_label = "Largest aggregate [mm]";
      panel.y_label = "Over that with 9.5 mm";
      std::vector<postprocess::PlotSeries> ours;
      postprocess::PlotSeries              measured, simulated;
      measured.name  = "Beygi et al. (2014)";
      simulated.name = "Stransky (2018)";
      for (const MixRow &row : rows)
        {
          if (row.mix->high != high)
            continue;
          if (row.mix == row.smallest())
            {
              ours.emplace_back();
              ours.back().name = fmt::format("ductility factor {}", row.ductility);
            }
          const double size = 1e3 * row.mix->largest();
          ours.back().x.push_back(size);
          ours.back().y.push_back(row.ratio(p));
          ours.back().y_error.push_back(row.error(p));
          if (row.ductility != rows.front().ductility)
            continue;
          measured.x.push_back(size);
          measured.y.push_back(row.mix->measured[p]);
          if (row.mix->simulated[p] > 0)
            {
              simulated.x.push_back(size);
              simulated.y.push_back(row.mix->simulated[p]);
            }
        }
      panel.series = ours;
      panel.series.push_back(measured);
      if (!simulated.x.empty())
        panel.series.push_back(simulated);
      return panel;
    }

    /** Those that are requested, and before them what they are compared with. @throws base::InputError */
    std::vector<const beygi::Mix *> chosen_mixes(const std::vector<std::string> &wanted)
    {
      std::vector<const beygi::Mix *> found;
      for (const beygi::Mix &mix : beygi::mixes())
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), mix.name) != wanted.end())
          {
            const beygi::Mix *smallest = &beygi::mixes()[mix.high ? 3 : 0];
            for (const beygi::Mix *needed : {smallest, &mix})
              if (std::find(found.begin(), found.end(), needed) == found.end())
                found.push_back(needed);
          }
      return found;
    }
  } // namespace

  int run_mesoscale_bench(const MesoscaleBench &requested)
  {
    MesoscaleBench bench = requested;
    if (bench.quick)
      {
        bench.geometries = 1;
        bench.mixes      = {"l-19"};
        bench.ductility.resize(1);
      }
    const CheckedScene scene = read_scene(bench.scene, bench.overrides);
    UniaxialModel      model = model_of_kind<UniaxialModel>(scene, "uniaxial");
    if (!model.mix.given() || !model.source.has_box())
      refuse_scene(scene, "Specimen/Mix: this bench needs a box with a mix.");
    model.loading.tension.stop_fraction = std::min(model.loading.tension.stop_fraction, bench.work_until);
    model.loading.tension.stop_strain   = std::max(model.loading.tension.stop_strain, long_enough);
    const BenchResults    results(bench.folder, "mesoscale");
    const auto            mixes = chosen_mixes(bench.mixes);
    std::vector<Specimen> all;
    for (const double ductility : bench.ductility)
      for (const beygi::Mix *mix : mixes)
        for (int seed = 1; seed <= bench.geometries; ++seed)
          {
            all.push_back(run_specimen(model, *mix, ductility, seed, bench.work_until));
            const Specimen &s = all.back();
            fmt::print("{:<7} {} seed {}: {} aggregates, E {:.2f} GPa, f_t {:.3f} MPa, f_c {:.2f} MPa, G_f {:.2f} "
                       "J/m2, {:.1f} s\n",
                       mix->name, ductility, seed, s.aggregates, 1e-9 * s.found[0], 1e-6 * s.found[1],
                       1e-6 * s.found[2], s.found[3], s.seconds);
            std::fflush(stdout);
          }
    const std::vector<MixRow> rows = rows_of(bench, mixes, all);
    results.write(csv_of(all), table_of(rows));
    postprocess::write_text(bench.folder / "mesoscale_ratios.csv", ratios_csv_of(rows));
    fmt::print("{}", verdict_on(rows));
    std::vector<postprocess::PlotPanel> panels;
    for (const bool high : {false, true})
      for (std::size_t p = 0; p < names.size(); ++p)
        if (std::any_of(mixes.begin(), mixes.end(), [&](const beygi::Mix *mix) { return mix->high == high; }))
          panels.push_back(panel_of_property(rows, p, high));
    return results.finish(panels);
  }
} // namespace apps

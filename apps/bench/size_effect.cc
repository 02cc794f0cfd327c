#include "apps/bench/size_effect.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/bench/size_effect_laws.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/structure/model.h"
#include "apps/runs/structure/promotion.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace apps
{
  namespace
  {
    /** Shape of the beams, over their depth; the specimen, its notch and its core are as wide for all. */
    constexpr double length = 3, span = 2.5, notch = 0.3;

    /** One beam, as far as it was followed. */
    struct BrokenBeam
    {
      int         size = 0, geometry = 0;
      double      depth = 0, strength = 0, work = 0; ///< [m], sigma_N [Pa], over the ligament [J/m^2]
      double      left      = 0;                     ///< load at the end over the peak
      std::size_t particles = 0, points = 0;
      double      balance = 0, cost = 0; ///< error of the energies [-]; processor time [s]
    };

    std::string text_of(const double x, const double y, const double z)
    {
      return fmt::format("{:.9g}, {:.9g}, {:.9g}", x, y, z);
    }

    /** Entries of a beam of this depth and width, with elements of the scene's size. */
    std::vector<std::string> entries_of(const StructureModel &one, const double depth, const int geometry)
    {
      const BendingTestSection &test = one.bending_test;
      const double b = test.width, element = test.depth / 4, L = length * depth, middle = 0.5 * L, a = notch * depth;
      const auto  &core = one.handshakes.handshakes.front();
      const double half = 0.5 * (core.high[0] - core.low[0]), path = depth / test.depth;
      const double slit = 0.9e-3, lip = 3e-3, foot = 2.5e-3; // half its width, and how far groups reach
      const auto   box = [](const std::string &section, const std::string &low, const std::string &high) {
        return std::vector<std::string>{section + "/Lower=" + low, section + "/Upper=" + high};
      };
      std::vector<std::string> all = {fmt::format("Specimen/Box size={}", text_of(L, b, depth)),
                                      fmt::format("Specimen/Generator/Seed={}", geometry),
                                      fmt::format("Specimen/Mix/Seed={}", geometry),
                                      fmt::format("Continuum/Mesh/Box/Size={}", text_of(L, b, depth)),
                                      fmt::format("Continuum/Mesh/Box/Divisions x={:.0f}", L / element),
                                      fmt::format("Continuum/Mesh/Box/Divisions z={:.0f}", depth / element),
                                      fmt::format("Handshakes/core/Low={}", text_of(middle - half, -1, -1)),
                                      fmt::format("Handshakes/core/High={}", text_of(middle + half, 1, depth + 1)),
                                      fmt::format("Bending test/Span={:.9g}", span * depth),
                                      fmt::format("Bending test/Depth={:.9g}", depth),
                                      fmt::format("Bending test/Notch depth={:.9g}", a),
                                      fmt::format("Path/End={:.9g}", one.path.end * path),
                                      fmt::format("Path/Step={:.9g}", one.path.step * path)};
      const auto               add = [&all](const std::vector<std::string> &some) {
        all.insert(all.end(), some.begin(), some.end());
      };
      add(box("Voids/notch", text_of(middle - slit, -1, -1), text_of(middle + slit, 1, a)));
      add(box("Groups/left lip", text_of(middle - slit - lip, -1, std::max(0.0, a - 4e-3)),
              text_of(middle - slit, 1, a)));
      add(box("Groups/right lip", text_of(middle + slit, -1, std::max(0.0, a - 4e-3)),
              text_of(middle + slit + lip, 1, a)));
      add(box("Groups/load", text_of(middle - foot, -1, depth - foot), text_of(middle + foot, 1, depth + 1)));
      for (const auto &[support, side] : {std::pair{"left", -0.5}, std::pair{"right", 0.5}})
        {
          const double x = middle + side * span * depth;
          all.push_back(fmt::format("Continuum/Supports/{} support/From={}", support, text_of(x, 0, 0)));
          all.push_back(fmt::format("Continuum/Supports/{} support/To={}", support, text_of(x, b, 0)));
        }
      return all;
    }

    BrokenBeam broken(const SizeEffectBench &bench, const StructureModel &one, const int size, const int geometry)
    {
      const double                depth   = size * one.bending_test.depth;
      const SceneVariant          variant = {"size", fmt::format("{}", size), entries_of(one, depth, geometry)};
      const CheckedScene          checked = variant.of(bench.scene, bench.overrides);
      const StructureModel       &model   = model_of_kind<StructureModel>(checked, "structure");
      std::optional<dem::Packing> cell;
      const dem::Packing          packing = model.packing(&cell);
      const ParticleMedia         media   = model.media(cell);
      Promotion                   promotion(model, packing, media);
      const auto                  columns  = promotion.structure().columns();
      const auto                  reaction = std::find_if(columns.begin(), columns.end(),
                                                          [](const auto &column) { return column.name == "reaction_load_z"; });
      if (reaction == columns.end())
        refuse_scene(checked, "Groups/load: this bench needs it driven along z.");
      const double start = base::processor_seconds();
      double       peak = 0, last = 0;
      while (!promotion.structure().way().finished())
        {
          promotion.structure().way().advance();
          do
            last = std::fabs(promotion.structure().row().values[static_cast<std::size_t>(reaction - columns.begin())]);
          while (promotion.promote());
          peak = std::max(peak, last);
        }
      const Structure &structure = promotion.structure();
      BrokenBeam       found;
      found.size      = size;
      found.geometry  = geometry;
      found.depth     = depth;
      found.strength  = 1.5 * peak * model.bending_test.span / (model.bending_test.width * depth * depth);
      found.work      = structure.last().external_work / model.bending_test.ligament();
      found.left      = peak > 0 ? last / peak : 0;
      found.particles = structure.network().network.particles();
      found.points    = structure.way().points().size() - 1;
      found.balance   = structure.last().balance_error();
      found.cost      = base::processor_seconds() - start;
      return found;
    }

    std::string csv_of(const std::vector<BrokenBeam> &all)
    {
      std::string csv =
        "size,geometry,depth [m],nominal_strength [Pa],work_over_ligament [J/m^2],load_left [-],particles,points,"
        "balance_error [-],cost [s]\n";
      for (const BrokenBeam &b : all)
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", b.size, b.geometry, b.depth, b.strength, b.work, b.left,
                           b.particles, b.points, b.balance, b.cost);
      return csv;
    }

    struct Mean
    {
      double value = 0, deviation = 0;
    };

    Mean mean_of(const std::vector<BrokenBeam> &all, const int size, double BrokenBeam::*const member)
    {
      Mean   found;
      double n = 0, squares = 0;
      for (const BrokenBeam &b : all)
        if (b.size == size)
          {
            n += 1;
            found.value += b.*member;
          }
      found.value /= n;
      for (const BrokenBeam &b : all)
        if (b.size == size)
          squares += (b.*member - found.value) * (b.*member - found.value);
      found.deviation = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
      return found;
    }

    /** Young's modulus of the elements, which is that of the particles together. */
    double young_of(const StructureModel &one)
    {
      const auto   made = one.continuum.materials.groups.front()->make_points(fem::Plane::strain);
      const auto   D    = made->elastic_stiffness();
      const double G = D(3, 3), lambda = D(0, 1);
      return G * (3 * lambda + 2 * G) / (lambda + G);
    }

    std::string in_words(const Estimate &e, const double unit, const char *name)
    {
      return std::isfinite(e.half_width) ?
               fmt::format("{:.3g} ± {:.2g} {}", unit * e.value, unit * e.half_width, name) :
               fmt::format("{:.3g} {} (not determined)", unit * e.value, name);
    }

    /** What all beams say together, and what one size says of the others. */
    struct Answer
    {
      std::optional<SizeEffectLaw> bazant, exponent, predicted;
      std::string                  why_not;
      CrackOfLaw                   crack;
    };

    Answer answer_of(const SizeEffectBench &bench, const StructureModel &one, const std::vector<BrokenBeam> &all)
    {
      std::vector<SizeStrength> beams;
      for (const BrokenBeam &b : all)
        beams.push_back({b.depth, b.strength});
      Answer found;
      try
        {
          found.bazant = fitted_bazant(beams);
          found.crack  = crack_of(*found.bazant, notch, young_of(one));
          if (bench.sizes.size() > 2)
            found.exponent = fitted_with_exponent(beams);
          found.predicted = law_of_one_size(
            {bench.calibrated * one.bending_test.depth, mean_of(all, bench.calibrated, &BrokenBeam::strength).value},
            mean_of(all, bench.calibrated, &BrokenBeam::work).value, notch, young_of(one));
        }
      catch (const base::InputError &refusal)
        {
          found.why_not = refusal.what();
        }
      return found;
    }

    std::string table_of(const SizeEffectBench &bench, const std::vector<BrokenBeam> &all, const Answer &answer)
    {
      std::string md =
        fmt::format("Nominal strength 3PS/(2bD²), means and deviations of {} geometries; the last column is "
                    "predicted from size {} alone.\n\n"
                    "| D [mm] | Strength [MPa] | Work over ligament [J/m²] | Load left | Particles | Cost [s] | "
                    "Bažant | Free exponent | From one size |\n|---|---|---|---|---|---|---|---|---|\n",
                    bench.geometries, bench.calibrated);
      for (const int size : bench.sizes)
        {
          const Mean s = mean_of(all, size, &BrokenBeam::strength), w = mean_of(all, size, &BrokenBeam::work);
          const auto first = std::find_if(all.begin(), all.end(), [&](const BrokenBeam &b) { return b.size == size; });
          const auto off   = [&](const std::optional<SizeEffectLaw> &law) {
            return law ? fmt::format("{:.2f} ({:+.1f} %)", 1e-6 * law->at(first->depth),
                                       100 * (law->at(first->depth) / s.value - 1)) :
                           std::string("-");
          };
          md += fmt::format("| {:g} | {:.3f} ± {:.3f} | {:.1f} ± {:.1f} | {:.2f} | {} | {:.0f} | {} | {} | {} |\n",
                            1e3 * first->depth, 1e-6 * s.value, 1e-6 * s.deviation, w.value, w.deviation, first->left,
                            first->particles, mean_of(all, size, &BrokenBeam::cost).value, off(answer.bazant),
                            off(answer.exponent), off(answer.predicted));
        }
      if (answer.bazant)
        md += fmt::format("\nBažant: sigma_0 {}, D_0 {}; G_f {:.3g} J/m², c_f {:.3g} mm.\n",
                          in_words(answer.bazant->strength, 1e-6, "MPa"), in_words(answer.bazant->depth, 1e3, "mm"),
                          answer.crack.energy, 1e3 * answer.crack.zone);
      if (answer.exponent)
        md +=
          fmt::format("\nFree exponent: r {}, sigma_0 {}, D_0 {}.\n", in_words(answer.exponent->exponent, 1, ""),
                      in_words(answer.exponent->strength, 1e-6, "MPa"), in_words(answer.exponent->depth, 1e3, "mm"));
      if (!answer.why_not.empty())
        md += "\nNot found: " + answer.why_not + "\n";
      return md;
    }

    postprocess::PlotPanel
    panel_of_sizes(const SizeEffectBench &bench, const std::vector<BrokenBeam> &all, const Answer &answer)
    {
      postprocess::PlotPanel panel;
      panel.title   = "notched beams of one shape";
      panel.x_label = "Depth [mm]";
      panel.y_label = "Nominal strength [MPa]";
      panel.log_x = panel.log_y = true;
      postprocess::PlotSeries beams;
      beams.name  = "beams";
      beams.style = postprocess::PlotSeries::Style::points;
      for (const BrokenBeam &b : all)
        {
          beams.x.push_back(1e3 * b.depth);
          beams.y.push_back(1e-6 * b.strength);
        }
      panel.series      = {beams};
      const double from = *std::min_element(beams.x.begin(), beams.x.end()) / 1.5,
                   to   = *std::max_element(beams.x.begin(), beams.x.end()) * 1.5;
      for (const auto &[name, law] :
           {std::pair{std::string("Bazant"), answer.bazant}, std::pair{std::string("free exponent"), answer.exponent},
            std::pair{fmt::format("from size {} alone", bench.calibrated), answer.predicted}})
        {
          if (!law)
            continue;
          postprocess::PlotSeries line;
          line.name  = name;
          line.style = postprocess::PlotSeries::Style::line;
          for (int k = 0; k <= 40; ++k)
            {
              line.x.push_back(from * std::pow(to / from, k / 40.0));
              line.y.push_back(1e-6 * law->at(1e-3 * line.x.back()));
            }
          panel.series.push_back(line);
        }
      return panel;
    }
  } // namespace

  int run_size_effect_bench(const SizeEffectBench &asked)
  {
    start_mpi();
    SizeEffectBench bench = asked;
    if (bench.quick)
      {
        bench.sizes      = {1, 2};
        bench.geometries = 1;
      }
    const CheckedScene    scene = read_scene(bench.scene, bench.overrides);
    const StructureModel &one   = model_of_kind<StructureModel>(scene, "structure");
    if (!one.bending_test.evaluate() || one.handshakes.handshakes.size() != 1)
      refuse_scene(scene, "Bending test, Handshakes: this bench needs the test, and one handshake \"core\".");
    if (std::find(bench.sizes.begin(), bench.sizes.end(), bench.calibrated) == bench.sizes.end())
      throw base::InputError("command line: --calibrated: must be one of --sizes.");
    const BenchResults      results(bench.folder, "size_effect");
    std::vector<BrokenBeam> all;
    for (const int size : bench.sizes)
      for (int geometry = 1; geometry <= bench.geometries; ++geometry)
        {
          all.push_back(broken(bench, one, size, geometry));
          const BrokenBeam &b = all.back();
          fmt::print("D {:g} mm, geometry {}: {} particles, strength {:.3f} MPa, work over ligament {:.1f} J/m2 with "
                     "{:.0f} % of "
                     "the load left, balance {:.1e}, {:.0f} s\n",
                     1e3 * b.depth, geometry, b.particles, 1e-6 * b.strength, b.work, 100 * b.left, b.balance, b.cost);
          std::fflush(stdout);
          results.write(csv_of(all), "");
        }
    const Answer answer = answer_of(bench, one, all);
    results.write(csv_of(all), table_of(bench, all, answer));
    fmt::print("{}", table_of(bench, all, answer));
    return results.finish({panel_of_sizes(bench, all, answer)});
  }
} // namespace apps

#include "apps/drivers/homogenisation/scene.h"

#include "apps/drivers/homogenisation/report.h"
#include "apps/forecasts/duration.h"
#include "apps/process/version.h"
#include "apps/results/short_run.h"
#include "apps/results/warning.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/value_text.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/specimen_packing.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/packings/packing_io.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  namespace
  {
    constexpr const char *section_name = "Homogenisation";

    constexpr Range interaction_range = {1, 10, false};
    constexpr Range shear_range       = {1e-12, 1e12, false};

    /** Numbers between commas; empty if a part is none, or not within the range. */
    std::vector<double> numbers_in(const std::string &text, const Range &range)
    {
      std::vector<double> numbers;
      for (const std::string &part : comma_separated(text))
        {
          const auto number = number_in(part);
          if (!number || !range.contains(*number))
            return {};
          numbers.push_back(*number);
        }
      return numbers;
    }

    /** One case of the sweep, over all packings. */
    struct SweepPoint
    {
      double                            interaction_ratio, shear_ratio;
      std::vector<HomogenisationAnswer> answers;

      /** Nothing where no packing has the constant. */
      std::optional<SampleFigure> figure(FoundStiffness HomogenisationAnswer::*way,
                                         double dem::ElasticConstants::*constant) const
      {
        return sample_figure(constants_of(answers, way, constant));
      }
    };

    std::string csv_of(const std::vector<SweepPoint> &points)
    {
      std::string text = "interaction_ratio,shear_ratio";
      for (const HomogenisationWay &way : homogenisation_ways)
        text += fmt::format(",{0}_E [Pa],{0}_E_deviation [Pa],{0}_nu,{0}_nu_deviation", way.name);
      text += '\n';
      for (const SweepPoint &p : points)
        {
          text += fmt::format("{},{}", p.interaction_ratio, p.shear_ratio);
          for (const HomogenisationWay &way : homogenisation_ways)
            {
              const auto E  = p.figure(way.found, &dem::ElasticConstants::young);
              const auto nu = p.figure(way.found, &dem::ElasticConstants::poisson);
              text += E ? fmt::format(",{},{},{},{}", E->mean, E->deviation, nu->mean, nu->deviation) :
                          ",none,none,none,none"; // cells without moduli
            }
          text += '\n';
        }
      return text;
    }

    /** E/normal modulus and nu over the shear ratio: closed form as lines, relaxed as points with their scatter. */
    std::vector<postprocess::PlotPanel> panels_of(const std::vector<SweepPoint> &points, const double normal_modulus)
    {
      postprocess::PlotPanel young, poisson;
      young.title     = "Young's modulus";
      young.y_label   = "E / normal modulus of the links";
      poisson.title   = "Poisson's ratio";
      poisson.y_label = "nu";
      for (auto *panel : {&young, &poisson})
        {
          panel->x_label = "Shear ratio G/E of the links";
          panel->log_x   = true;
        }
      std::size_t colour = 0; // one for each interaction ratio
      for (std::size_t first = 0; first < points.size(); ++colour)
        {
          const double ratio = points[first].interaction_ratio;
          std::size_t  next  = first;
          while (next < points.size() && points[next].interaction_ratio == ratio)
            ++next;
          for (const HomogenisationWay &way : {homogenisation_ways[0], homogenisation_ways[2]})
            {
              postprocess::PlotSeries E, nu;
              E.name   = fmt::format("{} {}", way.name, ratio);
              E.style  = way.found == &HomogenisationAnswer::relaxed ? postprocess::PlotSeries::Style::points :
                                                                       postprocess::PlotSeries::Style::line;
              E.colour = postprocess::series_colour(colour);
              nu       = E;
              if (E.style == postprocess::PlotSeries::Style::line) // the closed form knows the shear ratio only
                {
                  nu.name   = "statistics, any interaction ratio";
                  nu.colour = "#000000";
                }
              for (std::size_t i = first; i < next; ++i)
                {
                  const auto e = points[i].figure(way.found, &dem::ElasticConstants::young);
                  const auto n = points[i].figure(way.found, &dem::ElasticConstants::poisson);
                  if (!e || !n)
                    continue; // a cell without moduli
                  E.x.push_back(points[i].shear_ratio);
                  E.y.push_back(e->mean / normal_modulus);
                  nu.x.push_back(points[i].shear_ratio);
                  nu.y.push_back(n->mean);
                  if (E.style == postprocess::PlotSeries::Style::points)
                    {
                      E.y_error.push_back(e->deviation / normal_modulus);
                      nu.y_error.push_back(n->deviation);
                    }
                }
              if (E.x.empty())
                continue;
              young.series.push_back(E);
              if (nu.style == postprocess::PlotSeries::Style::points || first == 0)
                poisson.series.push_back(nu);
            }
          first = next;
        }
      return {young, poisson};
    }
  } // namespace

  void HomogenisationScene::declare(Section &root)
  {
    Section &s = root.section(section_name, "Macroscopic stiffness of periodic packings, from links and relaxed");
    s.choice("Source", source,
             {{"generator", SpecimenSection::Source::generator}, {"file", SpecimenSection::Source::file}},
             Need::optional)
      .means("Packings made by compaction, or one read from a file");
    s.file("File", file)
      .means("Periodic packing")
      .only_if([this] { return source == SpecimenSection::Source::file; }, "Source = file");
    declare_packing_unit(s, length_unit)
      .only_if([this] { return source == SpecimenSection::Source::file; }, "Source = file");
    s.number("Particle radius", radius, "m", Range::positive(), Need::optional)
      .means("Of the spheres of made packings");
    s.integer("Particles", particles, "-", Range::between(8, 1e6), Need::optional)
      .means("Spheres of each made packing");
    s.integer("Seeds", seeds, "-", Range::between(1, 1000), Need::optional).means("Packings made, one per seed");
    s.number("Friction coefficient", friction, "-", Range::at_least(0), Need::optional)
      .means("During compaction; 1 leaves a packing fraction of 0.55, 0.1 of 0.61");
    s.number("Normal modulus", normal_modulus, "Pa", Range::positive(), Need::required).means("E of the link material");
    s.text("Interaction ratios", interaction_ratios, Need::required).means("Numbers from 1 to 10, separated by commas");
    s.text("Shear ratios", shear_ratios, Need::required)
      .means("G/E of the link material, numbers above 0, separated by commas");
    s.number("Thickness", thickness, "m", Range::at_least(0), Need::optional)
      .means("0: spheres; above: the packing of the file is of discs this thick");
    s.number("Tolerance", tolerance, "-", Range::between(1e-13, 1e-2), Need::optional)
      .means("Unbalanced force over link forces");
  }

  void HomogenisationScene::check() const
  {
    const base::EntryPath root;
    const base::EntryPath s = root.at(section_name);
    if (numbers_in(interaction_ratios, interaction_range).empty())
      s.refuse("Interaction ratios", "expected numbers from 1 to 10, separated by commas, e.g. 1.05, 1.25, 1.5.");
    if (numbers_in(shear_ratios, shear_range).empty())
      s.refuse("Shear ratios", "expected numbers above 0, from 1e-12 to 1e12, separated by commas, e.g. 0.1, 0.2, 1.");
    if (thickness > 0 && source == SpecimenSection::Source::generator)
      s.refuse("Thickness", "packings of discs are not made here. Take one from a file.");
  }

  std::vector<dem::Packing> HomogenisationScene::packings() const
  {
    if (source == SpecimenSection::Source::file)
      return {postprocess::read_packing(file, length_unit)};
    std::vector<dem::Packing> made;
    for (std::int64_t seed = 1; seed <= seeds; ++seed)
      made.push_back(made_packing(seed));
    return made;
  }

  dem::Packing HomogenisationScene::made_packing(const std::int64_t seed) const
  {
    dem::CompactionParameters parameters;
    parameters.radius   = radius;
    parameters.count    = static_cast<std::size_t>(particles);
    parameters.friction = friction;
    parameters.seed     = static_cast<std::uint64_t>(seed);
    return compact_with_progress(parameters).packing;
  }

  HomogenisationQuestion HomogenisationScene::question(const double interaction_ratio, const double shear_ratio) const
  {
    HomogenisationQuestion asked;
    asked.links.dimension         = thickness > 0 ? 2 : 3;
    asked.links.thickness         = thickness;
    asked.links.interaction_ratio = interaction_ratio;
    asked.links.shear_ratio       = shear_ratio;
    asked.links.normal_modulus    = normal_modulus;
    asked.solver.tolerance        = tolerance;
    return asked;
  }

  std::string HomogenisationScene::forecast() const
  {
    const std::vector<double> interaction = numbers_in(interaction_ratios, interaction_range),
                              shear       = numbers_in(shear_ratios, shear_range);
    const bool            made            = source == SpecimenSection::Source::generator;
    const auto            count           = static_cast<double>(made ? seeds : 1);
    const base::Stopwatch making;
    const dem::Packing    first          = made ? made_packing(1) : postprocess::read_packing(file, length_unit);
    const double          making_seconds = making.seconds();
    double                solving = 0; // of all cases of the first packing, one solved for each interaction ratio
    for (const double ratio : interaction)
      {
        const base::Stopwatch watch;
        homogenise(first, question(ratio, shear.front()), made ? "generator" : file);
        solving += watch.seconds() * static_cast<double>(shear.size());
      }
    return fmt::format("  packings     {:.0f}, of {} particles\n", count, first.size()) +
           extent_lines(first, thickness > 0 ? 2 : 3) +
           fmt::format("  solutions    {:.0f}, of six load cases each\n",
                       count * static_cast<double>(interaction.size() * shear.size())) +
           duration_line(count * (making_seconds + solving));
  }

  RunResult HomogenisationScene::run(const RunRequest &request) const
  {
    ShortRun                        run(request, "a homogenisation");
    const std::string               origin = source == SpecimenSection::Source::file ? file : "generator";
    const std::vector<dem::Packing> bodies = packings();
    std::vector<SweepPoint>         points;
    nlohmann::json                  json;
    json["made_by"] = "breccia " + version();
    json["cases"]   = nlohmann::json::array();
    for (const double iota : numbers_in(interaction_ratios, interaction_range))
      for (const double ratio : numbers_in(shear_ratios, shear_range))
        {
          if (run.interrupted())
            return run.interrupted_result();
          const HomogenisationQuestion asked = question(iota, ratio);
          SweepPoint                   point{iota, ratio, {}};
          for (const dem::Packing &body : bodies)
            point.answers.push_back(homogenise(body, asked, origin));
          run.says(fmt::format("G/E = {:<8} {}{}\n", ratio, table_of(point.answers.front(), asked),
                               scatter_table(point.answers)));
          nlohmann::json entry = json_of(point.answers.front());
          if (point.answers.size() > 1)
            entry["scatter"] = scatter_json(point.answers);
          entry["interaction_ratio"] = iota;
          entry["shear_ratio"]       = ratio;
          json["cases"].push_back(entry);
          points.push_back(std::move(point));
        }

    return run.complete(std::move(json), [&](const std::filesystem::path &folder) {
      postprocess::write_text(folder / "homogenised.csv", csv_of(points));
      warn_of_missing("homogenised.png",
                      postprocess::plot(folder / "homogenised.png", panels_of(points, normal_modulus)));
    });
  }
} // namespace apps

#include "apps/drivers/transmission/scene.h"

#include "apps/drivers/transmission/methods.h"
#include "apps/drivers/transmission/report.h"
#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/process/version.h"
#include "apps/results/short_run.h"
#include "apps/results/warning.h"
#include "apps/scene/name_list.h"
#include "apps/scene/number_list.h"
#include "apps/scene/value_text.h"
#include "apps/specimens/specimen_packing.h"
#include "base/stopwatch.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *transmission_section = "Waves";

    std::string method_names()
    {
      std::string names;
      for (const coupling::WaveMethod &method : wave_methods())
        names += (names.empty() ? "" : ", ") + method.name;
      return names;
    }

  } // namespace

  void TransmissionScene::declare(Section &root)
  {
    Section &s =
      root.section(transmission_section, "Packets of waves that run through particles and on into a continuum");
    s.choice("Medium", common.medium.lattice,
             {{"chain", coupling::WaveMedium::Lattice::chain},
              {"strip", coupling::WaveMedium::Lattice::strip},
              {"plane", coupling::WaveMedium::Lattice::plane},
              {"bar", coupling::WaveMedium::Lattice::bar}},
             Need::optional)
      .means("Particles in a row, in hexagonal rows of an unbounded plane for waves along them, the same for narrow "
             "packets of any "
             "direction, or spheres without order in a bar");
    s.number("Spacing", common.medium.spacing, "m", Range::positive(), Need::optional).means("Of neighbours");
    s.number("Normal modulus", common.medium.modulus, "Pa", Range::positive(), Need::required).means("Of the links");
    s.number("Density", common.medium.density, "kg/m^3", Range::positive(), Need::required)
      .means("Of the medium, voids included; the continuum has the same");
    s.integer("Rows", common.medium.rows, "-", Range::between(2, 1000), Need::optional)
      .means("Of a strip, from one line of symmetry to the other")
      .only_if([this] { return common.medium.lattice == coupling::WaveMedium::Lattice::strip; }, "Medium = strip");
    const auto of_bar = [this] { return common.medium.lattice == coupling::WaveMedium::Lattice::bar; };
    s.integer("Width", common.medium.width, "-", Range::between(1, 64), Need::optional)
      .means("Of a bar, in elements")
      .only_if(of_bar, "Medium = bar");
    s.number("Shear ratio", common.medium.shear_ratio, "-", Range::positive(), Need::optional)
      .means("Of the links of spheres, shear over normal modulus")
      .only_if(of_bar, "Medium = bar");
    s.number("Scatter", common.medium.scatter, "-", Range::between(0, 0.9), Need::optional)
      .means("Of the links' stiffness: anywhere between 1 - Scatter and 1 + Scatter of what the normal modulus gives")
      .only_if([of_bar] { return !of_bar(); }, "Medium = chain, strip or plane");
    s.integer("Seed", common.medium.seed, "-", Range::between(0, 1000000), Need::optional)
      .means("Of the spheres' packing, and of what Scatter says");
    s.flag("Shear", common.shear).means("Waves of shear, not of compression; in a strip");
    declare_list(s, "Wavelengths", wavelengths, "m", Need::required)
      .means("[m], four spacings at least, separated by commas");
    s.text("Methods", methods, Need::optional).means("Of the coupling, separated by commas: " + method_names());
    s.integer("Element size", common.element, "-", Range::between(1, 64), Need::optional)
      .means("Of the continuum, over the spacing");
    s.integer("Overlap", common.overlap, "-", Range::between(1, 64), Need::optional)
      .means("Where both fill the same space, in elements");
    s.choice("Node masses", common.nearest_masses, {{"rows", false}, {"nearest", true}}, Need::optional)
      .means(
        "Of the continuum in the overlap: sums over rows of the consistent mass, which keep its centre, or what lies "
        "nearest to the node, as the published tables have it");
    s.number("Step factor", common.step_factor, "-", Range::from_up_to(1e-3, 1), Need::optional)
      .means("Time step over the stable one of the particles");
    s.number("Layer", proportions.layer, "-", Range::at_least(0), Need::optional)
      .means("How far absorbers reach into the particles, in elements");
    s.number("Rate", proportions.rate, "-", Range::at_least(0), Need::optional)
      .means("Of absorbers at its largest, times element size over speed of compression waves");
    s.number("Grid", proportions.grid, "-", Range::between(0.1, 10), Need::optional)
      .means("Of the absorbers' averages, in elements");
    s.number("Phase", proportions.phase, "-", Range::from_up_to(0.1, 2), Need::optional)
      .means(
        "Longest time that absorbers damp at once, times their largest eigenvalue; less is nearer to the exponential");
    s.number("Angle", degrees, "-", Range::between(0, 60), Need::optional)
      .means("Of the packets' way with the normal of the overlap, in degrees")
      .only_if([this] { return common.medium.lattice == coupling::WaveMedium::Lattice::plane; }, "Medium = plane");
  }

  std::vector<coupling::WaveMethod> TransmissionScene::chosen() const
  {
    std::vector<coupling::WaveMethod> found;
    for (const std::string &name : names_in(methods))
      {
        const auto &all = wave_methods();
        const auto  one =
          std::find_if(all.begin(), all.end(), [&](const coupling::WaveMethod &m) { return m.name == name; });
        if (one == all.end())
          return {};
        found.push_back(*one);
        found.back().proportions = proportions;
      }
    return found;
  }

  std::vector<double> TransmissionScene::lengths() const
  {
    std::vector<double> found;
    for (const std::string &part : comma_separated(wavelengths))
      {
        const auto number = number_in(part);
        if (!number || !(*number >= 4 * common.medium.spacing) || !(*number < 1e4 * common.medium.spacing))
          return {};
        found.push_back(*number);
      }
    return found;
  }

  coupling::WaveCase TransmissionScene::wave(const coupling::WaveMethod &method, const double length) const
  {
    coupling::WaveCase one = common;
    one.compact            = compact_with_progress;
    one.method             = method;
    one.angle              = degrees * M_PI / 180;
    one.wavelength         = length;
    return one;
  }

  void TransmissionScene::check() const
  {
    const base::EntryPath root;
    const base::EntryPath s = root.at(transmission_section);
    if (lengths().empty())
      s.refuse("Wavelengths", fmt::format("expected numbers from {} to {} m, 4 to 10000 spacings, separated by commas.",
                                          4 * common.medium.spacing, 1e4 * common.medium.spacing));
    if (chosen().empty())
      s.refuse("Methods", "expected names among " + method_names() + ", separated by commas.");
    const bool one_way = common.medium.lattice == coupling::WaveMedium::Lattice::chain ||
                         common.medium.lattice == coupling::WaveMedium::Lattice::bar;
    if (common.shear && one_way)
      s.refuse("Shear", "particles in a row or bar move along it. Take Medium = strip.");
    if (common.medium.scatter > 0 && common.medium.lattice == coupling::WaveMedium::Lattice::bar)
      s.refuse("Scatter", "spheres in a bar have no order as it is. Take Medium = chain, strip or plane.");
  }

  std::string TransmissionScene::forecast() const
  {
    start_mpi();
    // The shortest packet tells; cost grows with the square of the length.
    const auto            all      = lengths();
    const double          shortest = *std::min_element(all.begin(), all.end());
    const base::Stopwatch watch;
    const auto            answer  = coupling::transmit(wave(chosen().front(), shortest));
    const double          seconds = watch.seconds();
    double                sum     = 0;
    for (const double length : all)
      sum +=
        coupling::wave_cost(wave(chosen().front(), length)) / coupling::wave_cost(wave(chosen().front(), shortest));
    return fmt::format("  packets      {}, of {} steps of {} particles at least\n", all.size() * chosen().size(),
                       answer.steps, answer.particles) +
           duration_line(seconds * sum * static_cast<double>(chosen().size()));
  }

  RunResult TransmissionScene::run(const RunRequest &request) const
  {
    ShortRun run(request, "a packet of waves");
    start_mpi();
    std::vector<WavePoint> points;
    for (const coupling::WaveMethod &method : chosen())
      for (const double length : lengths())
        {
          if (run.interrupted())
            return run.interrupted_result();
          points.push_back({method.name, length, coupling::transmit(wave(method, length))});
          const coupling::WaveAnswer &a = points.back().answer;
          run.says(fmt::format("{:14} wavelength {:<10.4g} m: reflected {:.4f}, transmitted {:.4f}, absorbed {:.4f}\n",
                               method.name, length, a.reflected, a.transmitted, a.absorbed));
        }
    nlohmann::json json;
    json["made_by"] = "breccia " + version();
    json["waves"]   = json_of_waves(points);

    return run.complete(std::move(json), [&](const std::filesystem::path &folder) {
      postprocess::write_text(folder / "reflection.csv", csv_of_waves(points));
      warn_of_missing("reflection.png", postprocess::plot(folder / "reflection.png", wave_panels(points, common)));
    });
  }
} // namespace apps

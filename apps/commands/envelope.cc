#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/figures/summary_head.h"
#include "apps/process/exit_status.h"
#include "apps/process/version.h"
#include "apps/results/result_folder.h"
#include "apps/results/warning.h"
#include "apps/scene/constant_entries.h"
#include "apps/scene/overrides.h"
#include "apps/scene/reader.h"
#include "fem/materials/damage_plastic/strength_envelope.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"
#include "postprocess/pictures/plot.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace apps
{
  namespace
  {
    constexpr double degree = 3.14159265358979323846 / 180;

    struct EnvelopeOptions
    {
      std::vector<std::string> constants;
      std::string              folder;
      int                      directions = 96;
    };

    /** Strengths by which concretes are compared. */
    struct Figures
    {
      double compressive, tensile, biaxial, shear; ///< [Pa], magnitudes
    };

    Figures figures_of(const fem::DamagePlasticConcrete &law)
    {
      return {std::fabs(fem::strength_towards(law, 180 * degree).stress_x), fem::strength_towards(law, 0).stress_x,
              std::fabs(fem::strength_towards(law, 225 * degree).stress_x),
              std::fabs(fem::strength_towards(law, 315 * degree).stress_x)};
    }

    std::string csv_of(const std::vector<fem::EnvelopePoint> &points)
    {
      std::string text =
        "angle [rad],stress_xx [Pa],stress_yy [Pa],strain_xx [-],strain_yy [-],strain_zz [-],kappa_P [-]\n";
      for (const fem::EnvelopePoint &p : points)
        text += fmt::format("{},{},{},{},{},{},{}\n", p.angle, p.stress_x, p.stress_y, p.strain_x, p.strain_y,
                            p.strain_z, p.kappa_p);
      return text;
    }

    postprocess::PlotPanel panel_of(const std::vector<fem::EnvelopePoint> &points, const double unit)
    {
      postprocess::PlotPanel  panel;
      postprocess::PlotSeries curve;
      panel.title      = "Biaxial strength in plane stress";
      panel.x_label    = "sigma_xx / f_c";
      panel.y_label    = "sigma_yy / f_c";
      panel.equal_axes = true;
      curve.name       = "damage-plastic concrete, proportional paths";
      for (const fem::EnvelopePoint &p : points)
        {
          curve.x.push_back(p.stress_x / unit);
          curve.y.push_back(p.stress_y / unit);
        }
      curve.x.push_back(curve.x.front());
      curve.y.push_back(curve.y.front());
      panel.series.push_back(std::move(curve));
      return panel;
    }

    void write(const EnvelopeOptions &options, const std::vector<fem::EnvelopePoint> &points, const Figures &f)
    {
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_text(folder.running() / "envelope.csv", csv_of(points));
      nlohmann::json json;
      json["requested"] = {{"kind", "envelope"}, {"constants", options.constants}, {"directions", options.directions}};
      json["version"]   = version();
      json["figures"]   = {{"compressive_strength", quantity(f.compressive, "Pa")},
                           {"tensile_strength", quantity(f.tensile, "Pa")},
                           {"biaxial_compressive_strength", quantity(f.biaxial, "Pa")},
                           {"shear_strength", quantity(f.shear, "Pa")},
                           {"biaxial_ratio", quantity(f.biaxial / f.compressive, "-")},
                           {"shear_ratio", quantity(f.shear / f.compressive, "-")}};
      postprocess::write_json(folder.running() / "summary.json", json);
      warn_of_missing("envelope.png",
                      postprocess::plot(folder.running() / "envelope.png", {panel_of(points, f.compressive)}));
      folder.publish();
    }

    int envelope(const EnvelopeOptions &options)
    {
      fem::DamagePlasticParameters parameters;
      Section                      constants;
      fem::DamagePlasticConcrete::describe(parameters, ConstantEntries{constants});
      assign(constants, read_overrides(options.constants), "command line");
      try
        {
          const fem::DamagePlasticConcrete law(parameters);
          const Figures                    f = figures_of(law);
          fmt::print("uniaxial compression f_c   {:>12.6g} Pa\n", f.compressive);
          fmt::print("uniaxial tension     f_t   {:>12.6g} Pa   f_t/f_c = {:.6f}\n", f.tensile,
                     f.tensile / f.compressive);
          fmt::print("equal biaxial        f_b   {:>12.6g} Pa   f_b/f_c = {:.6f}\n", f.biaxial,
                     f.biaxial / f.compressive);
          fmt::print("pure shear           tau   {:>12.6g} Pa   tau/f_c = {:.7f}\n", f.shear, f.shear / f.compressive);
          if (!options.folder.empty())
            {
              write(options, fem::biaxial_envelope(law, options.directions), f);
              fmt::print("written to {}: envelope.csv, envelope.png, summary.json\n", options.folder);
            }
          return exit_success;
        }
      catch (const base::InputError &refusal)
        {
          throw base::InputError(std::string("material: ") + refusal.what());
        }
    }
  } // namespace

  void add_envelope(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<EnvelopeOptions>();
    CLI::App  &command = *program.add_subcommand(
       "envelope", "Biaxial strength of damage-plastic concrete (Kupfer's envelope), found by loading a point");
    add_overrides(command, options->constants,
                  "Constant of the material, e.g. -s \"Young modulus=30e9\"; repeatable; Element size is needed");
    command.add_option("--directions", options->directions, "Loading directions around the circle; default: 96")
      ->type_name("N")
      ->check(CLI::Range(4, 100000));
    command.add_option("-o,--output", options->folder, "Folder for table, plot and summary; default: only numbers")
      ->type_name("DIR");
    command.callback([options, &chosen] { chosen = [options] { return envelope(*options); }; });
  }
} // namespace apps

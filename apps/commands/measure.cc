#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/process/version.h"
#include "apps/results/result_folder.h"
#include "base/errors.h"
#include "dem/observation/measured_state.h"
#include "postprocess/files/summary.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace apps
{
  namespace
  {
    struct MeasureOptions
    {
      std::string         state, folder;
      std::vector<double> box; ///< bounds of x, y, z [m]; empty: all
    };

    std::optional<dem::MeasuredBox> box_of(const std::vector<double> &bounds)
    {
      if (bounds.empty())
        return std::nullopt;
      for (std::size_t d = 0; d < 3; ++d)
        if (!(bounds[2 * d] < bounds[2 * d + 1]))
          throw base::InputError(fmt::format("command line: --box: {} to {} along {} is no range.", bounds[2 * d],
                                             bounds[2 * d + 1], "xyz"[d]));
      return dem::MeasuredBox{{bounds[0], bounds[2], bounds[4]}, {bounds[1], bounds[3], bounds[5]}};
    }

    nlohmann::json json_of(const Eigen::Matrix3d &m)
    {
      return {{"xx", m(0, 0)}, {"yy", m(1, 1)}, {"zz", m(2, 2)}, {"yz", m(1, 2)}, {"zx", m(2, 0)}, {"xy", m(0, 1)}};
    }

    nlohmann::json json_of(const dem::MeasuredState &found)
    {
      nlohmann::json json = {{"particles", found.particles},
                             {"held", found.held},
                             {"volume", {{"value", found.volume}, {"unit", "m^3"}}},
                             {"stress", {{"value", json_of(found.stress)}, {"unit", "Pa"}}},
                             {"links", {{"made", found.links}, {"gone", found.gone}}},
                             {"mean_damage", {{"value", found.mean_damage}, {"unit", "-"}}},
                             {"damage_tensor", json_of(found.damage)},
                             {"coordination",
                              {{"mean", found.coordination.mean},
                               {"mechanical", found.coordination.mechanical},
                               {"particles_by_links", found.coordination.particles}}}};
      if (found.solid)
        json["solid"] = {{"value", *found.solid}, {"unit", "-"}};
      if (found.fitted_damage)
        json["fitted_damage_tensor"] = json_of(*found.fitted_damage);
      if (found.fabric_made)
        json["fabric"]["made"] = json_of(found.fabric_made->second);
      if (found.fabric_holding)
        json["fabric"]["holding"] = json_of(found.fabric_holding->second);
      if (found.directions)
        json["directions"] = {{"anisotropy", found.directions->anisotropy}, {"by_chance", found.directions->by_chance}};
      return json;
    }

    std::string line_of(const char *what, const Eigen::Matrix3d &m, const double unit = 1, const char *name = "")
    {
      return fmt::format("{:<22} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g}  {}\n", what,
                         m(0, 0) / unit, m(1, 1) / unit, m(2, 2) / unit, m(1, 2) / unit, m(2, 0) / unit, m(0, 1) / unit,
                         name);
    }

    std::string text_of(const dem::MeasuredState &found)
    {
      std::string text =
        fmt::format("particles              {}, {} of them held by grips\n", found.particles, found.held);
      text += fmt::format("volume                 {:.6g} m^3{}\n", found.volume,
                          found.solid ? fmt::format(", {:.1f} % of it solid", 100 * *found.solid) : "");
      text += fmt::format("links                  {} made, {} gone, mean damage {:.4g}\n", found.links, found.gone,
                          found.mean_damage);
      text += fmt::format("coordination           {:.3f}, without what carries nothing {:.3f}\n",
                          found.coordination.mean, found.coordination.mechanical);
      if (found.directions)
        text += fmt::format("anisotropy of links    {:.3f}; as many even directions show {:.3f} by chance\n",
                            found.directions->anisotropy, found.directions->by_chance);
      text += fmt::format("{:<22} {:>11} {:>11} {:>11} {:>11} {:>11} {:>11}\n", "", "xx", "yy", "zz", "yz", "zx", "xy");
      text += line_of("stress", found.stress, 1e6, "MPa");
      if (found.fabric_made)
        text += line_of("fabric, links made", found.fabric_made->second);
      if (found.fabric_holding)
        text += line_of("fabric, links holding", found.fabric_holding->second);
      text += line_of("damage, even", found.damage);
      if (found.fitted_damage)
        text += line_of("damage, fitted", *found.fitted_damage);
      return text;
    }

    int measure(const MeasureOptions &options)
    {
      const std::optional<dem::MeasuredBox> box   = box_of(options.box);
      const dem::DiscreteState              state = postprocess::read_discrete_state(options.state);
      const dem::MeasuredState              found = dem::measured(state, box);
      fmt::print("{}", text_of(found));
      if (options.folder.empty())
        return exit_success;
      nlohmann::json json = json_of(found);
      json["made_by"]     = "breccia " + version();
      json["state"]       = options.state;
      json["time"]        = {{"value", state.time}, {"unit", "s"}};
      if (box)
        json["box"] = options.box;
      ResultFolder folder(options.folder, ResultFolder::Start::afresh);
      postprocess::write_json(folder.running() / "measured.json", json);
      folder.publish();
      fmt::print("\nwritten to {}/measured.json\n", options.folder);
      return exit_success;
    }
  } // namespace

  void add_measure(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App  &command =
      *program.add_subcommand("measure", "Mean stress, fabric, coordination and damage of a saved state of particles");
    command.add_option("state", options->state, "A state that a run of bonded particles left: state.h5, TEST_state.h5")
      ->required()
      ->type_name("STATE");
    command.add_option("--box", options->box, "Only what lies in there: bounds of x, y and z [m]")
      ->expected(6)
      ->type_name("XMIN XMAX YMIN YMAX ZMIN ZMAX");
    command.add_option("-o,--output", options->folder, "Folder for measured.json")->type_name("DIR");
    command.callback([options, &chosen] { chosen = [options] { return measure(*options); }; });
  }
} // namespace apps

#include "apps/runs/sequential/transfer_output.h"

#include "postprocess/files/errors.h"
#include "postprocess/vtk/vtk_points.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace
  {
    postprocess::PointCloud
    cloud_of(const coupling::ParticleField &field, const coupling::TransferOptions &options, const double element_size)
    {
      const coupling::Averaging    averaging(field, options.averaging);
      std::vector<Eigen::Matrix3d> stress, damage, stress_difference, damage_difference;
      std::vector<double>          raw, scalar_damage;
      for (std::size_t i = 0; i < field.size(); ++i)
        {
          const coupling::Average there = averaging.at(field.place[i], element_size);
          stress.push_back(there.stress);
          damage.push_back(there.damage);
          stress_difference.push_back(there.stress - field.stress[i]);
          damage_difference.push_back(there.damage - field.damage[i]);
          raw.push_back(coupling::map_damage(there.damage, options.law).raw);
          scalar_damage.push_back(field.damage[i].trace() / field.dimension);
        }
      postprocess::PointCloud cloud;
      cloud.place   = field.place;
      cloud.scalars = {
        {"radius", field.radius}, {"volume", field.volume}, {"damage", scalar_damage}, {"mapped_raw_damage", raw}};
      cloud.tensors = {{"stress", field.stress},
                       {"damage_tensor", field.damage},
                       {"mapped_stress", stress},
                       {"mapped_damage_tensor", damage},
                       {"stress_difference", stress_difference},
                       {"damage_tensor_difference", damage_difference}};
      return cloud;
    }

    postprocess::PointCloud cloud_of(const coupling::TransferReport &report)
    {
      postprocess::PointCloud      cloud;
      std::vector<double>          volume, particles, offset, raw, damage, driving, hardening, returned;
      std::vector<Eigen::Matrix3d> stress, tensor;
      for (const coupling::MappedPoint &p : report.points)
        {
          cloud.place.push_back(p.place);
          volume.push_back(p.volume);
          particles.push_back(static_cast<double>(p.average.particles));
          offset.push_back(p.average.offset);
          raw.push_back(p.mapped.raw);
          damage.push_back(p.mapped.damage);
          driving.push_back(p.damage_driving);
          hardening.push_back(p.hardening);
          returned.push_back(p.returned);
          stress.push_back(p.average.stress);
          tensor.push_back(p.average.damage);
        }
      cloud.scalars = {{"volume", volume},       {"particles", particles},     {"offset", offset},
                       {"raw_damage", raw},      {"damage", damage},           {"damage_driving", driving},
                       {"hardening", hardening}, {"returned_stress", returned}};
      cloud.tensors = {{"stress", stress}, {"damage_tensor", tensor}};
      return cloud;
    }

    /** Relative to the output folder. */
    std::string particles_file(const std::size_t number) { return fmt::format("transfer/particles_{:03}.vtp", number); }
    std::string points_file(const std::size_t number) { return fmt::format("transfer/points_{:03}.vtp", number); }

    double mean_size(const coupling::TransferReport &report)
    {
      double sum = 0;
      for (const coupling::MappedPoint &p : report.points)
        sum += p.size;
      return report.points.empty() ? 0 : sum / static_cast<double>(report.points.size());
    }
  } // namespace

  TransferPicture::TransferPicture(const std::filesystem::path &folder)
    : output(folder)
  {
    std::error_code error;
    std::filesystem::create_directories(output / "transfer", error);
    if (error)
      throw postprocess::OutputError((output / "transfer").string() +
                                     ": the folder cannot be made: " + error.message() + ".");
  }

  void TransferPicture::write(const std::size_t                number,
                              const coupling::ParticleField   &field,
                              const coupling::TransferOptions &options,
                              const coupling::TransferReport  &report) const
  {
    const auto time = static_cast<double>(number);
    postprocess::write_vtk_points(output / particles_file(number), postprocess::field_file("transferred particles"),
                                  cloud_of(field, options, mean_size(report)), time);
    postprocess::write_vtk_points(output / points_file(number), postprocess::field_file("integration points"),
                                  cloud_of(report), time);
  }

  void TransferPicture::show(const std::size_t number, const std::string &mesh_file)
  {
    const auto time = static_cast<double>(number);
    parts.push_back({time, 0, "particles", particles_file(number)});
    parts.push_back({time, 1, "integration points", points_file(number)});
    if (!mesh_file.empty())
      parts.push_back({time, 2, "mesh", mesh_file});
    postprocess::write_pvd(output / "transfer.pvd", parts);
  }

  nlohmann::json json_of(const coupling::TransferReport &report, const coupling::Equilibration &settled)
  {
    const coupling::TransferCount &c         = report.count;
    const auto                     imbalance = [](const coupling::Imbalance &i) {
      return nlohmann::json{{"largest", i.largest}, {"relative", i.relative()}, {"unit", "N"}};
    };
    nlohmann::json json;
    json["points"]         = {{"all", c.points},
                              {"elastic", c.elastic},
                              {"empty", c.empty},
                              {"sparse", c.sparse},
                              {"boundary", c.boundary},
                              {"averaged_instead_of_fitted", c.averaged},
                              {"damaged", c.damaged},
                              {"fully_damaged", c.fully_damaged},
                              {"at_switch", c.at_switch},
                              {"returned_to_yield_surface", c.returned},
                              {"far_outside_yield_surface", c.outside}};
    json["largest_return"] = {{"value", report.largest_return}, {"unit", "Pa"}};
    json["volume"]         = {
              {"particles", report.integrals.volume_particles}, {"points", report.integrals.volume_points}, {"unit", "m^3"}};
    json["volume"]["filled"] = report.cuts.filled;
    json["strength"] = {{"value", report.strength}, {"unit", "Pa"}}; // what the errors of small stresses relate to
    json["mean_stress_error"] = report.integrals.stress_error(report.strength);
    json["mean_damage_error"] = report.integrals.damage_error();
    json["cuts"]              = {{"count", report.cuts.points.size()},
                                 {"force_error", report.cuts.force_error(report.strength)},
                                 {"moment_error", report.cuts.moment_error(report.strength)}};
    json["imbalance"]         = {{"before", imbalance(settled.before)}, {"after", imbalance(settled.after)}};
    json["equilibrium"]       = {{"iterations", settled.iterations},
                                 {"damped_steps", settled.relaxed},
                                 {"largest_displacement", {{"value", settled.largest_displacement}, {"unit", "m"}}},
                                 {"energy_released", {{"value", settled.released}, {"unit", "J"}}},
                                 {"energy_damped", {{"value", settled.damped}, {"unit", "J"}}}};
    return json;
  }

  std::string text_of(const coupling::TransferReport &report, const coupling::Equilibration &settled)
  {
    const coupling::TransferCount &c       = report.count;
    double                         largest = 0;
    for (const coupling::MappedPoint &p : report.points)
      largest = std::max(largest, p.mapped.damage);
    std::string text =
      fmt::format("  points       {} with history: {} damaged (up to {:.3g}), {} fully, {} near the switch\n", c.points,
                  c.damaged, largest, c.fully_damaged, c.at_switch);
    text += fmt::format(
      "  yield        {} points outside the yield surface, {} of them far (stress lost: {:.2g} MPa at most)\n",
      c.returned, c.outside, 1e-6 * report.largest_return);
    text += fmt::format("  averages     {} without particles, {} sparse, {} one-sided, {} not fitted\n", c.empty,
                        c.sparse, c.boundary, c.averaged);
    text += fmt::format(
      "  particles    points differ from them by {:.2g} % in mean stress, {:.2g} % in forces and {:.2g} % in "
      "moments of cuts\n               (of the larger of what there is and what the tensile strength of "
      "{:.3g} MPa makes), {:.2g} % in mean damage\n",
      100 * report.integrals.stress_error(report.strength), 100 * report.cuts.force_error(report.strength),
      100 * report.cuts.moment_error(report.strength), 1e-6 * report.strength, 100 * report.integrals.damage_error());
    if (report.cuts.filled > 0)
      text +=
        fmt::format("  volume       particles (gripped ones too) fill {:.0f} % of the solid: at equal stress they bear "
                    "about as much of its force\n",
                    100 * report.cuts.filled);
    if (settled.before.at_hand == 0) // found no equilibrium: the caller says why
      return text;
    text += fmt::format(
      "  imbalance    {:.2e} of the forces at hand before, {:.2e} after {} iterations{} that moved {:.2e} m\n",
      settled.before.relative(), settled.after.relative(), settled.iterations,
      settled.relaxed > 0 ? fmt::format(" in {} damped steps", settled.relaxed) : "", settled.largest_displacement);
    return text;
  }
} // namespace apps

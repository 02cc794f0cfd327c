#include "apps/drivers/transfer_output.h"

#include "postprocess/errors.h"
#include "postprocess/vtk_points.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    double worst(const CutComparison &cuts, Eigen::Vector3d coupling::SectionForce::*what)
    {
      double difference = 0, size = 0;
      for (std::size_t s = 0; s < cuts.points.size(); ++s)
        {
          difference = std::max(difference, (cuts.points[s].*what - cuts.particles[s].*what).norm());
          size       = std::max({size, (cuts.points[s].*what).norm(), (cuts.particles[s].*what).norm()});
        }
      return size > 0 ? difference / size : 0;
    }

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
      std::vector<double>          volume, particles, offset, raw, damage, kappa_d, kappa_p, returned;
      std::vector<Eigen::Matrix3d> stress, tensor;
      for (const coupling::MappedPoint &p : report.points)
        {
          cloud.place.push_back(p.place);
          volume.push_back(p.volume);
          particles.push_back(static_cast<double>(p.average.particles));
          offset.push_back(p.average.offset);
          raw.push_back(p.mapped.raw);
          damage.push_back(p.mapped.damage);
          kappa_d.push_back(p.kappa_d);
          kappa_p.push_back(p.kappa_p);
          returned.push_back(p.returned);
          stress.push_back(p.average.stress);
          tensor.push_back(p.average.damage);
        }
      cloud.scalars = {{"volume", volume},   {"particles", particles},     {"offset", offset},
                       {"raw_damage", raw},  {"damage", damage},           {"kappa_D", kappa_d},
                       {"kappa_P", kappa_p}, {"returned_stress", returned}};
      cloud.tensors = {{"stress", stress}, {"damage_tensor", tensor}};
      return cloud;
    }

    double mean_size(const coupling::TransferReport &report)
    {
      double sum = 0;
      for (const coupling::MappedPoint &p : report.points)
        sum += p.size;
      return report.points.empty() ? 0 : sum / static_cast<double>(report.points.size());
    }
  } // namespace

  double CutComparison::force_error() const { return worst(*this, &coupling::SectionForce::force); }
  double CutComparison::moment_error() const { return worst(*this, &coupling::SectionForce::moment); }

  CutComparison compare_cuts(const coupling::ParticleField &field, const coupling::TransferReport &report)
  {
    if (report.points.empty())
      return {};
    Eigen::Vector3d              low = report.points.front().place, high = low;
    std::vector<Eigen::Vector3d> place;
    std::vector<double>          volume;
    std::vector<Eigen::Matrix3d> stress;
    for (const coupling::MappedPoint &p : report.points)
      {
        low  = low.cwiseMin(p.place);
        high = high.cwiseMax(p.place);
        place.push_back(p.place);
        volume.push_back(p.volume);
        stress.push_back(p.average.stress);
      }
    coupling::Sections sections;
    (high - low).maxCoeff(&sections.axis);
    for (const Eigen::Vector3d &x : field.place)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    sections.low        = low[sections.axis];
    sections.high       = high[sections.axis];
    sections.centre     = 0.5 * (low + high);
    const double layers = (sections.high - sections.low) / std::max(mean_size(report), 1e-300);
    sections.count      = static_cast<int>(std::clamp(std::floor(layers), 1.0, 20.0));
    return {coupling::section_forces(sections, field.place, field.volume, field.stress),
            coupling::section_forces(sections, place, volume, stress)};
  }

  TransferPicture::TransferPicture(const std::filesystem::path &folder)
    : output(folder)
  {
    std::error_code error;
    std::filesystem::create_directories(output / "transfer", error);
    if (error)
      throw postprocess::OutputError((output / "transfer").string() +
                                     ": the folder cannot be made: " + error.message() + ".");
  }

  void TransferPicture::add(const std::size_t                number,
                            const coupling::ParticleField   &field,
                            const coupling::TransferOptions &options,
                            const coupling::TransferReport  &report,
                            const std::string               &mesh_file)
  {
    const auto        time      = static_cast<double>(number);
    const std::string particles = fmt::format("transfer/particles_{:03}.vtp", number),
                      points    = fmt::format("transfer/points_{:03}.vtp", number);
    postprocess::write_vtk_points(output / particles, postprocess::field_file("transferred particles"),
                                  cloud_of(field, options, mean_size(report)), time);
    postprocess::write_vtk_points(output / points, postprocess::field_file("integration points"), cloud_of(report),
                                  time);
    parts.push_back({time, 0, "particles", particles});
    parts.push_back({time, 1, "integration points", points});
    if (!mesh_file.empty())
      parts.push_back({time, 2, "mesh", mesh_file});
    postprocess::write_pvd(output / "transfer.pvd", parts);
  }

  nlohmann::json
  json_of(const coupling::TransferReport &report, const CutComparison &cuts, const coupling::Equilibration &settled)
  {
    const coupling::TransferCount &c         = report.count;
    const auto                     imbalance = [](const coupling::Imbalance &i) {
      return nlohmann::json{{"largest", i.largest}, {"relative", i.relative()}, {"unit", "N"}};
    };
    nlohmann::json json;
    json["points"]         = {{"all", c.points},          {"elastic", c.elastic},
                              {"empty", c.empty},         {"sparse", c.sparse},
                              {"boundary", c.boundary},   {"averaged_instead_of_fitted", c.averaged},
                              {"damaged", c.damaged},     {"fully_damaged", c.fully_damaged},
                              {"at_switch", c.at_switch}, {"returned_to_yield_surface", c.returned}};
    json["largest_return"] = {{"value", report.largest_return}, {"unit", "Pa"}};
    json["volume"]         = {
              {"particles", report.integrals.volume_particles}, {"points", report.integrals.volume_points}, {"unit", "m^3"}};
    json["mean_stress_error"] = report.integrals.stress_error();
    json["mean_damage_error"] = report.integrals.damage_error();
    json["cuts"]              = {
                   {"count", cuts.points.size()}, {"force_error", cuts.force_error()}, {"moment_error", cuts.moment_error()}};
    json["imbalance"]   = {{"before", imbalance(settled.before)}, {"after", imbalance(settled.after)}};
    json["equilibrium"] = {{"iterations", settled.iterations},
                           {"damped_steps", settled.relaxed},
                           {"largest_displacement", {{"value", settled.largest_displacement}, {"unit", "m"}}},
                           {"energy_released", {{"value", settled.released}, {"unit", "J"}}},
                           {"energy_damped", {{"value", settled.damped}, {"unit", "J"}}}};
    return json;
  }

  std::string
  text_of(const coupling::TransferReport &report, const CutComparison &cuts, const coupling::Equilibration &settled)
  {
    const coupling::TransferCount &c = report.count;
    std::string                    text =
      fmt::format("  points       {} with history: {} damaged, {} fully, {} near the switch, {} outside the "
                  "yield surface (by {:.2g} MPa at most)\n",
                  c.points, c.damaged, c.fully_damaged, c.at_switch, c.returned, 1e-6 * report.largest_return);
    text += fmt::format("  averages     {} without particles, {} sparse, {} one-sided, {} not fitted\n", c.empty,
                        c.sparse, c.boundary, c.averaged);
    text += fmt::format(
      "  conserved    mean stress within {:.1e}, mean damage {:.1e}, cut forces {:.1e}, moments {:.1e}\n",
      report.integrals.stress_error(), report.integrals.damage_error(), cuts.force_error(), cuts.moment_error());
    text += fmt::format(
      "  imbalance    {:.2e} of the forces at hand before, {:.2e} after {} iterations{} that moved {:.2e} m\n",
      settled.before.relative(), settled.after.relative(), settled.iterations,
      settled.relaxed > 0 ? fmt::format(" in {} damped steps", settled.relaxed) : "", settled.largest_displacement);
    return text;
  }
} // namespace apps

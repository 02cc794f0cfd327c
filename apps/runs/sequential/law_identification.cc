#include "apps/runs/sequential/law_identification.h"

#include "apps/figures/link_failure.h"
#include "apps/figures/summary_head.h"
#include "apps/results/warning.h"
#include "apps/runs/sequential/model.h"
#include "apps/runs/sequential/particles.h"
#include "coupling/sequential/strained_specimen.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/summary.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace apps
{
  namespace
  {
    constexpr double poor_fit = 0.1; ///< of damage, root mean square

    const fem::MaterialConstants &material_of(const SequentialModel &model)
    {
      return *model.receivers().front()->chosen().constants;
    }

    IdentifiedLaw law_in(const std::filesystem::path &file)
    {
      std::ifstream        stream(file);
      const nlohmann::json json = nlohmann::json::parse(stream);
      const auto          &law  = json.at("law");
      IdentifiedLaw        read;
      read.found.law.weights         = law.at("weights");
      read.found.law.factor          = law.at("factor");
      read.found.law.exponent        = law.at("exponent");
      read.found.law.switch_damage   = law.at("switch_damage");
      read.found.law.hardening_start = law.at("hardening_start");
      read.found.law.hardening_slope = law.at("hardening_slope");
      read.found.damaged             = json.at("states_after_peak");
      read.found.undamaged           = json.at("states_before_peak");
      read.found.damage_error        = json.at("damage_error");
      read.found.hardening_error     = json.at("hardening_error");
      read.particle_peak             = json.at("particle_peak").at("value");
      read.continuum_peak            = json.at("continuum_peak").at("value");
      read.origin                    = *LawOrigin::read(json.at("identified_for").get<std::string>());
      return read;
    }

    /** Wanted and mapped damage over the particles' relative stress, with the published and with the identified law. */
    std::string draw_identification(const std::filesystem::path &file, const coupling::SpecimenIdentification &of_test)
    {
      using Style                                                          = postprocess::PlotSeries::Style;
      const std::vector<std::pair<std::string, coupling::MappingLaw>> laws = {{"published law", {}},
                                                                              {"identified law", of_test.found.law}};
      postprocess::PlotPanel                                          panel;
      postprocess::PlotSeries                                         wanted;
      wanted.name   = "continuum at the same stress";
      wanted.style  = Style::line;
      panel.title   = "Damage after the peak";
      panel.x_label = "Stress of the particles over their peak";
      panel.y_label = "Damage of the continuum";
      for (const auto &o : of_test.observations)
        if (o.after_peak)
          {
            wanted.x.push_back(o.relative_stress);
            wanted.y.push_back(of_test.reference.damage_at(o.relative_stress));
          }
      panel.series.push_back(wanted);
      for (const auto &[name, law] : laws)
        {
          postprocess::PlotSeries mapped;
          mapped.name  = name;
          mapped.style = Style::points;
          for (const auto &o : of_test.observations)
            if (o.after_peak)
              {
                mapped.x.push_back(o.relative_stress);
                mapped.y.push_back(coupling::map_damage(o.damage_tensor, law).damage);
              }
          panel.series.push_back(mapped);
        }
      return postprocess::plot(file, {panel});
    }
  } // namespace

  bool IdentificationSection::compresses(const ParticleEventSection &particles) const
  {
    return direction == Direction::own ? particles.compresses() : direction == Direction::compression;
  }

  nlohmann::json IdentifiedLaw::json() const
  {
    const coupling::MappingLaw &law = found.law;
    return {{"law",
             {{"weights", law.weights},
              {"factor", law.factor},
              {"exponent", law.exponent},
              {"switch_damage", law.switch_damage},
              {"hardening_start", law.hardening_start},
              {"hardening_slope", law.hardening_slope}}},
            {"identified_for", origin.text()},
            {"states_after_peak", found.damaged},
            {"states_before_peak", found.undamaged},
            {"damage_error", found.damage_error},
            {"hardening_error", found.hardening_error},
            {"particle_peak", quantity(particle_peak, "Pa")},
            {"continuum_peak", quantity(continuum_peak, "Pa")}};
  }

  std::string IdentifiedLaw::prm() const
  {
    const coupling::MappingLaw &law = found.law;
    return fmt::format(
      "subsection Transfer\n  subsection Mapping law\n    set Law             = own\n"
      "    set Weights         = {}, {}, {}\n    set Factor          = {}\n    set Exponent        = {}\n"
      "    set Switch damage   = {}\n    set Hardening start = {}\n    set Hardening slope = {}\n"
      "    set Identified for  = {}\n  end\nend\n",
      law.weights[0], law.weights[1], law.weights[2], law.factor, law.exponent, law.switch_damage, law.hardening_start,
      law.hardening_slope, origin.text());
  }

  std::string IdentifiedLaw::text() const
  {
    std::string text = fmt::format(
      "mapping law  identified in {}: damage within {:.4f} (root mean square, {} states after the peak), kappa_P "
      "within {:.3f} ({} before)\n             strength of the particles {:.4g} MPa, of the continuum {:.4g} MPa\n",
      origin.test, found.damage_error, found.damaged, found.hardening_error, found.undamaged, 1e-6 * particle_peak,
      1e-6 * continuum_peak);
    if (found.damage_error > poor_fit)
      text += fmt::format("warning      the identified law gives damage within {:.2f} only: see identified.png\n",
                          found.damage_error);
    return text;
  }

  /** The particles' own specimen between grips, as a case that can be interrupted and resumed. */
  class LawIdentification::Test : public ParticleCase
  {
  public:
    Test(const SequentialModel &model_, const dem::Packing &packing, const double smoothed_size)
      : model(model_)
      , strained(packing,
                 without_impactor(model_.particles.specimen_parameters()),
                 model_.particles.mixed().materials(packing.material_names),
                 parameters(model_),
                 {model_.transfer.field, model_.transfer.options.averaging, smoothed_size})
    {
    }

    const dem::Specimen *body() const override { return &strained.body(); }
    StaticStart          settle() override { return start_statically(strained.body(), model.particles.gravity); }
    bool                 finished() const override { return strained.finished(); }
    double               done() const override { return strained.done(); }
    void                 visit_state(base::StateVisitor &visitor) override { strained.visit_state(visitor); }

    void advance() override
    {
      if (strained.body().steps() == 0)
        settle();
      strained.advance();
    }

    ParticleOutcome outcome() const override
    {
      ParticleOutcome result;
      result.name = "identification";
      return result;
    }

    static dem::UniaxialParameters parameters(const SequentialModel &model)
    {
      const IdentificationSection &requested = model.identification;
      dem::UniaxialParameters      p =
        uniaxial_parameters(model.particles, requested.compresses(model.particles) ? -requested.furthest_strain :
                                                                                     requested.furthest_strain);
      p.stop_fraction = requested.stop_fraction;
      p.stop_strain   = requested.furthest_strain;
      return p;
    }

    const std::vector<coupling::StrainedSpecimen::Sample> &samples() const { return strained.samples(); }

  private:
    static dem::SpecimenParameters without_impactor(dem::SpecimenParameters p)
    {
      p.loose = 0;
      return p;
    }

    const SequentialModel     &model;
    coupling::StrainedSpecimen strained;
  };

  LawIdentification::LawIdentification(const SequentialModel &what, const LawOrigin &origin, const double size)
    : model(what)
    , element_size(size)
  {
    law.origin      = origin;
    law.origin.test = model.identification.compresses(model.particles) ? "compression" : "tension";
  }

  double LawIdentification::smoothed_size() const
  {
    return std::max(element_size, material_of(model).averaging_length());
  }

  double LawIdentification::expected_seconds(const dem::Packing &packing) const
  {
    Test                          test(model, packing, smoothed_size());
    const dem::UniaxialParameters given = Test::parameters(model);
    const double                  end   = strain_of_failure(
                         *model.particles.mixed().materials(packing.material_names).bonds_in_space(model.particles.physics), packing,
                         given);
    return apps::expected_seconds(test, std::min(1.0, end / given.stop_strain));
  }

  bool LawIdentification::complete(const dem::Packing          &packing,
                                   const std::filesystem::path &folder,
                                   const std::string           &deciding_text)
  {
    const auto states = folder / "states", file = states / "identification.json";
    if (std::filesystem::exists(file))
      {
        law = law_in(file);
        return true;
      }
    Test test(model, packing, smoothed_size());
    if (!run_particles(test, "identification", states, deciding_text))
      return false;
    fit(test, folder);
    postprocess::write_text(folder / "mapping_law.prm", law.prm());
    postprocess::write_json(file, law.json()); // last: what it says is then complete
    return true;
  }

  void LawIdentification::fit(const Test &test, const std::filesystem::path &folder)
  {
    const coupling::SpecimenIdentification of_test =
      coupling::identify(test.samples(), material_of(model), element_size, law.origin.test == "compression");
    law.found          = of_test.found;
    law.particle_peak  = of_test.particle_peak;
    law.continuum_peak = of_test.reference.peak();
    warn_of_missing("identified.png", draw_identification(folder / "identified.png", of_test));
  }
} // namespace apps

#include "apps/drivers/link_path.h"

#include "apps/scene/law_block.h"
#include "dem/laws/cpm.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** Columns of a link history, filled row by row in the order in which they were first named. */
    class Recorder
    {
    public:
      void operator()(const char *name, const char *unit, const double value)
      {
        if (next == history.columns.size())
          history.columns.push_back({name, unit, {}});
        history.columns[next++].values.push_back(value);
      }
      void end_row() { next = 0; }

      LinkHistory history;

    private:
      std::size_t next = 0;
    };

    /**
     * One link of the cohesive particle model, in its reference configuration: given total strains in, stresses out.
     */
    class CpmLink
    {
    public:
      explicit CpmLink(const dem::CpmParameters &parameters)
        : constants(parameters)
      {
      }

      void advance(const double normal_strain, const std::array<double, 2> &shear_strain)
      {
        normal = normal_strain;
        for (int i = 0; i < 2; ++i)
          {
            state.elastic_shear[i] += shear_strain[i] - shear[i];
            shear[i] = shear_strain[i];
          }
        if (!broken)
          respond();
      }

      void record(Recorder &row) const
      {
        row("normal_strain", "-", normal);
        row("shear_strain_1", "-", shear[0]);
        row("shear_strain_2", "-", shear[1]);
        row("normal_stress", "Pa", response.normal_stress);
        row("shear_stress_1", "Pa", response.shear_stress[0]);
        row("shear_stress_2", "Pa", response.shear_stress[1]);
        row("kappa", "-", state.kappa);
        row("damage", "-", state.damage);
        row("strength_damage", "-", broken ? 1.0 : constants.strength_damage(state.kappa, state.damage));
        row("plastic_shear_strain_1", "-", shear[0] - state.elastic_shear[0]);
        row("plastic_shear_strain_2", "-", shear[1] - state.elastic_shear[1]);
        row("broken", "", broken ? 1.0 : 0.0);
        row("elastic_energy", "J/m^3", elastic_energy());
        row("dissipated_by_damage", "J/m^3", dissipated_by_damage());
        row("dissipated_by_sliding", "J/m^3", sliding_work);
        row.end_row();
      }

    private:
      void respond()
      {
        const dem::Vec<double, 2> total{{shear[0], shear[1]}};
        response = dem::Cpm<true, true>::update(constants, normal, dem::dot(total, total), state);
        sliding_work += response.plastic_work;
        damage_work += response.damage_work;
        if (normal > 0 && state.kappa > constants.kappa_broken)
          delete_link();
      }

      /** What the particle model does with a link that has no strength left (mesoscale specification 3.5). */
      void delete_link()
      {
        broken              = true;
        state.elastic_shear = {{0, 0}};
        response            = {};
      }

      double elastic_energy() const
      {
        const double closed = normal > 0 ? 1 - state.damage : 1;
        return broken ? 0.0 :
                        0.5 * (closed * constants.E * normal * normal +
                               constants.G * dem::dot(state.elastic_shear, state.elastic_shear));
      }

      double dissipated_by_damage() const
      {
        return constants.shear_weight > 0 ? damage_work : constants.dissipated_at(state.kappa, state.damage);
      }

      dem::CpmConstants           constants;
      dem::CpmState<double, 2>    state{0, 0, {{0, 0}}};
      dem::CpmResponse<double, 2> response     = {};
      double                      normal       = 0;
      std::array<double, 2>       shear        = {};
      bool                        broken       = false;
      double                      sliding_work = 0, damage_work = 0;
    };

    LinkHistory drive_cpm(Section &section, const std::function<void()> &read, const LinkPath &path)
    {
      dem::CpmParameters parameters;
      declare_law<dem::CpmDescription>(section, parameters);
      read();
      CpmLink  link(parameters);
      Recorder recorder;
      for (std::size_t row = 0; row < path.normal.size(); ++row)
        {
          link.advance(path.normal[row], path.shear[row]);
          link.record(recorder);
        }
      return std::move(recorder.history);
    }
  } // namespace

  std::string LinkHistory::as_csv() const
  {
    std::string text;
    for (const Column &column : columns)
      text += (text.empty() ? "" : ",") + column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
    text += '\n';
    for (std::size_t row = 0; !columns.empty() && row < columns.front().values.size(); ++row)
      for (std::size_t i = 0; i < columns.size(); ++i)
        text += fmt::format("{}{}", columns[i].values[row], i + 1 < columns.size() ? "," : "\n");
    return text;
  }

  const std::vector<DrivenLaw> &driven_laws()
  {
    static const std::vector<DrivenLaw> laws = {
      {dem::CpmDescription::name, drive_cpm},
    };
    return laws;
  }
} // namespace apps

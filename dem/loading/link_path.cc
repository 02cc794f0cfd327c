#include "dem/loading/link_path.h"

#include "dem/loading/link_recorder.h"

#include <string>
#include <utility>

namespace dem
{
  namespace
  {
    /**
     * One link of any law, in its reference configuration: total strains in, stresses out. It is a link of unit length and unit
     * section, so that forces are stresses and energies are per volume.
     */
    class DrivenLink
    {
    public:
      DrivenLink(std::shared_ptr<const LinkLaw> of, const double per_second)
        : law(std::move(of))
        , columns(law->columns())
        , history(columns.size(), 0.0)
      {
        NewLink fresh;
        fresh.distance     = 1;
        fresh.first_radius = fresh.second_radius = 0.5;
        fresh.area                               = 1;
        law->begin(0, fresh, history.data());
        step.geometry.area = step.geometry.reference = 1;
        step.direction                               = {1, 0, 0};
        step.per_second                              = per_second;
      }

      void advance(const double normal_strain, const std::array<double, 2> &shear_strain)
      {
        step.strain_before   = step.geometry.strain;
        step.geometry.strain = normal_strain;
        step.geometry.length = 1 + normal_strain;
        step.shear_increment = {0, shear_strain[0] - shear[0], shear_strain[1] - shear[1]};
        shear                = shear_strain;
        if (gone)
          return;
        const std::vector<double> before = history;
        answer                           = law->update(0, step, before.data(), history.data());
        friction += answer.friction;
        viscous += answer.viscous;
        damage += answer.damage + answer.released;
        if (law->phase(0, step.geometry, history.data()) == LinkPhase::gone)
          delete_link();
      }

      void record(LinkRecorder &row) const
      {
        const LinkLoss lost = law->damage(0, step.geometry, history.data());
        row("normal_strain", "-", step.geometry.strain);
        row("shear_strain_1", "-", shear[0]);
        row("shear_strain_2", "-", shear[1]);
        row("normal_stress", "Pa", answer.force[0]);
        row("shear_stress_1", "Pa", answer.force[1]);
        row("shear_stress_2", "Pa", answer.force[2]);
        record_history(row);
        row("strength_damage", "-", gone ? 1.0 : lost.strength);
        const bool broken = gone || law->phase(0, step.geometry, history.data()) != LinkPhase::whole;
        row("broken", "", broken ? 1.0 : 0.0);
        row("elastic_energy", "J/m^3", gone ? 0.0 : law->stored(0, step.geometry, history.data()));
        row("dissipated_by_damage", "J/m^3", damage + law->damage_dissipation(0, step.geometry, history.data()));
        row("dissipated_by_sliding", "J/m^3", friction);
        if (law->viscous())
          row("dissipated_by_rate", "J/m^3", viscous);
        row.end_row();
      }

    private:
      /** Vectors by their components across the link; of elastic shear the plastic part, too. */
      void record_history(LinkRecorder &row) const
      {
        const auto ends_with = [](const std::string &text, const std::string &end) {
          return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
        };
        for (std::size_t c = 0; c < columns.size(); ++c)
          if (!ends_with(columns[c].name, "_0") &&
              columns[c].name != "broken") // no part along the link; reported for every law
            {
              row(columns[c].name, columns[c].unit, history[c]);
              if (columns[c].name == "elastic_shear_1" || columns[c].name == "elastic_shear_2")
                {
                  const std::size_t across = columns[c].name.back() == '1' ? 0 : 1;
                  row("plastic_shear_strain_" + std::to_string(across + 1), "-", shear[across] - history[c]);
                }
            }
      }

      /** What the particle model does with a link that has no strength left (doc/theory/link-laws.md). */
      void delete_link()
      {
        gone   = true;
        answer = {};
        for (std::size_t c = 0; c < columns.size(); ++c)
          if (columns[c].name.compare(0, 13, "elastic_shear") == 0)
            history[c] = 0;
      }

      std::shared_ptr<const LinkLaw> law;
      std::vector<LinkQuantity>      columns;
      std::vector<double>            history;
      LinkStep                       step;
      LinkAnswer                     answer;
      std::array<double, 2>          shear    = {};
      bool                           gone     = false;
      double                         friction = 0, damage = 0, viscous = 0;
    };

  } // namespace

  LinkHistory
  drive(const LinkLawKind &law, const LinkConstants &constants, const LinkPath &path, const double per_second)
  {
    DrivenLink   link(law.materials({{"", &constants, 0}}).bonds_in_space(Physics()), per_second);
    LinkRecorder recorder;
    for (std::size_t row = 0; row < path.normal.size(); ++row)
      {
        link.advance(path.normal[row], path.shear[row]);
        link.record(recorder);
      }
    return std::move(recorder.history);
  }
} // namespace dem

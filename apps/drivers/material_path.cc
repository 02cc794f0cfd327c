#include "apps/drivers/material_path.h"

#include "apps/scene/continuum_law_block.h"
#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/materials/mixed_control.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    constexpr int finest = 1024; // parts of a row

    template <typename Law>
    struct Point
    {
      fem::Voigt          strain = fem::Voigt::Zero(), stress = fem::Voigt::Zero();
      typename Law::State state;
      int                 substeps = 1;
    };

    /** One row in equal parts; false if a part finds no equilibrium. */
    template <typename Law>
    bool advance(
      const Law &law, const MaterialPath &path, const std::array<double, 6> &row, const int parts, Point<Law> &point)
    {
      const Point<Law> start = point;
      const double     unit =
        law.elastic_stiffness().cwiseAbs().maxCoeff() * 1e-6; // the stress of a strain of 1e-6 is exact to 1e-12
      for (int part = 1; part <= parts; ++part)
        {
          fem::MixedTarget target;
          target.stress_given = path.stress_given;
          for (int i = 0; i < 6; ++i)
            {
              const double from = path.stress_given[i] ? start.stress[i] : start.strain[i];
              target.value[i]   = from + (row[i] - from) * part / parts;
            }
          try
            {
              const auto reached = fem::solve_mixed(law, point.strain, target, point.state, fem::ElementExtent{}, unit);
              point = {reached.strain, reached.response.stress, reached.response.trial, reached.response.substeps};
            }
          catch (const fem::MaterialFailure &)
            {
              point = start;
              return false;
            }
        }
      point.substeps *= parts;
      return true;
    }

    template <typename Law>
    void record(MaterialHistory &history, const Point<Law> &point)
    {
      std::vector<std::string> names;
      std::vector<double>      row;
      for (int i = 0; i < 6; ++i)
        {
          names.push_back(std::string("strain_") + fem::voigt_names[i] + " [-]");
          row.push_back(point.strain[i]);
        }
      for (int i = 0; i < 6; ++i)
        {
          names.push_back(std::string("stress_") + fem::voigt_names[i] + " [Pa]");
          row.push_back(point.stress[i]);
        }
      typename Law::State state = point.state;
      Law::describe_state(state, [&](const std::string &column, const double *values, const int count) {
        if (column.compare(0, 4, "old ") == 0)
          return; // strain and stress, above
        std::string name = column.substr(0, column.find(" ["));
        for (char &c : name)
          c = c == ' ' ? '_' : c;
        const std::string unit = column.find(" [") == std::string::npos ? " [-]" : column.substr(column.find(" ["));
        for (int i = 0; i < count; ++i)
          {
            names.push_back((count == 6 ? name + "_" + fem::voigt_names[i] : name) + unit);
            row.push_back(values[i]);
          }
      });
      names.push_back("parts");
      row.push_back(point.substeps);
      history.names = names;
      history.rows.push_back(row);
    }

    template <typename Law>
    MaterialHistory drive(Section &section, const std::function<void()> &read, const MaterialPath &path)
    {
      typename Law::Parameters parameters;
      declare_continuum_law<Law>(section, parameters);
      read();
      try
        {
          const Law       law(parameters);
          Point<Law>      point;
          MaterialHistory history;
          for (std::size_t row = 0; row < path.rows.size(); ++row)
            {
              int parts = 1;
              while (!advance(law, path, path.rows[row], parts, point))
                if ((parts *= 2) > finest)
                  throw dem::InputError(
                    fmt::format("{}: row {}: no equilibrium with these stresses, not even in {} parts. Beyond a "
                                "peak a component must be given in strain.",
                                path.origin, row + 1, finest));
              record(history, point);
            }
          return history;
        }
      catch (const std::invalid_argument &refusal)
        {
          throw dem::InputError(std::string("material: ") + refusal.what());
        }
    }
  } // namespace

  std::string MaterialHistory::as_csv() const
  {
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (const auto &row : rows)
      text += fmt::format("{}\n", fmt::join(row, ","));
    return text;
  }

  const std::vector<DrivenMaterial> &driven_materials()
  {
    static const std::vector<DrivenMaterial> materials = {
      {fem::IsotropicElastic::name, drive<fem::IsotropicElastic>},
      {fem::AnisotropicElastic::name, drive<fem::AnisotropicElastic>},
      {fem::DamagePlasticConcrete::name, drive<fem::DamagePlasticConcrete>},
    };
    return materials;
  }
} // namespace apps

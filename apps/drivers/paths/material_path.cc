#include "apps/drivers/paths/material_path.h"

#include "apps/scene/continuum_law_block.h"
#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/materials/mixed_control.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    template <typename Law>
    struct Point
    {
      fem::Voigt          strain = fem::Voigt::Zero(), stress = fem::Voigt::Zero();
      typename Law::State state;
      int                 parts = 1;
    };

    template <typename Parameters>
    fem::Increments increments_of(const Parameters &)
    {
      return fem::Increments::followed;
    }

    fem::Increments increments_of(const fem::DamagePlasticParameters &parameters)
    {
      return parameters.largest_increment > 0 ? fem::Increments::followed : fem::Increments::whole;
    }

    /** Goes to a row: where the path there can be followed. */
    template <typename Law>
    void advance(const Law                   &law,
                 const fem::Increments        increments,
                 const MaterialPath          &path,
                 const std::array<double, 6> &row,
                 Point<Law>                  &point)
    {
      fem::MixedTarget target;
      target.stress_given = path.stress_given;
      for (int i = 0; i < 6; ++i)
        target.value[i] = row[i];
      // The stress of a strain of 1e-6 is exact to 1e-12.
      const double unit    = law.elastic_stiffness().cwiseAbs().maxCoeff() * 1e-6;
      const auto   reached = fem::solve_mixed(law, target, point.state, fem::ElementExtent{}, unit, increments);
      point.strain         = reached.strain;
      point.stress         = reached.response.stress;
      point.state          = reached.response.trial;
      point.parts          = reached.parts * reached.response.substeps;
    }

    std::string advice(const MaterialPath &path)
    {
      const bool stresses =
        std::any_of(path.stress_given.begin(), path.stress_given.end(), [](const bool given) { return given; });
      return stresses ? "Beyond a peak a component must be given in strain; a way that snaps back cannot be followed." :
                        "All components are given in strain: take shorter rows, and see that the numbers are strains.";
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
      row.push_back(point.parts);
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
              try
                {
                  advance(law, increments_of(parameters), path, path.rows[row], point);
                }
              catch (const fem::MaterialFailure &failure)
                {
                  throw dem::InputError(
                    fmt::format("{}: row {}: {} {}", path.origin, row + 1, failure.what(), advice(path)));
                }
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

#include "fem/points/material_path.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "fem/points/driven_point.h"

#include <algorithm>
#include <cmath>

namespace fem
{
  namespace
  {
    constexpr double largest_strain = 1e3; ///< of a point: past anything that has a meaning

    std::string advice(const MaterialPath &path)
    {
      const bool stresses =
        std::any_of(path.stress_given.begin(), path.stress_given.end(), [](const bool given) { return given; });
      return stresses ? "Beyond a peak a component must be given in strain; a way that snaps back cannot be followed." :
                        "All components are given in strain: take shorter rows, and see that the numbers are strains.";
    }

    std::string place_of(const MaterialPath &path, const std::size_t row)
    {
      return path.origin + ": row " + std::to_string(row + 1) + ": ";
    }

    void record(MaterialHistory &history, DrivenPoint &point)
    {
      std::vector<std::string> names, units;
      std::vector<double>      row;
      const auto               six = [&](const std::string &name, const char *unit, const double *values) {
        for (int i = 0; i < 6; ++i)
          {
            names.push_back(name + "_" + base::voigt_names[i]);
            units.emplace_back(unit);
            row.push_back(values[i]);
          }
      };
      six("strain", "-", point.strain().data());
      six("stress", "Pa", point.stress().data());
      point.visit([&](const PointQuantity &of, const double *values) {
        if (of.shown == PointQuantity::Shown::nowhere)
          return;
        if (of.kind != PointQuantity::Kind::number)
          return six(of.name, of.unit, values);
        names.emplace_back(of.name);
        units.emplace_back(of.unit);
        row.push_back(*values);
      });
      names.emplace_back("parts");
      units.emplace_back();
      row.push_back(point.parts());
      history.names = names;
      history.units = units;
      history.rows.push_back(row);
    }

    /** Goes to a row: where the path there can be followed. */
    void advance(DrivenPoint &point, const MaterialPath &path, const std::size_t row)
    {
      MixedTarget target;
      target.stress_given = path.stress_given;
      for (int i = 0; i < 6; ++i)
        target.value[i] = path.rows[row][static_cast<std::size_t>(i)];
      // The stress of a strain of 1e-6 is exact to 1e-12.
      const double unit = point.elastic_stiffness().cwiseAbs().maxCoeff() * 1e-6;
      try
        {
          point.go_to(target, ElementExtent{}, unit, point.increments());
        }
      catch (const MaterialFailure &failure)
        {
          throw base::InputError(place_of(path, row) + failure.what() + " " + advice(path));
        }
      // A negated comparison: not a number is refused as well. The stress of any strain within is a number.
      for (const double strain : point.strain())
        if (!(std::fabs(strain) <= largest_strain))
          throw base::InputError(place_of(path, row) + "a strain of " + base::number_text(strain) + ": must be from " +
                                 base::number_text(-largest_strain) + " to " + base::number_text(largest_strain) + ".");
    }
  } // namespace

  MaterialHistory drive(const MaterialConstants &constants, const MaterialPath &path)
  {
    try
      {
        const auto      point = constants.make_point();
        MaterialHistory history;
        for (std::size_t row = 0; row < path.rows.size(); ++row)
          {
            advance(*point, path, row);
            record(history, *point);
          }
        return history;
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(std::string("material: ") + refusal.what());
      }
  }
} // namespace fem

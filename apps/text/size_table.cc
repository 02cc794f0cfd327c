#include "apps/text/size_table.h"

#include "apps/text/same_name.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "base/length_unit.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace apps
{
  namespace
  {
    /** Smallest and largest diameter of "1e-3" or "1e-3-2e-3"; a minus within a number stands behind its e. */
    bool read_diameters(const std::string &text, dem::SizeClass &to)
    {
      for (std::size_t at = 1; at < text.size(); ++at)
        if (text[at] == '-' && text[at - 1] != 'e' && text[at - 1] != 'E')
          {
            const auto low = number_in(text.substr(0, at)), high = number_in(text.substr(at + 1));
            to.smallest = low.value_or(0);
            to.largest  = high.value_or(0);
            return low && high;
          }
      const auto only = number_in(text);
      to.smallest = to.largest = only.value_or(0);
      return only.has_value();
    }
  } // namespace

  std::vector<dem::SizeClass> size_classes_in_text(const std::string &text)
  {
    std::vector<dem::SizeClass> classes;
    for (const std::string &part : comma_separated(text))
      {
        const std::size_t colon = part.find(':');
        dem::SizeClass    one;
        const auto        fraction = number_in(trimmed(part.substr(std::min(colon, part.size() - 1) + 1)));
        if (colon == std::string::npos || !fraction || !read_diameters(trimmed(part.substr(0, colon)), one))
          throw base::InputError("\"" + part + "\": expected diameter: fraction, or smallest-largest: fraction.");
        one.fraction = *fraction;
        classes.push_back(one);
      }
    return classes;
  }

  namespace
  {
    constexpr double rounding             = 1e-6; ///< of parts that laboratories print
    constexpr double largest_without_unit = 0.5;  ///< [m]: coarser grains than boulders are millimetres

    /** Place of a column, capital letters or not; nothing: there is none. */
    std::optional<std::size_t> place_of(const postprocess::CsvTable &table, const std::string &name)
    {
      const auto found = std::find_if(table.names.begin(), table.names.end(),
                                      [&](const std::string &one) { return same_name(one, name); });
      if (found == table.names.end())
        return std::nullopt;
      return static_cast<std::size_t>(found - table.names.begin());
    }

    /** As laboratories write it: "sieve" for the size of its openings, and a unit as a part of the name, "size_mm". */
    postprocess::CsvTable read_size_table(const std::string &file)
    {
      postprocess::CsvTable table = postprocess::read_csv_table(file);
      for (std::size_t c = 0; c < table.names.size(); ++c)
        {
          std::string      &name = table.names[c];
          const std::size_t line = name.rfind('_');
          if (line != std::string::npos && table.units[c].empty() && base::length_unit(name.substr(line + 1)))
            {
              table.units[c] = name.substr(line + 1);
              name.erase(line);
            }
          if (same_name(name, "sieve"))
            name = "size";
        }
      return table;
    }

    std::size_t required_place(const postprocess::CsvTable &table, const std::string &name)
    {
      if (const auto place = place_of(table, name))
        return *place;
      table.column(name); // says which there are
      throw std::logic_error("a column that is there and is not");
    }

    /** A column of lengths in metres. */
    std::vector<double> lengths_of(const postprocess::CsvTable &table, const std::string &name)
    {
      const std::size_t                     place  = required_place(table, name);
      std::vector<double>                   values = table.columns[place];
      const std::string                    &named  = table.units[place];
      const std::optional<base::LengthUnit> unit   = base::length_unit(named.empty() ? "m" : named);
      if (!unit)
        throw base::InputError(table.origin + ": column " + name + " is in [" + named + "]: expected one of " +
                               base::length_unit_names() + ".");
      for (double &value : values)
        value = unit->metres(value);
      const double largest = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
      if (named.empty() && largest > largest_without_unit)
        throw base::InputError(
          fmt::format("{}: column {}: a particle of {} m. In mm? Name the unit: {} [mm], or {} [m].", table.origin,
                      name, largest, name, name));
      return values;
    }

    /** A column of parts of a whole: of 1, of 100 percent, or of all that was weighed. */
    std::vector<double> parts_of(const postprocess::CsvTable &table, const std::string &name, const double whole)
    {
      const std::size_t   place  = required_place(table, name);
      std::vector<double> values = table.columns[place];
      const std::string  &unit   = table.units[place];
      const bool          mass   = unit == "g" || unit == "kg";
      if (!unit.empty() && unit != "%" && unit != "-" && !mass)
        throw base::InputError(table.origin + ": column " + name + " is in [" + unit +
                               "]: expected parts of 1, percent [%], or masses [g] or [kg].");
      const bool percent = unit == "%" || (unit.empty() && std::abs(whole - 100) < 100 * rounding);
      for (double &value : values)
        value /= mass ? whole : percent ? 100 : 1;
      return values;
    }

    struct Sieve
    {
      double      size = 0; ///< of its openings [m]
      double      part = 0; ///< of the solid: passing, or retained
      std::size_t row  = 0; ///< of the table, from 1
    };

    /** In ascending order of sizes, whatever that of the table. */
    std::vector<Sieve>
    sieves_in(const postprocess::CsvTable &table, const std::vector<double> &size, const std::vector<double> &part)
    {
      std::vector<Sieve> sieves;
      for (std::size_t i = 0; i < size.size(); ++i)
        sieves.push_back({size[i], part[i], i + 1});
      std::stable_sort(sieves.begin(), sieves.end(), [](const Sieve &a, const Sieve &b) { return a.size < b.size; });
      if (sieves.size() < 2)
        throw base::InputError(table.origin + ": a sieve curve has two sieves at least.");
      for (std::size_t i = 0; i < sieves.size(); ++i)
        {
          const std::string row = table.origin + ": row " + std::to_string(sieves[i].row) + ": ";
          if (i > 0 && sieves[i].size == sieves[i - 1].size)
            throw base::InputError(row + "the same size as row " + std::to_string(sieves[i - 1].row) + ".");
          if (!(sieves[i].part >= 0))
            throw base::InputError(fmt::format("{}{}: a part of the solid is not below 0.", row, sieves[i].part));
        }
      return sieves;
    }

    [[noreturn]] void refuse_fines(const postprocess::CsvTable &table, const double part, const double size)
    {
      throw base::InputError(
        fmt::format("{}: {:g} of the solid is finer than the smallest sieve of {:g} m, and nothing "
                    "says how fine. Add the size that nothing passes, or leave it out of the curve.",
                    table.origin, part, size));
    }

    /** Of each two sieves: what passes the coarser and not the finer. */
    std::vector<dem::SizeClass> by_passing(const postprocess::CsvTable &table)
    {
      const std::vector<double> &given = table.columns[required_place(table, "passing")];
      const double               whole = given.empty() ? 0.0 : *std::max_element(given.begin(), given.end());
      const auto sieves                = sieves_in(table, lengths_of(table, "size"), parts_of(table, "passing", whole));
      if (sieves.front().part > rounding)
        refuse_fines(table, sieves.front().part, sieves.front().size);
      if (!(std::abs(sieves.back().part - 1) <= rounding))
        throw base::InputError(
          fmt::format("{}: column passing: {:g} passes the largest sieve; it must be 1 (or 100 %).", table.origin,
                      sieves.back().part));
      std::vector<dem::SizeClass> classes;
      for (std::size_t i = 1; i < sieves.size(); ++i)
        {
          if (!(sieves[i].part >= sieves[i - 1].part))
            throw base::InputError(fmt::format("{}: row {}: less passes than the finer sieve of row {}.", table.origin,
                                               sieves[i].row, sieves[i - 1].row));
          if (sieves[i].part > sieves[i - 1].part)
            classes.push_back({sieves[i].part - sieves[i - 1].part, sieves[i - 1].size, sieves[i].size});
        }
      return classes;
    }

    /** Of each sieve what lies on it, having passed the next coarser. */
    std::vector<dem::SizeClass> by_retained(const postprocess::CsvTable &table)
    {
      const std::vector<double> &given = table.columns[required_place(table, "retained")];
      const double               whole = std::accumulate(given.begin(), given.end(), 0.0);
      const auto sieves = sieves_in(table, lengths_of(table, "size"), parts_of(table, "retained", whole));
      if (sieves.front().size == 0 && sieves.front().part > rounding) // the pan below all sieves
        refuse_fines(table, sieves.front().part, sieves[1].size);
      if (sieves.back().part > rounding)
        throw base::InputError(
          fmt::format("{}: row {}: {:g} of the solid lies on the largest sieve, and nothing says how "
                      "coarse it is. Add the size that all passes, with 0 retained.",
                      table.origin, sieves.back().row, sieves.back().part));
      std::vector<dem::SizeClass> classes;
      for (std::size_t i = 0; i + 1 < sieves.size(); ++i)
        if (sieves[i].part > 0)
          classes.push_back({sieves[i].part, sieves[i].size, sieves[i + 1].size});
      const double sum =
        std::accumulate(classes.begin(), classes.end(), 0.0,
                        [](const double all, const dem::SizeClass &one) { return all + one.fraction; });
      if (!(std::abs(sum - 1) <= rounding))
        throw base::InputError(
          fmt::format("{}: column retained sums up to {:g}; what lies on each sieve by itself must be "
                      "1 (or 100 %) together.",
                      table.origin, sum));
      return classes;
    }
  } // namespace

  std::vector<dem::SizeClass> size_classes_in_file(const std::string &file)
  {
    const postprocess::CsvTable table = read_size_table(file);
    if (place_of(table, "passing"))
      return by_passing(table);
    if (place_of(table, "retained"))
      return by_retained(table);
    const bool                single = place_of(table, "diameter").has_value();
    const std::vector<double> low    = lengths_of(table, single ? "diameter" : "smallest"),
                              high   = lengths_of(table, single ? "diameter" : "largest");
    std::vector<dem::SizeClass> classes;
    const std::vector<double>  &given  = table.columns[required_place(table, "fraction")];
    const std::vector<double> fraction = parts_of(table, "fraction", std::accumulate(given.begin(), given.end(), 0.0));
    for (std::size_t i = 0; i < low.size(); ++i)
      classes.push_back({fraction[i], low[i], high[i]});
    return classes;
  }

  std::vector<dem::SievePart> sieves_in_text(const std::string &text)
  {
    std::vector<dem::SievePart> sieves;
    for (const std::string &part : comma_separated(text))
      {
        const std::size_t colon = part.find(':');
        const auto        size  = number_in(trimmed(part.substr(0, std::min(colon, part.size()))));
        const auto        share = number_in(trimmed(part.substr(std::min(colon, part.size() - 1) + 1)));
        if (colon == std::string::npos || !size || !share)
          throw base::InputError("\"" + part + "\": expected size: part.");
        sieves.push_back({*size, *share});
      }
    return sieves;
  }

  dem::GradingCurve grading_of(std::vector<dem::SievePart> sieves, const bool retained)
  {
    double sum = 0, largest = 0;
    for (const dem::SievePart &sieve : sieves)
      {
        sum += sieve.part;
        largest = std::max(largest, sieve.part);
      }
    const bool percent = retained ? sum > 1.5 : largest > 1.5;
    for (dem::SievePart &sieve : sieves)
      sieve.part /= percent ? 100 : 1;
    return retained ? dem::GradingCurve::of_retained(sieves) : dem::GradingCurve::of_passing(sieves);
  }

  dem::GradingCurve grading_in_file(const std::string &file)
  {
    const postprocess::CsvTable table    = read_size_table(file);
    const bool                  retained = !place_of(table, "passing");
    const char                 *column   = retained ? "retained" : "passing";
    const std::vector<double>  &given    = table.columns[required_place(table, column)];
    const double                whole    = retained      ? std::accumulate(given.begin(), given.end(), 0.0) :
                                           given.empty() ? 0.0 :
                                                           *std::max_element(given.begin(), given.end());
    const std::vector<double>   size = lengths_of(table, "size"), part = parts_of(table, column, whole);
    std::vector<dem::SievePart> sieves;
    for (std::size_t i = 0; i < size.size(); ++i)
      if (size[i] != 0)
        sieves.push_back({size[i], part[i]});
    try
      {
        return retained ? dem::GradingCurve::of_retained(sieves) : dem::GradingCurve::of_passing(sieves);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(file + ": " + refusal.what());
      }
  }
} // namespace apps

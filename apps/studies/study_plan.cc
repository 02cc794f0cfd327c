#include "apps/studies/study_plan.h"

#include "apps/scene/kinds/read_scene.h"
#include "apps/statistics/level_designs.h"
#include "apps/statistics/orthogonal_array.h"
#include "apps/statistics/space_filling.h"
#include "apps/statistics/surface_designs.h"
#include "apps/studies/scene_entry.h"
#include "apps/text/same_name.h"
#include "apps/text/value_text.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace apps
{
  namespace
  {
    const Section &section_of(const StudyFile &study, const StudyFactor &factor)
    {
      return *study.root->find_section("Factors")->find_section(factor.name);
    }

    std::vector<double> levels_of(const StudyFile &study, const StudyFactor &factor)
    {
      std::vector<double> levels;
      for (const std::string &part : comma_separated(factor.levels_text))
        {
          const auto number = number_in(part);
          if (!number)
            section_of(study, factor).refuse("Levels", "\"" + part + "\" is no number.");
          if (std::find(levels.begin(), levels.end(), *number) != levels.end())
            section_of(study, factor).refuse("Levels", part + " is there twice.");
          levels.push_back(*number);
        }
      if (levels.empty())
        section_of(study, factor).refuse("Levels", "at least one is needed.");
      return levels;
    }

    using LevelTable = std::vector<std::vector<double>>; ///< of each factor

    Eigen::MatrixXd values_of(const Eigen::MatrixXi &design, const LevelTable &levels)
    {
      Eigen::MatrixXd values(design.rows(), design.cols());
      for (Eigen::Index run = 0; run < design.rows(); ++run)
        for (Eigen::Index factor = 0; factor < design.cols(); ++factor)
          values(run, factor) = levels[factor][design(run, factor)];
      return values;
    }

    std::vector<int> counts_of(const LevelTable &levels)
    {
      std::vector<int> counts;
      for (const auto &own : levels)
        counts.push_back(static_cast<int>(own.size()));
      return counts;
    }

    Eigen::MatrixXd one_at_a_time(const StudyFile &study, LevelTable levels)
    {
      std::vector<int> references;
      for (std::size_t k = 0; k < levels.size(); ++k)
        {
          const auto reference = number_in(study.factors[k].reference_text);
          if (!reference)
            section_of(study, study.factors[k]).refuse("Reference", "a number is wanted.");
          auto at = std::find(levels[k].begin(), levels[k].end(), *reference);
          if (at == levels[k].end())
            at = levels[k].insert(at, *reference);
          references.push_back(static_cast<int>(at - levels[k].begin()));
        }
      return values_of(statistics::one_at_a_time(counts_of(levels), references), levels);
    }

    Eigen::MatrixXd orthogonal(const StudyFile &study, const LevelTable &levels)
    {
      static const std::map<std::string, std::pair<int, int>> arrays = {
        {"L8", {2, 3}},  {"L16", {4, 2}}, {"L32", {2, 5}}, {"L9", {3, 2}},  {"L27", {3, 3}},
        {"L81", {3, 4}}, {"L64", {4, 3}}, {"L25", {5, 2}}, {"L243", {3, 5}}};
      const Section &section = *study.root->find_section("Design");
      const auto     found   = arrays.find(study.array);
      if (found == arrays.end())
        section.refuse("Array", "known are L8, L9, L16, L25, L27, L32, L64, L81 and L243.");
      const int       most  = found->second.first;
      Eigen::MatrixXi array = statistics::orthogonal_array(most, found->second.second);
      const auto      count = static_cast<Eigen::Index>(levels.size());
      if (count > array.cols())
        section.refuse("Array", fmt::format("it has {} columns, for {} factors.", array.cols(), count));
      std::vector<int> fewer;
      for (Eigen::Index k = 0; k < count; ++k)
        if (static_cast<int>(levels[k].size()) == most - 1 && most > 2)
          fewer.push_back(static_cast<int>(k));
        else if (static_cast<int>(levels[k].size()) != most)
          section_of(study, study.factors[k])
            .refuse("Levels",
                    fmt::format("{} levels for a column of {}; one less collapses it.", levels[k].size(), most));
      array = statistics::collapsed(array, fewer);
      return values_of(array.leftCols(count), levels);
    }

    /** From coded variables, -1 to 1, to values of factors. */
    Eigen::MatrixXd in_box(const StudyFile &study, Eigen::MatrixXd coded)
    {
      for (Eigen::Index k = 0; k < coded.cols(); ++k)
        {
          const StudyFactor &factor = study.factors[k];
          coded.col(k) =
            ((factor.lower + factor.upper) / 2 + coded.col(k).array() * ((factor.upper - factor.lower) / 2)).matrix();
        }
      return coded;
    }

    Eigen::MatrixXd from_table(const StudyFile &study)
    {
      if (study.table_file.empty())
        study.root->find_section("Design")->refuse("Table", "the design needs a file.");
      const postprocess::CsvTable table = postprocess::read_csv_table(study.table_file);
      Eigen::MatrixXd             values(table.rows(), study.factors.size());
      for (std::size_t k = 0; k < study.factors.size(); ++k)
        {
          const std::vector<double> &column = table.column(study.factors[k].name);
          values.col(k)                     = Eigen::Map<const Eigen::VectorXd>(column.data(), column.size());
        }
      if (values.rows() == 0)
        throw base::InputError(study.table_file + ": has no run.");
      return values;
    }

    Eigen::MatrixXd designed(const StudyFile &study)
    {
      const int  factors = static_cast<int>(study.factors.size());
      LevelTable levels;
      if (study.design <= DesignKind::orthogonal_array)
        for (const StudyFactor &factor : study.factors)
          levels.push_back(levels_of(study, factor));
      switch (study.design)
        {
        case DesignKind::one_at_a_time:
          return one_at_a_time(study, levels);
        case DesignKind::full_factorial:
          return values_of(statistics::full_factorial(counts_of(levels)), levels);
        case DesignKind::orthogonal_array:
          return orthogonal(study, levels);
        case DesignKind::central_composite:
          return in_box(
            study, statistics::central_composite(
                     factors, study.axial_distance > 0 ? study.axial_distance : statistics::rotatable_distance(factors),
                     static_cast<int>(study.centres)));
        case DesignKind::box_behnken:
          return in_box(study, statistics::box_behnken(factors, static_cast<int>(study.centres)));
        case DesignKind::latin_hypercube:
          return in_box(
            study,
            (2 * statistics::latin_hypercube(static_cast<int>(study.runs), factors, study.seed).array() - 1).matrix());
        case DesignKind::sobol:
          return in_box(study,
                        (2 * statistics::sobol_points(static_cast<int>(study.runs), factors).array() - 1).matrix());
        default:
          return from_table(study);
        }
    }

    std::string column_of(const StudyFactor &factor, const CheckedScene &scene)
    {
      const Entry *entry = entry_at(*scene.root, trimmed(comma_separated(factor.entries).front()));
      return entry && !entry->unit.empty() ? factor.name + " [" + entry->unit + "]" : factor.name;
    }

    /** Where the names of what a run can find are known beforehand. @throws base::InputError */
    void demand_responses(const StudyFile &study, const std::optional<RunOutcome> &known)
    {
      for (const StudyResponse &response : study.responses)
        try
          {
            if (known && response.is_curve())
              {
                known->demand_column(response.curve.columns.abscissa);
                known->demand_column(response.curve.columns.ordinate);
              }
            else if (known)
              known->demand_figure(response.figure);
          }
        catch (const base::InputError &refusal)
          {
            throw base::InputError(
              fmt::format("{}: response {}: {}", response.place.text(), response.name, refusal.what()));
          }
    }

    std::vector<std::string> changes_of(const StudyFile &study, const Eigen::MatrixXd &values, const Eigen::Index run)
    {
      std::vector<std::string> changes;
      for (std::size_t k = 0; k < study.factors.size(); ++k)
        for (const std::string &entry : comma_separated(study.factors[k].entries))
          changes.push_back(fmt::format("{}={}", entry, values(run, k)));
      return changes;
    }
  } // namespace

  StudyPlan plan_of(const StudyFile &study)
  {
    std::optional<RunOutcome> known;
    for (const StudyFactor &factor : study.factors)
      if (comma_separated(factor.entries).empty())
        section_of(study, factor).refuse("Entry", "an entry of the scene is wanted.");
    StudyPlan plan;
    plan.values = designed(study);
    for (Eigen::Index run = 0; run < plan.values.rows(); ++run)
      {
        plan.changes.push_back(changes_of(study, plan.values, run));
        try
          {
            const CheckedScene scene   = read_scene(study.base_scene, plan.changes.back());
            const RunRequest   request = request_of(scene);
            plan.text += request.deciding_text;
            for (const InputFile &input : request.inputs)
              plan.text += fmt::format("{} {} {}\n", input.entry, input.bytes, input.digest);
            if (run > 0)
              continue;
            known = scene.scene->outcome();
            for (const StudyFactor &factor : study.factors)
              plan.columns.push_back(column_of(factor, scene));
          }
        catch (const base::InputError &refusal)
          {
            throw base::InputError(fmt::format("{}: run {} ({}): {}", study.file, run + 1,
                                               fmt::join(plan.changes.back(), ", "), refusal.what()));
          }
      }
    demand_responses(study, known);
    for (const StudyResponse &response : study.responses)
      plan.text +=
        response.name + " = " +
        (response.is_curve() ? fmt::format("curve {} {} {} {} {} {}", static_cast<int>(response.curve.measure),
                                           response.curve.columns.abscissa, response.curve.columns.ordinate,
                                           response.curve.columns.test, response.curve.from, response.curve.to) :
                               response.figure) +
        (response.curve.measure == CurveMeasure::hardening ? fmt::format(" {}", response.curve.offset) : "") + "\n";
    return plan;
  }
} // namespace apps

#include "apps/validation/validation.h"

#include "apps/optimisation/references.h"
#include "apps/process/mpi_session.h"
#include "apps/statistics/references.h"
#include "apps/validation/scene_references.h"
#include "base/stopwatch.h"
#include "coupling/references/references.h"
#include "dem/references/references.h"
#include "fem/references/references.h"
#include "postprocess/files/html_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *introduction =
      "Values of this program beside published ones, closed forms and answers of other programs, as \"breccia "
      "validate\" "
      "finds them: the tests compare the same table. An error is over the reference, or, where the limit has a unit or "
      "the reference is zero, the difference itself.";

    const std::vector<std::string> table_columns = {"quantity", "unit", "reference", "here", "error", "limit"};

    std::vector<std::string> cells_of(const base::Comparison &row)
    {
      return {row.quantity,
              row.unit.empty() ? "-" : row.unit,
              fmt::format("{:.10g}", row.reference),
              fmt::format("{:.10g}", row.found),
              fmt::format("{:.1e}", row.error()),
              fmt::format("{:.1e}{}", row.limit,
                          row.relative     ? "" :
                          row.unit.empty() ? " (difference)" :
                                             " " + row.unit)};
    }

    std::string sum_of(const std::vector<ComparedReference> &all)
    {
      std::size_t rows = 0, beyond = 0;
      for (const ComparedReference &one : all)
        {
          rows += one.rows.size();
          beyond += one.beyond();
        }
      return fmt::format("{} values of {} references, {} beyond their limits.", rows, all.size(), beyond);
    }

    std::string cost_of(const ComparedReference &one)
    {
      return fmt::format("Cost: {} s. Worst: {:.2g} of its limit.",
                         fmt::format(one.seconds < 10 ? "{:.2g}" : "{:.0f}", one.seconds), one.worst());
    }
  } // namespace

  std::vector<base::Reference> every_reference()
  {
    std::vector<base::Reference> all;
    for (const std::vector<base::Reference> *const room :
         {&dem::all_references(), &fem::all_references(), &coupling::all_references(), &statistics::all_references(),
          &optimisation::all_references(), &scene_references()})
      all.insert(all.end(), room->begin(), room->end());
    return all;
  }

  std::size_t ComparedReference::beyond() const
  {
    return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const base::Comparison &row) { return !row.holds(); }));
  }

  double ComparedReference::worst() const
  {
    double largest = 0;
    for (const base::Comparison &row : rows)
      if (row.limit > 0)
        largest = std::max(largest, row.error() / row.limit);
    return largest;
  }

  ComparedReference compared(const base::Reference &reference)
  {
    start_mpi(); // solids need it
    const base::Stopwatch watch;
    base::Comparisons     rows;
    reference.compare(rows);
    return {reference, rows.all(), watch.seconds()};
  }

  std::string validation_markdown(const std::vector<ComparedReference> &all)
  {
    std::string text = fmt::format("# Validation\n\n{}\n\n{}\n", introduction, sum_of(all));
    for (const ComparedReference &one : all)
      {
        text += fmt::format("\n## {}\n\nReference: {}.\n\n{}\n\n| {} |\n|---|---|---:|---:|---:|---:|\n",
                            one.reference.subject, one.reference.source, cost_of(one), fmt::join(table_columns, " | "));
        for (const base::Comparison &row : one.rows)
          text += fmt::format("| {} |\n", fmt::join(cells_of(row), " | "));
      }
    return text;
  }

  std::string validation_html(const std::vector<ComparedReference> &all)
  {
    postprocess::HtmlPage page("Validation of Breccia");
    page.paragraph(introduction);
    page.paragraph(sum_of(all));
    for (const ComparedReference &one : all)
      {
        page.heading(one.reference.subject);
        page.paragraph("Reference: " + one.reference.source + ". " + cost_of(one));
        std::vector<std::vector<std::string>> rows = {table_columns};
        for (const base::Comparison &row : one.rows)
          rows.push_back(cells_of(row));
        page.table(rows);
      }
    return page.text();
  }
} // namespace apps

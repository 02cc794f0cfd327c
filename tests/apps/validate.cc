// The table of references, its command and its page.
#include "apps/validation/validation.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string committed_page() { return content_of(std::filesystem::path(places::sources()) / "doc/validation.md"); }

  std::vector<std::string> lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }

  /** Cells of a row of a table in Markdown. */
  std::vector<std::string> cells_of(const std::string &line)
  {
    std::vector<std::string> cells;
    for (std::size_t at = 2; at < line.size();)
      {
        const std::size_t end = line.find(" |", at);
        cells.push_back(line.substr(at, end - at));
        at = end + 3;
      }
    return cells;
  }

  bool is_row(const std::string &line) { return line.rfind("| ", 0) == 0 && line.rfind("| quantity", 0) != 0; }

  /** The page without what another machine finds otherwise: last digits, and time. */
  std::string what_is_compared(const std::string &page)
  {
    std::string kept;
    for (const std::string &line : lines_of(page))
      if (line.rfind("Cost: ", 0) == 0)
        continue;
      else if (is_row(line))
        {
          const auto cells = cells_of(line);
          kept += cells.at(0) + " " + cells.at(1) + " " + cells.at(2) + " " + cells.at(5) + "\n";
        }
      else
        kept += line + "\n";
    return kept;
  }
} // namespace

TEST_CASE("The committed page of references has every one, and no value beyond its limit", "[apps]")
{
  const std::string page = committed_page();
  std::string       headings, wanted;
  for (const std::string &line : lines_of(page))
    if (line.rfind("## ", 0) == 0)
      headings += line + "\n";
    else if (line.rfind("Reference: ", 0) == 0)
      headings += line + "\n";
  std::set<std::string> subjects;
  for (const base::Reference &reference : apps::every_reference())
    {
      wanted += "## " + reference.subject + "\nReference: " + reference.source + ".\n";
      CHECK(subjects.insert(reference.subject).second);
    }
  CHECK(headings == wanted);

  int rows = 0;
  for (const std::string &line : lines_of(page))
    if (is_row(line))
      {
        const auto   cells     = cells_of(line);
        const double reference = std::stod(cells.at(2)), here = std::stod(cells.at(3)), limit = std::stod(cells.at(5));
        const bool   relative = cells.at(5).find(' ') == std::string::npos;
        INFO(line);
        // What is printed has ten digits, the limit two.
        CHECK(std::fabs(here - reference) <=
              1.05 * limit * (relative ? std::fabs(reference) : 1) + 1e-9 * std::fabs(reference));
        ++rows;
      }
  CHECK(rows >= 60);
}

TEST_CASE("validate finds the values of the committed page, and says where it has written them", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"validate", "-o", "found.md", "-o", "found.html"});
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("concrete in uniaxial tension") && Contains(" 0 beyond their limits") &&
                            Contains("written to found.md"));
  CHECK(what_is_compared(content_of(folder / "found.md")) == what_is_compared(committed_page()));
  CHECK_THAT(content_of(folder / "found.html"), Contains("<td>m_0 of M1</td>"));
}

TEST_CASE("validate takes one subject, and lists them where it knows none of that name", "[apps]")
{
  const ScratchFolder folder;
  const Outcome       one = run(folder.path(), {"validate", "--only", "half-normal"});
  CHECK(one.status == 0);
  CHECK_THAT(one.out, Contains("half-normal quantiles") && !Contains("concrete") && Contains("2 values"));
  CHECK(run(folder.path(), {"validate", "-o", "found.pdf"}).status == 2);
  const Outcome none = run(folder.path(), {"validate", "--only", "gravity waves"});
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("--only gravity waves") && Contains("concrete in uniaxial tension"));
}

TEST_CASE("A value beyond its limit, or none, is reported", "[apps]")
{
  base::Reference reference{"subject", "source", [](base::Comparisons &rows) {
                              rows.of("a", "Pa", 1.02).within(0.01, 1);
                              rows.of("b", "", 1.02).within_margin(0.03, 1);
                              rows.of("c", "", std::nan("")).within(1, 1);
                            }};
  const auto      found = apps::compared(reference);
  CHECK(found.beyond() == 2);
  CHECK_FALSE(found.rows.at(0).holds());
  CHECK(found.rows.at(1).holds());
  CHECK_THAT(apps::validation_markdown({found}), Contains("3 values of 1 references, 2 beyond") &&
                                                   Contains("| a | Pa | 1 | 1.02 | 2.0e-02 | 1.0e-02 |") &&
                                                   Contains("| b | - | 1 | 1.02 | 2.0e-02 | 3.0e-02 (difference) |"));
}

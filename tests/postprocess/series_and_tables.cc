#include "base/errors.h"
#include "full_disk.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/series.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace postprocess;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using postprocess_tests::content_of;
using postprocess_tests::FullDisk;
using postprocess_tests::ScratchFolder;

namespace
{
  const std::vector<SeriesColumn> columns = {{"time", "s"}, {"damage", "-"}, {"broken", ""}};

  void append_rows(SeriesWriter &series, const int first, const int end)
  {
    for (int i = first; i < end; ++i)
      series.append({i / 3.0, std::sqrt(i), double(i)});
  }
} // namespace

TEST_CASE("a series has units in its header and values that keep every bit", "[postprocess]")
{
  const ScratchFolder folder;
  {
    SeriesWriter series(folder / "series.csv", columns);
    append_rows(series, 0, 100);
    series.append({-0.0, 5e-324, 1.7976931348623157e308});
    REQUIRE(series.rows() == 101);
  }
  REQUIRE_THAT(content_of(folder / "series.csv"), Catch::Matchers::StartsWith("time [s],damage [-],broken\n0,0,0\n"));
  const CsvTable table = read_csv_table(folder / "series.csv");
  REQUIRE(table.names == std::vector<std::string>{"time", "damage", "broken"});
  REQUIRE(table.units == std::vector<std::string>{"s", "-", ""});
  REQUIRE(table.rows() == 101);
  for (int i = 0; i < 100; ++i)
    {
      REQUIRE(table.column("time")[i] == i / 3.0);
      REQUIRE(table.column("damage")[i] == std::sqrt(i));
    }
  REQUIRE(std::signbit(table.column("time")[100]));
  REQUIRE(table.column("damage")[100] == 5e-324);
}

TEST_CASE("a resumed series is the same file as an uninterrupted one", "[postprocess]")
{
  const ScratchFolder folder;
  {
    SeriesWriter whole(folder / "whole.csv", columns);
    append_rows(whole, 0, 50);
  }
  std::int64_t at_checkpoint = 0;
  {
    SeriesWriter killed(folder / "killed.csv", columns);
    append_rows(killed, 0, 30);
    killed.flush();
    at_checkpoint = killed.rows();
    append_rows(killed, 30, 40); // after the checkpoint
  }
  std::ofstream(folder / "killed.csv", std::ios::app) << "13.33,6.4"; // killed in the middle of a row
  {
    SeriesWriter resumed(folder / "killed.csv", columns, at_checkpoint);
    REQUIRE(resumed.rows() == 30);
    append_rows(resumed, 30, 50);
  }
  REQUIRE(content_of(folder / "killed.csv") == content_of(folder / "whole.csv"));
}

TEST_CASE("a series that does not fit the checkpoint is refused and left alone", "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   text = "time [s],damage [-],broken\n0,0,0\n1,1,1\n";
  const auto          path = folder.file("series.csv", text);
  REQUIRE_THROWS_WITH(SeriesWriter(path, columns, 3), Contains("series.csv: holds 2 rows, the checkpoint knows of 3"));
  REQUIRE_THROWS_WITH(SeriesWriter(path, {{"time", "s"}}, 1), Contains("its header is not that of this run"));
  REQUIRE_THROWS_AS(SeriesWriter(path, columns, 3), base::InputError);
  REQUIRE(content_of(path) == text);
  REQUIRE_THROWS_WITH(SeriesWriter(folder / "none.csv", columns, 3), Contains("No such file"));
}

TEST_CASE("flush brings all rows into the file", "[postprocess]")
{
  const ScratchFolder folder;
  SeriesWriter        series(folder / "series.csv", columns);
  append_rows(series, 0, 5);
  series.flush();
  REQUIRE(read_csv_table(folder / "series.csv").rows() == 5);
}

TEST_CASE("a full disk is reported by flush with the file's name", "[postprocess]")
{
  REQUIRE_THROWS_WITH(SeriesWriter("/dev/full", columns), "/dev/full: cannot be written: No space left on device.");

  const ScratchFolder folder;
  SeriesWriter        series(folder / "series.csv", columns);
  std::string         message;
  {
    const FullDisk limit(100);
    try
      {
        append_rows(series, 0, 100);
        series.flush();
      }
    catch (const OutputError &error)
      {
        message = error.what();
      }
  }
  REQUIRE_THAT(message, EndsWith("series.csv: cannot be written: File too large."));
}

TEST_CASE("a series refuses a row of another length and shows NaN as such", "[postprocess]")
{
  const ScratchFolder folder;
  SeriesWriter        series(folder / "series.csv", columns);
  REQUIRE_THROWS_AS(series.append({1, 2}), std::invalid_argument);
  series.append({1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()});
  series.flush();
  REQUIRE_THAT(content_of(folder / "series.csv"), EndsWith("\n1,nan,inf\n"));
  REQUIRE_THROWS_WITH(read_csv_table(folder / "series.csv"),
                      Contains("line 2: \"nan\": only finite numbers are allowed."));
  const CsvTable table = read_csv_table(folder / "series.csv", /*accept_not_finite=*/true);
  REQUIRE(std::isnan(table.column("damage")[0]));
  REQUIRE(std::isinf(table.column("broken")[0]));
}

TEST_CASE("tables of other programs are understood", "[postprocess]")
{
  const ScratchFolder folder;
  const std::string   text =
    GENERATE("a,b [Pa],c\n1,2,3\n4,5,6\n", "# note\na b [Pa] c\n1 2 3\n\n# more\n4 5 6\n",
             "a\tb[Pa]\tc\r\n1\t2\t3\r\n4\t5\t6", "a,b [Pa],c\r1,2,3\r4,5,6\r", " a , b [Pa] , c\n 1 , 2 , 3\n4 5 6\n");
  CAPTURE(text);
  const CsvTable table = read_csv_table(folder.file("t.csv", text));
  REQUIRE(table.names == std::vector<std::string>{"a", "b", "c"});
  REQUIRE(table.units == std::vector<std::string>{"", "Pa", ""});
  REQUIRE(table.column("b") == std::vector<double>{2, 5});
}

TEST_CASE("a faulty table is refused with file, line and reason", "[postprocess]")
{
  const ScratchFolder folder;
  const auto          message = [&](const std::string &text) {
    try
      {
        read_csv_table(folder.file("t.csv", text));
      }
    catch (const base::InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("accepted");
  };
  const std::string file = (folder / "t.csv").string();
  REQUIRE(message("") == file + ": is empty. The first line must name the columns.");
  REQUIRE(message("1,2\n") == file + ", line 1: the first line must name the columns, found \"1,2\".");
  REQUIRE(message("a,,b\n") == file + ", line 1: the first line must name the columns, found \"a,,b\".");
  REQUIRE(message("a,a [m]\n") == file + ", line 1: the column a is named twice.");
  REQUIRE(message("a,b\n1,2\n3\n") == file + ", line 3: found 1 values, expected 2 as in the header.");
  REQUIRE(message("a,b\n1,\n") == file + ", line 2: found 1 values, expected 2 as in the header.");
  REQUIRE(message("a,b\n1,two\n") == file + ", line 2: \"two\" is not a number.");
  REQUIRE_THROWS_WITH(read_csv_table(folder.file("t.csv", "a,b\n1,2\n")).column("c"),
                      file + ": there is no column c. Columns: a, b.");
  REQUIRE_THROWS_AS(read_csv_table(folder / "none.csv"), base::InputError);
}

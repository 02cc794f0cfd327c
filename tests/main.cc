// The main function of every test executable: Catch2's, and besides
//
//   test_ROOM --write-ctest FILE PREFIX     lists the test cases as CTest commands (run by the build)
#define CATCH_CONFIG_RUNNER
#include "dem/core/floating_point_traps.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <string>

namespace
{
  // As CMake text that no character of a test name can end or expand.
  std::string quoted(const std::string &text) { return "[==[" + text + "]==]"; }

  // Commas and brackets have a meaning in Catch2's test selection.
  std::string selection(const std::string &name)
  {
    std::string escaped;
    for (const char c : name)
      {
        if (c == ',' || c == '[' || c == ']' || c == '\\')
          escaped += '\\';
        escaped += c;
      }
    return escaped;
  }

  bool selects_exactly(const std::string &pattern, const Catch::TestCase &test, const Catch::IConfig &config)
  {
    const Catch::TestSpec spec = Catch::parseTestSpec(pattern);
    for (const Catch::TestCase &other : Catch::getAllTestCasesSorted(config))
      if (Catch::matchTest(other, spec, config) != (other.name == test.name))
        return false;
    return true;
  }

  bool has_tag(const Catch::TestCase &test, const std::string &tag)
  {
    return std::find(test.lcaseTags.begin(), test.lcaseTags.end(), tag) != test.lcaseTags.end();
  }

  // Fast tests come first. All run side by side on one thread each, which wastes less than several threads in a test; what is of
  // several threads asks for them, and threads that wait sleep: it would otherwise spend its time in barriers. Ranks do not sleep.
  std::string properties(const Catch::TestCase &test)
  {
    return std::string(has_tag(test, "slow") ? "LABELS slow COST 1" : "LABELS fast COST 100") + " PROCESSORS " +
           (has_tag(test, "mpi") ? "2" : "1") + " ENVIRONMENT \"OMP_NUM_THREADS=1;OMP_WAIT_POLICY=passive\"";
  }

  int write_ctest(const std::string &executable, const std::string &file, const std::string &prefix)
  {
    const Catch::Config config;
    std::ofstream       out(file);
    for (const Catch::TestCase &test : Catch::getAllTestCasesSorted(config))
      {
        if (test.isHidden())
          continue;
        const std::string pattern = selection(test.name);
        if (!selects_exactly(pattern, test, config))
          {
            std::cerr
              << test.lineInfo << ": test name \"" << test.name
              << "\" cannot be selected on the command line. Begin it with a letter, without * at either end.\n";
            return 1;
          }
        const std::string name = quoted(prefix + ": " + test.name);
        out << "add_test(" << name << ' ' << quoted(executable) << " -w NoTests " << quoted(pattern) << ")\n"
            << "set_tests_properties(" << name << " PROPERTIES " << properties(test) << ")\n";
      }
    out.close();
    return out ? 0 : 1;
  }
} // namespace

int main(int argc, char *argv[])
{
  Catch::Session session;
  if (argc == 4 && std::string(argv[1]) == "--write-ctest")
    return write_ctest(argv[0], argv[2], argv[3]);
  dem::enable_floating_point_traps();
  return session.run(argc, argv);
}

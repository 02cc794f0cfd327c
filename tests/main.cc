// The main function of every test executable: Catch2's, and besides
//
//   test_ROOM --write-ctest FILE PREFIX CACHES [by-file]     lists the test cases as CTest commands (run by the build)
#define CATCH_CONFIG_RUNNER
#include "dem/core/floating_point_traps.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <set>
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
  // several threads requests them, and threads that wait sleep: it would otherwise spend its time in barriers. Ranks do not sleep.
  // Packings are made by the program under test: the cache is the tests' own, and emptied before the first of them.
  std::string properties(const Catch::TestCase &test, const std::string &caches)
  {
    return std::string(has_tag(test, "slow") ? "LABELS slow COST 1" : "LABELS fast COST 100") + " PROCESSORS " +
           (has_tag(test, "mpi") ? "2" : "1") +
           (has_tag(test, "mpi") || has_tag(test, "zsh") ? " SKIP_REGULAR_EXPRESSION \"Skipped: there is no \"" : "") +
           " FIXTURES_REQUIRED caches ENVIRONMENT " +
           quoted("OMP_NUM_THREADS=1;OMP_WAIT_POLICY=passive;XDG_CACHE_HOME=" + caches);
  }

  /** Without folder and extension, as Catch2 makes tags of files. */
  std::string file_of(const Catch::TestCase &test)
  {
    const std::string path = test.lineInfo.file;
    const std::size_t from = path.find_last_of('/') + 1; // 0 where there is none
    return path.substr(from, path.find_last_of('.') - from);
  }

  /** @param by_file fast tests of a source run in one process: where it takes longer to start than most tests do */
  int write_ctest(const std::string &executable,
                  const std::string &file,
                  const std::string &prefix,
                  const std::string &caches,
                  const bool         by_file)
  {
    const Catch::Config   config;
    std::ofstream         out(file);
    std::set<std::string> files;
    const auto            add = [&](const std::string &name, const std::string &selected, const Catch::TestCase &like) {
      out << "add_test(" << name << ' ' << quoted(executable) << " -w NoTests " << selected << ")\n"
          << "set_tests_properties(" << name << " PROPERTIES " << properties(like, caches) << ")\n";
    };
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
        if (!by_file || has_tag(test, "slow") || has_tag(test, "mpi"))
          add(quoted(prefix + ": " + test.name), quoted(pattern), test);
        else if (const std::string source = file_of(test); files.insert(source).second)
          add(quoted(prefix + ": " + source + ".cc"),
              "--filenames-as-tags " + quoted("[#" + source + "]~[slow]~[mpi]~[.]"), test);
      }
    out.close();
    return out ? 0 : 1;
  }
} // namespace

int main(int argc, char *argv[])
{
  Catch::Session session;
  if (argc >= 5 && std::string(argv[1]) == "--write-ctest")
    return write_ctest(argv[0], argv[2], argv[3], argv[4], argc == 6 && std::string(argv[5]) == "by-file");
  dem::enable_floating_point_traps();
  return session.run(argc, argv);
}

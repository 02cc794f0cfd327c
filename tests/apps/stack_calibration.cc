#include "tests/apps/stack_calibration.h"

#include "postprocess/files/csv_table.h"
#include "tests/apps/scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

namespace apps_tests
{
  /** Constants of a stack of spheres that is pulled until it breaks, in part of a second. */
  std::string calibration_of_stack(const std::string &targets)
  {
    return R"(set Kind       = calibration
set Base scene = stack.prm
subsection Constants
  subsection modulus
    set Entry = Material/CPM/Normal modulus
    set Start = 22e9
    set Lower = 15e9
    set Upper = 40e9
  end
  subsection limit
    set Entry = Material/CPM/Limit elastic strain
    set Start = 1.2e-4
    set Lower = 0.4e-4
    set Upper = 2e-4
  end
  subsection unseen
    set Entry = Loading/Compression/Strain rate
    set Start = 15
    set Lower = 10
    set Upper = 20
  end
end
subsection Targets
)" + targets +
           "end\n";
  }

  std::string two_figures()
  {
    return R"(  subsection E
    set Figure = young_modulus
    set Value  = 1e9
    set Standard deviation = 1e8
  end
  subsection f_t
    set Figure = tensile_strength
    set Value  = 1e6
    set Standard deviation = 1e5
  end
)";
  }

  std::string two_constants(const std::string &targets)
  {
    const std::string text = calibration_of_stack(targets);
    const std::size_t from = text.find("  subsection unseen"), to = text.find("  end\n", from) + 6;
    return text.substr(0, from) + text.substr(to);
  }

  std::string stack_figures(const std::string &modulus, const std::string &deviation)
  {
    std::string text = replaced(two_figures(), "1e9", modulus);
    text             = replaced(text, "1e8", deviation);
    return replaced(text, "set Value  = 1e6", "set Value  = 5.5e6");
  }

  void write_calibration(const ScratchFolder &folder, const std::string &text)
  {
    folder.file("packing.txt", stack_packing());
    std::string scene = replaced(scene_with_file(), "set Grip thickness", "set Tests = tension\n  set Grip thickness");
    folder.file("stack.prm", replaced(scene, "set Snapshots = 5", "set Snapshots = 0"));
    folder.file("calibration.prm", text);
  }

  Outcome calibrate(const ScratchFolder &folder, const std::vector<std::string> &options)
  {
    std::vector<std::string> words = {"calibrate", "calibration.prm"};
    words.insert(words.end(), options.begin(), options.end());
    return Program(folder.path(), words).wait();
  }

  double measured_up_to_peak(const ScratchFolder &folder, const std::string &test)
  {
    const auto          truth = postprocess::read_csv_table(folder / "truth/series.csv", true, {"test"});
    std::vector<double> x, y;
    for (std::size_t row = 0; row < truth.rows(); ++row)
      if (truth.words[0][row] == test)
        {
          x.push_back(truth.column("strain")[row]);
          y.push_back(truth.column("stress")[row]);
        }
    const auto peak =
      std::max_element(y.begin(), y.end(), [](const double a, const double b) { return std::fabs(a) < std::fabs(b); });
    const double               deviation = 0.02 * std::fabs(*peak);
    std::mt19937               stream(5);
    std::normal_distribution<> noise(0, deviation);
    std::ostringstream         text;
    text.precision(17);
    text << "strain [%],stress [MPa]\n"; // as laboratories write it
    for (std::size_t row = 0; row <= std::size_t(peak - y.begin()); ++row)
      text << 100 * x[row] << ',' << 1e-6 * (y[row] + noise(stream)) << '\n';
    folder.file(test + ".csv", text.str());
    return deviation;
  }

  double measure(const ScratchFolder &folder)
  {
    REQUIRE(run(folder.path(), {"run", "stack.prm", "-o", "truth", "-s", "Material/CPM/Normal modulus=27e9", "-s",
                                "Material/CPM/Limit elastic strain=0.8e-4"})
              .status == 0);
    const double deviation = measured_up_to_peak(folder, "tension");
    folder.file("measured.csv", content_of(folder / "tension.csv"));
    return deviation;
  }

  void write_curve_calibration(const ScratchFolder &folder, const std::string &section)
  {
    write_calibration(folder, "");
    std::ostringstream target;
    target << "  subsection pull\n    set Curve = measured.csv\n    set Test = tension\n    set Standard deviation = "
           << measure(folder) << "\n  end\n";
    write_calibration(folder, section + calibration_of_stack(target.str()));
  }
} // namespace apps_tests

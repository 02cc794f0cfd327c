// Beams of elements with a core of particles that bear their weight, and that are led by the opening of their notch.
#include "tests/apps/structure_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  // Of discs of 1 mm on a square lattice, as many one above the other; supports of the beam, [m].
  constexpr int    discs   = 12;
  constexpr double spacing = 2e-3, depth = discs * spacing, width = 0.01, length = 0.112, span = 0.104,
                   notch = 2 * spacing, bulk_density = 2400, acceleration = 100, elements_modulus = 20e9,
                   poisson_ratio = 0.1;

  /** Particles from x = low to high, in the middle of cells of the lattice. */
  std::string lattice(const double low, const double high)
  {
    std::ostringstream text;
    for (double x = low + 0.5 * spacing; x < high; x += spacing)
      for (int j = 0; j < discs; ++j)
        text << x << ' ' << (j + 0.5) * spacing << " 0 " << 0.5 * spacing << '\n';
    return text.str();
  }

  std::string box(const char *name, const double x0, const double y0, const double x1, const double y1)
  {
    std::ostringstream text;
    text << "  subsection " << name << "\n    set Shape = box\n    set Lower = " << x0 << ", " << y0
         << ", -1\n    set Upper = " << x1 << ", " << y1 << ", 1\n  end\n";
    return text.str();
  }

  std::string law(const char *limit)
  {
    return std::string(
             "    set Law = CPM\n    subsection CPM\n      set Normal modulus = 25e9\n      set Shear ratio = 0.2\n"
             "      set Limit elastic strain = ") +
           limit +
           "\n      set Relative ductility = 30\n      set Cohesion = 1e9\n      set Friction coefficient = 0\n    "
           "end\n";
  }

  /** Particles of which the bonds of one plane soften, and all others hold. */
  std::string particles(const double plane)
  {
    std::ostringstream text;
    text << "set Kind = structure\nsubsection Physics\n  set Dimension = 2\nend\nsubsection Specimen\n  set Source = "
            "file\n"
         << "  set File = beam.txt\n  set Thickness = 0.01\n  set Interaction ratio = 1.05\nend\nsubsection Materials\n"
         << "  subsection left\n"
         << law("1e-2") << "  end\n  subsection right\n"
         << law("1e-2") << "  end\nend\nsubsection Regions\n"
         << "  subsection half\n    set Material = right\n    set Shape = box\n    set Lower = " << plane
         << ", -1, -1\n    set Upper = 1, 1, 1\n  end\nend\nsubsection Interfaces\n  subsection ligament\n"
         << "    set Material = left\n    set Other material = right\n"
         << law("1e-4") << "  end\nend\n";
    return text.str();
  }

  /** Nodes held upright where the beam is supported, from its lower face up to a height. */
  std::string supports(const double up_to)
  {
    std::ostringstream text;
    text << "  subsection Supports\n    subsection pin\n      set From = " << -0.5 * span << ", " << 0.5 * up_to
         << ", 0\n      set Displacement x = 0\n    end\n";
    for (const auto &[name, x] : {std::pair{"left", -0.5 * span}, {"right", 0.5 * span}})
      text << "    subsection " << name << "\n      set From = " << x << ", 0, 0\n      set To = " << x << ", " << up_to
           << ", 0\n      set Displacement y = 0\n    end\n";
    text << "  end\n";
    return text.str();
  }

  /** Elements of 4 mm, 6 of them one above the other. @param model, rest more of these sections */
  std::string elements(const int columns, const std::string &model, const std::string &rest)
  {
    std::ostringstream text;
    text
      << "subsection Continuum\n  subsection Model\n    set Dimension = 2\n    set Plane = stress\n    set Thickness = "
      << width << '\n'
      << model << "  end\n  subsection Mesh\n    set Source = bodies\n    subsection Boxes\n"
      << "      subsection beam\n        set Corner = " << -0.5 * length
      << ", 0, 0\n        set Size = " << 4e-3 * columns << ", " << depth
      << ", 0\n        set Divisions x = " << columns
      << "\n        set Divisions y = 6\n        set Material = concrete\n      end\n    end\n  end\n"
      << "  subsection Materials\n    subsection concrete\n      set Law = isotropic elastic\n"
      << "      subsection isotropic elastic\n        set Young modulus = " << elements_modulus
      << "\n        set Poisson ratio = " << poisson_ratio << "\n      end\n    end\n  end\n"
      << rest << "end\n";
    return text.str();
  }

  std::string core(const double low, const double high)
  {
    std::ostringstream text;
    text << "subsection Handshakes\n  subsection core\n    set Low = " << low << ", -1, -1\n    set High = " << high
         << ", 1, 1\n    set Overlap = " << 2 * spacing << "\n  end\nend\n";
    return text.str();
  }

  const char *path = "subsection Supports\n  subsection load\n    set Displacement y = -t\n  end\nend\n"
                     "subsection Output\n  set Points per snapshot = 0\n  set Curve vertical = reaction_load_y\nend\n";

  /** Notched, its core in the middle. */
  std::string notched_beam()
  {
    std::ostringstream text;
    text
      << particles(0) << elements(28, "", supports(0)) << core(-4 * spacing, 4 * spacing) << path
      << "subsection Voids\n"
      << box("notch", -1e-4, -1, 1e-4, notch) << "end\nsubsection Groups\n"
      << box("load", -spacing, depth - spacing, spacing, 1) << box("left lip", -spacing, -1, 0, spacing)
      << box("right lip", 0, -1, spacing, spacing) << "end\nsubsection Path\n  set End = 4e-4\n  set Step = 1e-6\n"
      << "  set Stop fraction = 0\nend\nsubsection Bending test\n  set Span = " << span << "\n  set Depth = " << depth
      << "\n  set Width = " << width << "\n  set Notch depth = " << notch
      << "\nend\nsubsection Probes\n  subsection opening\n    set Group = right lip\n    set Other group = left lip\n"
      << "    set Component = x\n  end\nend\n";
    return text.str();
  }

  /** Whole in its middle, where it is of elements; the core is what hangs over the right support. */
  std::string beam_with_tail()
  {
    std::ostringstream text;
    text << particles(0.072)
         << elements(34, "    set Element order = 2\n",
                     supports(depth) + "  subsection Points\n    subsection middle\n      set Position = 0, " +
                       std::to_string(0.5 * depth) + ", 0\n    end\n  end\n")
         << core(0.068, 1) << path << "subsection Groups\n"
         << box("load", 0.078, depth - spacing, 1, 1)
         << "end\nsubsection Path\n  set End = 1e-12\n  set Step = 1e-12\nend\n";
    return text.str();
  }

  /** So that particles and elements are as heavy as each other. */
  std::vector<std::string> heavy(const std::vector<std::string> &changes = {}, const double g = acceleration)
  {
    std::vector<std::string> all = {"Gravity/Acceleration=0, " + std::to_string(-g) + ", 0",
                                    "Specimen/Density=" + std::to_string(bulk_density * 4 / M_PI),
                                    "Continuum/Materials/concrete/Density=" + std::to_string(bulk_density)};
    all.insert(all.end(), changes.begin(), changes.end());
    return all;
  }

  std::vector<std::string> heavy_test(const std::vector<std::string> &changes = {}, const double g = acceleration)
  {
    std::vector<std::string> all = heavy({"Bending test/Length=" + std::to_string(length)}, g);
    all.insert(all.end(), changes.begin(), changes.end());
    return all;
  }

  struct BeamFiles
  {
    ScratchFolder folder;
    std::string   scene;

    BeamFiles(const std::string &text, const std::string &packing)
      : scene(folder.file("beam.prm", text))
    {
      folder.file("beam.txt", packing);
    }
    Results run(const std::vector<std::string> &changes = {}) const
    {
      return results_of(folder, scene, changes, {"control"});
    }
  };

  BeamFiles notched() { return {notched_beam(), lattice(-6 * spacing, 6 * spacing)}; }

  double figure_of(const Results &found, const char *name)
  {
    return found.summary["figures"]["bending_test"][name]["value"];
  }
} // namespace

TEST_CASE("A beam sags under its weight as the closed form says, and its supports bear all of it",
          "[apps][structure][weight][volume]")
{
  const BeamFiles beam{beam_with_tail(), lattice(0.064, 0.08)};
  const Results   found  = beam.run(heavy());
  const auto      column = [&found](const char *name) { return found.series.column(name).front(); };
  REQUIRE(column("weight") == 1); // nothing is damaged: put on at once
  const double weight = found.summary["weight"]["force"]["value"], q = bulk_density * acceleration * depth * width;
  CHECK(weight == Approx(q * (length + 0.024)).epsilon(1e-6)); // what is in the overlap counts once
  CHECK(column("reaction_left_y") + column("reaction_right_y") + column("reaction_load_y") ==
        Approx(weight).epsilon(1e-9));
  CHECK(std::fabs(column("reaction_load_y")) < 1e-9 * weight); // what is driven later bears nothing
  // Between the supports by bending and shear (Timoshenko), less what hangs over them.
  const double over_left = 0.5 * (length - span), over_right = over_left + 0.024;
  const double bending = elements_modulus * width * std::pow(depth, 3) / 12,
               shear   = 5.0 / 6 * elements_modulus / (2 * (1 + poisson_ratio)) * depth * width;
  const double sag     = 5 * q * std::pow(span, 4) / (384 * bending) + q * span * span / (8 * shear) -
                     0.5 * q * (over_left * over_left + over_right * over_right) * span * span / (16 * bending);
  CHECK(-column("displacement_middle_y") == Approx(sag).epsilon(0.02));
  CHECK(std::fabs(column("energy_residual")) < 1e-7 * column("energy_work"));
  CHECK(column("energy_weight") == Approx(column("energy_work")).epsilon(1e-12));
}

/** Work that a load has still to do from where it has fallen to a part of itself, over the ligament [J/m^2]. */
double work_left(const Results &found, const double load)
{
  const auto &force = found.series.column("reaction_load_y"), &work = found.series.column("energy_work");
  auto        row = static_cast<std::size_t>(std::min_element(force.begin(), force.end()) - force.begin());
  while (-force.at(row) > load)
    ++row;
  const double part = (-force[row - 1] - load) / (force[row] - force[row - 1]);
  return (work.back() - work[row - 1] - part * (work[row] - work[row - 1])) / (width * (depth - notch));
}

TEST_CASE(
  "Work of fracture of a beam that bears its weight is that of the same beam without one, once the weight is counted",
  "[apps][structure][weight][volume][slow]")
{
  const BeamFiles beam  = notched();
  const Results   bare  = beam.run({"Path/Stop fraction=0.0005"});
  const double    whole = figure_of(bare, "work_of_fracture");
  // All bonds of the ligament but the last, about which both halves turn: E eps_0 (eps_0/2 + eps_f) times its length each.
  CHECK(whole == Approx(25e9 * 1e-4 * 30.5e-4 * spacing * (discs - 3) / (discs - 2)).epsilon(0.01));
  for (const auto &[g, bound] : {std::pair{10.0, 0.02}, {40.0, 0.035}})
    {
      const Results borne  = beam.run(heavy_test({}, g));
      const double  weight = borne.summary["weight"]["force"]["value"].get<double>() * span / length,
                   by_load = figure_of(borne, "work_of_load"), rilem = figure_of(borne, "work_of_fracture"),
                   of_weight = weight * figure_of(borne, "deflection") / (width * (depth - notch));
      INFO("g " << g << ": without weight " << whole << ", by the load " << by_load << ", with its weight " << rilem);
      CHECK(std::fabs(figure_of(borne, "load_left")) < 0.02);
      CHECK(rilem == Approx(by_load + of_weight).epsilon(1e-9));
      // The load lacks more than the rule is off by.
      CHECK(by_load < whole * (1 - 0.0016 * g));
      CHECK(std::fabs(rilem - whole) < 0.6 * (whole - by_load));
      CHECK(rilem == Approx(whole).epsilon(bound));
      // What it is off by is the rest of the curve: by the rule as much as the weight has done, here of a ligament of few bonds.
      const double done = 0.5 * of_weight * (1 - std::pow(length / span - 1, 2));
      CHECK(by_load + done + work_left(bare, 0.5 * weight) == Approx(whole).epsilon(0.005));
      // The weight works, and the balance knows it.
      CHECK(borne.series.column("energy_weight").back() / (width * (depth - notch)) == Approx(done).epsilon(0.05));
      CHECK(borne.summary["energy"]["balance_error"] < 0.002);
      CHECK(borne.summary["weight"]["dissipated"]["value"] == 0);
    }
}

TEST_CASE("Elements that become particles hand their weight on", "[apps][structure][weight][promotion][volume][slow]")
{
  const BeamFiles                beam = notched();
  const std::vector<std::string> once = heavy_test({"Path/End=1e-6"});
  std::vector<std::string>       half = once;
  for (const char *more : {"Handshakes/core/Low=-4e-3, -1, -1", "Handshakes/core/High=4e-3, 1, 1",
                           "Handshakes/core/Promotion reach=4e-3", "Handshakes/core/Promote at=1e-9"})
    half.push_back(more);
  const Results grown = beam.run(half), whole = beam.run(once);
  CHECK(grown.summary["handshakes"]["core"]["promoted"] == 12);
  CHECK(grown.summary["weight"]["force"]["value"].get<double>() ==
        Approx(whole.summary["weight"]["force"]["value"].get<double>()).epsilon(1e-9));
  for (const Results *one : {&grown, &whole})
    {
      double borne = 0;
      for (const char *column : {"reaction_load_y", "reaction_left_y", "reaction_right_y"})
        borne += one->series.column(column).back();
      CHECK(borne == Approx(whole.summary["weight"]["force"]["value"].get<double>()).epsilon(1e-7));
    }
  // The load factor was held meanwhile, so that the load of both differs; under the same load they are alike.
  const auto  &load = whole.series.column("reaction_load_y");
  const double part = grown.series.column("reaction_load_y").back() / load.back();
  REQUIRE(std::fabs(load.front()) < 1e-6 * std::fabs(load.back()));
  for (const char *column : {"reaction_left_y", "opening"})
    {
      const auto &values = whole.series.column(column);
      CHECK(grown.series.column(column).back() ==
            Approx(values.front() + part * (values.back() - values.front())).epsilon(1e-6));
    }
  CHECK(std::fabs(grown.series.column("energy_residual").back()) < 1e-6 * grown.series.column("energy_work").back());
}

TEST_CASE("An interrupted or killed path of a beam that bears its weight goes on to the same bits",
          "[apps][structure][weight][volume][slow][S13]")
{
  const BeamFiles          beam  = notched();
  std::vector<std::string> words = {"run", beam.scene};
  for (const std::string &change :
       heavy_test({"Output/Checkpoint interval=0.001", "Output/Points per snapshot=5", "Path/End=3e-5"}))
    words.insert(words.end(), {"-s", change});
  goes_on_to_the_same_bits(beam.folder, {words, {"solid/solid_000002.vtu", "checkpoint.h5"}, kept_of_structure},
                           {SIGINT, SIGKILL});
}

TEST_CASE("A weight that a structure cannot have is refused by name", "[apps][structure][weight][volume][slow]")
{
  const BeamFiles beam    = notched();
  const auto      refused = [&](const std::vector<std::string> &changes, const char *words) {
    is_refused(beam.folder, beam.scene, changes, words);
  };
  refused({"Gravity/Acceleration=0, -10, 0"}, "Density");
  refused(heavy(), "Length");
  refused(heavy_test({"Gravity/Acceleration=0, 0, -10"}), "in two dimensions");
  refused(heavy_test({"Bending test/Length=0.1"}), "must not be below Span");
  refused({"Path/Opening=opning", "Path/Opening step=1e-7", "Path/End opening=1e-6"}, "Did you mean");
  refused({"Path/Opening=opening", "Path/Opening step=1e-6", "Path/End opening=1e-7"}, "must not be above End opening");
  // Upright the beam is held by what drives it alone; with ten thousand times its weight it breaks before all of it is on.
  refused(heavy_test({"Continuum/Supports/left/Displacement y=", "Continuum/Supports/right/Displacement y="}),
          "nothing holds the structure against its weight");
  const Outcome broken = outcome_of(beam.folder, "run", beam.scene, heavy_test({}, 3e4));
  CHECK(broken.status != 0);
  CHECK_THAT(broken.out + broken.err, Contains("does not bear its weight"));
}

TEST_CASE("A beam led by the opening of its notch opens in equal steps, and bears what it does led by its deflection",
          "[apps][structure][opening][volume][slow]")
{
  const BeamFiles  beam = notched();
  constexpr double step = 1e-7;
  const Results    led  = beam.run({"Path/Opening=opening", "Path/Opening step=1e-7", "Path/End opening=1e-5"}),
                driven  = beam.run({"Path/End=1e-4", "Path/Stop fraction=0.9"});
  const auto &opening = led.series.column("opening"), &load = led.series.column("reaction_load_y"),
             &factor = led.series.column("load_factor");
  REQUIRE(opening.size() >= 100);
  for (std::size_t row = 0; row < opening.size(); ++row)
    CHECK(opening[row] == Approx(step * static_cast<double>(row + 1)).epsilon(1e-6));
  CHECK(led.summary["points"]["leading"] == opening.size());
  // Both curves, the one between points of the other.
  const double peak = peak_load(driven, "reaction_load_y");
  const auto  &x = driven.series.column("load_factor"), &y = driven.series.column("reaction_load_y");
  std::size_t  compared = 0;
  for (std::size_t row = 0; row < factor.size() && -load[row] < 0.98 * peak; ++row)
    {
      const auto after = std::lower_bound(x.begin(), x.end(), factor[row]);
      if (after == x.end())
        break;
      if (after == x.begin())
        continue;
      const auto   k    = static_cast<std::size_t>(after - x.begin());
      const double part = (factor[row] - x[k - 1]) / (x[k] - x[k - 1]);
      CHECK(load[row] == Approx(y[k - 1] + part * (y[k] - y[k - 1])).margin(0.002 * peak));
      ++compared;
    }
  CHECK(compared > 10);
}

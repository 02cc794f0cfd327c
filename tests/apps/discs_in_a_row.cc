// What bonds and contacts do between several bodies, through `run`: the exact answers T7, T9 and T10 of doc/theory (T8: homogenise.cc).
#include "tests/apps/scene_runs.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace apps_tests;

namespace
{
  constexpr double R = 1e-3, modulus = 10e9;

  /** Discs of 1 mm radius and 1 m thickness, each touching the next along x, in groups of the first and the last. */
  std::string row_of_discs(const std::string &law, const std::string &constants)
  {
    return fmt::format(R"(set Kind = particles
subsection Physics
  set Dimension = 2
end
subsection Specimen
  set Source            = file
  set File              = row.txt
  set Density           = 2500
  set Thickness         = 1
  set Interaction ratio = 1.05
end
subsection Material
  set Law = {0}
  subsection {0}
    set Effective modulus = 1e10
{1}  end
end
subsection Groups
  subsection root
    set Members   = layer
    set Axis      = x
    set Side      = low
    set Thickness = 1e-4
  end
  subsection tip
    set Members   = layer
    set Axis      = x
    set Side      = high
    set Thickness = 1e-4
  end
end
)",
                       law, constants);
  }

  const std::string held_root = R"(subsection Motion
  subsection root
    set Velocity x = 0
    set Velocity y = 0
    set Spin z     = 0
  end
end
)";

  std::string row_packing(const int discs)
  {
    std::string text;
    for (int i = 0; i < discs; ++i)
      text += fmt::format("{} 0 0 {}\n", 2 * R * i, R);
    return text;
  }

  constexpr int    bonds_of_row = 10;
  constexpr double second       = 2.0 / 3 * R * R * R; // of 1 m thickness

  /** Ten bonds bent by a force at the tip, which comes on without a jolt, and brought to rest. */
  Results
  bent_row(const ScratchFolder &folder, const std::string &law, const std::string &constants, const double force)
  {
    folder.file("row.txt", row_packing(bonds_of_row + 1));
    folder.file("x.prm",
                row_of_discs(law, constants) + held_root +
                  fmt::format("subsection Forces\n  subsection tip\n    set Force y = {} * (t < 0.02 ? 0.5*(1 - "
                              "cos(pi*t/0.02)) : 1)\n  end\nend\n",
                              force) +
                  R"(subsection Probes
  subsection deflection
    set Quantity  = displacement
    set Group     = tip
    set Component = y
  end
  subsection unbalanced
    set Quantity = unbalanced ratio
  end
end
subsection Time
  set End time = 0.05
  set Damping  = 0.5
end
subsection Output
  set Snapshots = 0
end
)");
    return results_of(folder, "x.prm");
  }
} // namespace

TEST_CASE("A row of bonded discs that is run under a tip force deflects as its bonds in a row (T7)",
          "[apps][laws][slow]")
{
  const double force = 1, n = bonds_of_row, shear = modulus / 2.5, bending = modulus / (2 * R) * second;
  const double deflection = force * n / shear + force * 4 * R * R * n * (4 * n * n - 1) / (12 * bending);
  CHECK(deflection == Approx(4.0150e-7).epsilon(1e-4));
  const std::string strong = "    set Stiffness ratio = 2.5\n    set Tensile strength = 1e9\n    set Cohesion = 1e9\n";
  const auto        deflects = [&](const std::string &law, const std::string &more) {
    const ScratchFolder folder;
    const Results       found = bent_row(folder, law, strong + more, force);
    INFO(law << " " << more);
    CHECK(found.figure("unbalanced", "end") < 1e-6);
    CHECK(found.figure("deflection", "end") == Approx(deflection).epsilon(1e-6));
  };
  deflects("parallel-bond", "");
  for (const char *elements : {"1", "2", "4", "7"})
    deflects("flat-joint", fmt::format("    set Elements = {}\n", elements));
}

TEST_CASE("A row of parallel bonds that is run under a tip force breaks at its root at the closed form (T7)",
          "[apps][laws]")
{
  // F (n - 1/2) 2R R/I = strength
  const double strength = 1e6, root = strength * second / ((bonds_of_row - 0.5) * 2 * R * R);
  for (const double part : {0.99, 1.01})
    {
      const ScratchFolder folder;
      const Results       found = bent_row(folder, "parallel-bond",
                                           "    set Stiffness ratio = 2.5\n    set Tensile strength = 1e6\n    set "
                                                 "Cohesion = 1e9\n    set Moment contribution = 1\n",
                                           part * root);
      CHECK(found.summary["figures"]["broken_links"] == (part < 1 ? 0 : 1));
      if (part < 1)
        continue;
      const auto broke = postprocess::read_csv_table(folder / "results/breaks.csv", true, {"mode", "surface"});
      CHECK(broke.column("first").at(0) + broke.column("second").at(0) == 1 + 2); // counted from 1
    }
}

namespace
{
  /** Two discs that touch, the second on its way to the first. */
  Results impact(const double step_factor)
  {
    const ScratchFolder folder;
    folder.file("row.txt", row_packing(2));
    folder.file("x.prm", row_of_discs("linear", "") + R"(subsection Initial velocity
  subsection tip
    set Velocity x = -1e-3
  end
end
subsection Probes
  subsection first
    set Quantity  = velocity
    set Group     = root
    set Component = x
  end
  subsection second
    set Quantity  = velocity
    set Group     = tip
    set Component = x
  end
end
subsection Time
  set End time = 3e-6
  set Damping  = 0
end
subsection Output
  set Samples   = 3000
  set Snapshots = 0
end
)");
    return results_of(folder, "x.prm", {fmt::format("Time/Step factor={:.17g}", step_factor)});
  }
} // namespace

TEST_CASE("Two discs that are run into each other part after pi sqrt(m_eff/k_n), their velocities exchanged (T9)",
          "[apps][laws]")
{
  const double mass = 2500 * M_PI * R * R, rate = std::sqrt(2 * modulus / mass), duration = M_PI / rate;
  const double stable        = impact(0.01).summary["cost"]["time_step"].get<double>() / 0.01;
  const auto   energy_change = [&](const double wanted) {
    const Results found = impact(wanted / stable);
    const double  step  = found.summary["cost"]["time_step"].get<double>();
    REQUIRE(step == Approx(wanted).epsilon(1e-9));
    const auto &contacts = found.series.column("contacts"), &time = found.series.column("time");
    const auto  parted = std::find(contacts.begin() + 2, contacts.end(), 0.0);
    REQUIRE(parted != contacts.end());
    CHECK(time[parted - contacts.begin()] == Approx(duration).margin(2 * step));
    const double one = found.figure("first", "end"), other = found.figure("second", "end");
    CHECK(one + other == Approx(-1e-3).epsilon(1e-12)); // momentum
    const double change = (one * one + other * other) / 1e-6 - 1;
    CHECK(found.balance_error() == Approx(std::fabs(change)).margin(1e-7));
    return change;
  };
  for (const double steps : {100, 200})
    {
      // Steps that divide the contact as they resolve it lose nothing; others gain where the discs part within one, at most so much
      // of the half of the energy that is of their approach (doc/theory/linear-contact.md, 3).
      CHECK(std::fabs(energy_change(2 * std::sin(M_PI / 2 / steps) / rate)) < 1e-6);
      const double largest = 0.5 * 0.25 * std::pow(M_PI / steps, 2);
      CHECK(energy_change(duration / steps) < 4e-6);
      CHECK(energy_change(duration / (steps + 0.5)) == Approx(largest).epsilon(0.02));
    }
}

TEST_CASE("A disc on a spring that is run with local damping loses sqrt((1 - D)/(1 + D)) per half swing (T10)",
          "[apps][laws]")
{
  const ScratchFolder folder;
  folder.file("row.txt", row_packing(2));
  const double mass = 2500 * M_PI * R * R, spring = modulus / 2.5, period = 2 * M_PI * std::sqrt(mass / spring);
  // Across: the same stiffness both ways.
  folder.file("x.prm",
              row_of_discs("parallel-bond", "    set Stiffness ratio = 2.5\n    set Tensile strength = 1e12\n    "
                                            "set Cohesion = 1e12\n") +
                R"(subsection Motion
  subsection root
    set Velocity x = 0
    set Velocity y = 0
  end
end
subsection Initial velocity
  subsection tip
    set Velocity y = 1e-3
  end
end
subsection Probes
  subsection swing
    set Quantity  = displacement
    set Group     = tip
    set Component = y
  end
end
subsection Time
  set Damping     = 0.7
  set Step factor = 0.01
end
subsection Output
  set Samples   = 2000
  set Snapshots = 0
end
)");
  const Results found =
    results_of(folder, "x.prm", {"Physics/Rotations=false", fmt::format("Time/End time={}", 4 * period)});
  const auto &swing = found.series.column("swing");
  REQUIRE(found.summary["cost"]["time_step"].get<double>() < period / 500);
  std::vector<double> extremes;
  for (std::size_t row = 1; row + 1 < swing.size(); ++row)
    if ((swing[row] - swing[row - 1]) * (swing[row + 1] - swing[row]) < 0)
      extremes.push_back(std::fabs(swing[row]));
  REQUIRE(extremes.size() >= 6);
  for (std::size_t i = 1; i < 6; ++i)
    CHECK(extremes[i] / extremes[i - 1] == Approx(std::sqrt(0.3 / 1.7)).epsilon(0.01));
}

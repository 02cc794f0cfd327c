// The shipped coupled scenes against closed forms and published values, through the program.
#include "tests/verification/scene_results.h"

#include <algorithm>
#include <cmath>

TEST_CASE("Impact on a block tends to Hertz's as elements get smaller", "[verification][coupled][slow]")
{
  // Smallest elements 0.62, 0.28 and 0.13 mm; radius of the contact 0.48 mm. Johnson (1985), 4.2 and 11.4.
  const double size[] = {0.625e-3, 0.281e-3, 0.127e-3};
  double       force[3], time[3];
  for (const int level : {0, 1, 2})
    {
      const std::string  divisions = std::to_string(14 + 3 * level);
      const SceneResults found     = results_of("hertz_impact", {"Continuum/Mesh/Box/Divisions x=" + divisions,
                                                                 "Continuum/Mesh/Box/Divisions y=" + divisions,
                                                                 "Continuum/Mesh/Box/Divisions z=" + divisions});
      force[level]                 = std::fabs(found.summary["figures"]["peak_force"]["relative_error"].get<double>());
      time[level] = std::fabs(found.summary["figures"]["contact_time"]["relative_error"].get<double>());
      CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
    }
  INFO("errors of the force " << force[0] << ", " << force[1] << ", " << force[2] << ", of the time " << time[0] << ", "
                              << time[1] << ", " << time[2]);
  CHECK(force[2] < 0.02);
  CHECK(time[2] < 0.02);
  CHECK(std::log(force[0] / force[2]) / std::log(size[0] / size[2]) > 0.8);
  CHECK(std::log(time[0] / time[2]) / std::log(size[0] / size[2]) > 0.8);
  CHECK(force[1] < force[0]);
  CHECK(time[1] < time[0]);
  CHECK(time[2] < time[1]);
}

TEST_CASE("Spheres thrown at a cantilever: the published example's momentum, energy and first contact",
          "[verification][coupled]")
{
  // J. Stransky (2018), example surf1.
  const SceneResults found  = results_of("beam_and_spheres");
  const auto        &series = found.series;
  CHECK(series.column("momentum_x").front() == Approx(8338.44).epsilon(1e-6));
  CHECK(series.column("momentum_y").front() == Approx(6948.70).epsilon(1e-6));
  CHECK(series.column("momentum_z").front() == Approx(0).margin(1e-9));
  CHECK(series.column("energy_particles_kinetic").front() == Approx(25015.3 + 17371.8).epsilon(1e-5));
  CHECK(found.summary["figures"]["first_contact"]["value"].get<double>() == Approx(0.0867).epsilon(0.03));
  const double start = series.column("energy_particles_initial").front();
  for (const double missing : series.column("energy_residual"))
    REQUIRE(std::fabs(missing) < 2e-3 * start);    // 1 % is required
  CHECK(series.column("first_speed").back() < -1); // it went through the column, and flew on
  const auto &second = series.column("second_speed"), &tip = series.column("displacement_tip_x");
  const auto  met =
    std::find_if(second.begin(), second.end(), [](const double v) { return v < 4.999; }) - second.begin();
  CHECK(tip[static_cast<std::size_t>(met)] > 0.02); // the gap between its track and the column as it stands
  CHECK(*std::max_element(tip.begin(), tip.end()) > 1);
  CHECK(std::fabs(found.summary["energy"]["spurious_of_couplings"]["beam"].get<double>()) < 1e-10 * start);
}

namespace
{
  const std::vector<std::string> smooth = {"Couplings/lower/Friction coefficient=0",
                                           "Couplings/upper/Friction coefficient=0"};

  std::vector<std::string> with(std::vector<std::string> changes, const std::vector<std::string> &more)
  {
    changes.insert(changes.end(), more.begin(), more.end());
    return changes;
  }

  /** The cube of crushed_cube.prm between grips that leave it free sideways, in compression to the strain. */
  SceneResults between_grips(const std::string &strain, const std::vector<std::string> &changes)
  {
    // own_packing.prm has the same law. Centres of a layer at the mould lie within micrometres.
    return results_of("own_packing",
                      with({"Specimen/File=" + places::sources() + "/meshes/moulded_cube.h5", "Specimen/Density=4240",
                            "Time/Step factor=0.8", "Time/Damping=0.3", "Loading/Grip thickness=0.0003",
                            "Loading/Grip lateral motion blocked=false", "Loading/Area=0.010072",
                            "Loading/Gauge length=outermost centres", "Loading/Compression/Strain rate=1.2",
                            "Loading/Compression/Stop strain=" + strain},
                           changes));
  }

  /** Least-squares slope of y over x of the rows in which x lies in the range. */
  double slope(const std::vector<double> &x, const std::vector<double> &y, const double from, const double to)
  {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] >= from && x[i] <= to)
        {
          n += 1;
          sx += x[i];
          sy += y[i];
          sxx += x[i] * x[i];
          sxy += x[i] * y[i];
        }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
} // namespace

TEST_CASE("A cube between smooth platens is as stiff as the cube alone and its contacts in series",
          "[verification][coupled][slow]")
{
  const std::vector<std::string> elastic = {"Limit elastic strain=1 -", "Cohesion=1e12"};
  const auto                     law_at  = [&](const std::string &section) {
    std::vector<std::string> changes;
    for (const std::string &entry : elastic)
      changes.push_back(section + "/" + entry);
    return changes;
  };
  const SceneResults press =
    results_of("crushed_cube", with(with(smooth, law_at("Particles/Material/CPM")), {"Time/End time=1.2e-3"}));
  const SceneResults alone   = between_grips("1e-3", law_at("Material/CPM"));
  const double       modulus = slope(alone.series.column("strain"), alone.series.column("stress"), -0.9e-3, -0.3e-3);
  const double       stiffness =
    slope(press.series.column("strain"), press.series.column("stress"), 0.3e-3, press.series.column("strain").back());

  // Between the layers at the faces, 100.374 mm less twice the radius of 3 mm, the cube itself; then n contacts of pi r E* at either end.
  const double contacts =
    0.5 * (press.series.column("lower_contacts").back() + press.series.column("upper_contacts").back());
  const double of_contact = 3.14159265358979 * 3e-3 * 25e9, area = 0.010072;
  const double compliance = 94.374e-3 / modulus + 2 * area / (contacts * of_contact);
  CHECK(contacts > 150); // a whole layer stands on the platen
  CHECK(stiffness == Approx(100.374e-3 / compliance).epsilon(0.03));
}

TEST_CASE("Rough platens raise the strength of a cube, smooth ones find the strength that it has between grips",
          "[verification][coupled][slow]")
{
  const std::vector<std::string> short_run = {"Time/End time=2.8e-3"};
  const SceneResults             rough     = results_of("crushed_cube", short_run);
  const SceneResults             slippery  = results_of("crushed_cube", with(smooth, short_run));
  const SceneResults             alone     = between_grips("5e-3", {});
  const auto                     strength  = [](const SceneResults &of) {
    return *std::max_element(of.series.column("stress").begin(), of.series.column("stress").end());
  };
  CHECK(slippery.figure("compressive_strength") == Approx(alone.figure("compressive_strength")).epsilon(0.1));
  CHECK(strength(rough) > 1.15 * slippery.figure("compressive_strength")); // not past its peak for good yet
  for (const SceneResults *run : {&rough, &slippery})
    {
      CHECK(run->summary["energy"]["balance_error"].get<double>() < 1e-3);
      for (const char *made : {"lower", "upper"})
        CHECK(std::fabs(run->summary["energy"]["spurious_of_couplings"][made].get<double>()) < 1e-6);
      // Friction holds the faces sideways: without it nothing is there but the push.
      const auto &series  = run->series;
      const auto  middle  = series.rows() / 2;
      const auto  working = series.column("energy_particles_external_work")[middle];
      CHECK(series.column("energy_particles_kinetic")[middle] < 0.02 * working); // quasi-static
    }
  CHECK(slippery.summary["figures"]["lower_force_x"]["largest"]["value"].get<double>() < 100);
}

TEST_CASE("Supports and weight give the momentum that ball, beam and supports change by, and the account closes",
          "[verification][coupled][slow]")
{
  // Every row is a step: sums of forces times the step are then impulses. The ball's own force is all that changes its velocity.
  const SceneResults found =
    results_of("drop_weight", {"Gravity/Acceleration=0, 0, 0", "Time/End time=6e-4", "Output/Samples=1200"});
  const auto &series = found.series;
  const auto &time = series.column("time"), &velocity = series.column("weight_velocity"),
             &momentum  = series.column("momentum_z");
  const double ball     = 7850 * 4.0 / 3 * 3.14159265358979 * std::pow(0.04, 3);
  double       supports = 0, on_ball = 0;
  for (std::size_t row = 1; row < time.size(); ++row)
    {
      const double step = time[row] - time[row - 1];
      supports += step * (series.column("reaction_left_back_z")[row] + series.column("reaction_right_back_z")[row]);
      on_ball += step * series.column("weight_force")[row];
    }
  REQUIRE(supports > 0.05 * ball * 1.5); // the blow has gone through the beam
  CHECK(momentum.front() == Approx(-1.5 * ball).epsilon(1e-9));
  CHECK(ball * (velocity.back() - velocity.front()) == Approx(on_ball).epsilon(0.01));
  CHECK(momentum.back() - momentum.front() == Approx(supports).epsilon(0.01));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
}

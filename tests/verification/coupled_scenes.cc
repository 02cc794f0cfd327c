// The shipped coupled scenes against closed forms and published values, through the program.
#include "tests/verification/scene_results.h"

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
  CHECK(found.summary["figures"]["first_contact"]["value"].get<double>() == Approx(0.0867).epsilon(0.02));
  const double start = series.column("energy_particles_initial").front();
  CHECK(std::fabs(series.column("energy_residual").back()) < 0.01 * start);
  CHECK(std::fabs(found.summary["energy"]["made_by_couplings"]["beam"].get<double>()) < 1e-10 * start);
}

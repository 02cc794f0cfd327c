// The shipped continuum scenes against closed forms, through the program.
#include "tests/verification/scene_results.h"

#include <cmath>

namespace
{
  /** Area under the load over the deflection of a beam, by trapezes [J]. */
  double area_under(const SceneResults &beam)
  {
    const auto &load = beam.series.column("reaction_load_y"), &deflection = beam.series.column("load_factor");
    double      area = 0.5 * load[0] * -deflection[0];
    for (std::size_t i = 1; i < load.size(); ++i)
      area += 0.5 * (load[i] + load[i - 1]) * -(deflection[i] - deflection[i - 1]);
    return area;
  }

  constexpr double fracture_energy = 100, ligament = (0.1 - 0.1 / 3) * 0.1; // [J/m^2], [m^2] of the shipped beams

  /** What must hold of a beam whose mouth was opened by far more than the softening needs. */
  void check_beam(const SceneResults &beam, const char *left_lip, const char *right_lip)
  {
    const double area = area_under(beam), dissipated = beam.figure("dissipated_energy");
    // The area under the curve is the work of the load: trapezes over the same steps, so to the solver's tolerance.
    CHECK(area == Approx(beam.summary["energy"]["external"].get<double>()).epsilon(1e-6));
    // The materials keep an account of their own, of which these steps count the work to a few percent.
    CHECK(area == Approx(dissipated + beam.summary["energy"]["stored"].get<double>()).epsilon(0.03));
    CHECK(beam.summary["energy"]["balance_error"].get<double>() < 0.03);
    CHECK(beam.summary["warnings"].empty());
    // Past the peak far enough: less than a fiftieth of the load is left.
    const auto &load = beam.series.column("reaction_load_y");
    CHECK(std::fabs(load.back()) < 0.03 * std::fabs(beam.figure("peak_reaction_load_y")));
    // Both supports carry half.
    const auto &left  = beam.series.column("reaction_left_support_y"),
               &right = beam.series.column("reaction_right_support_y");
    const auto &a = beam.series.column(left_lip), &b = beam.series.column(right_lip);
    double      peak = 0, opening = 0, worst_load = 0, worst_lips = 0;
    for (std::size_t i = 0; i < load.size(); ++i)
      {
        peak       = std::max(peak, std::fabs(load[i]));
        opening    = std::max(opening, std::fabs(a[i]));
        worst_load = std::max(worst_load, std::fabs(left[i] - right[i]));
        worst_lips = std::max(worst_lips, std::fabs(a[i] + b[i]));
      }
    CHECK(worst_load < 1e-8 * peak);
    CHECK(worst_lips < 1e-8 * opening);
  }
} // namespace

TEST_CASE("The cantilever under its own weight sags as Timoshenko's beam", "[verification][slow]")
{
  const SceneResults quadratic = results_of("cantilever");
  // Timoshenko: -1.4818e-3 m; the clamp of a solid differs from a beam's by a few 1e-4 of that.
  CHECK(quadratic.figure("final_displacement_end_y") == Approx(-1.4818e-3).epsilon(3e-4));
  CHECK(quadratic.figure("peak_reaction_left_y") == Approx(2500 * 9.8 * 0.2 * 0.02 * 0.02).epsilon(1e-8));
  // Linear elements lock in bending: too stiff, and better on a finer mesh.
  const double coarse = results_of("cantilever", {"Model/Element order=1"}).figure("final_displacement_end_y");
  const double fine =
    results_of("cantilever", {"Model/Element order=1", "Mesh/Refinements=1"}).figure("final_displacement_end_y");
  CHECK(coarse > fine);
  CHECK(fine > -1.4818e-3);
  CHECK(fine == Approx(-1.4818e-3).epsilon(0.02));
}

TEST_CASE("Notched beam in the plane: symmetric, work of fracture under the curve, and little dependence on the mesh",
          "[verification][slow]")
{
  const std::vector<std::string> far    = {"Control/End=1.2e-3", "Control/Largest step=1.5e-5"};
  const SceneResults             coarse = results_of("notched_beam", far);
  check_beam(coarse, "displacement_left_lip_x", "displacement_right_lip_x");
  std::vector<std::string> finer = far;
  finer.insert(finer.end(), {"Mesh/Notched beam/Fine size=0.0034", "Mesh/Notched beam/Band=0.025"});
  finer.insert(finer.end(), {"Mesh/Notched beam/Notch width=0.0034", "Supports/load/From=0.2233, 0.1, 0",
                             "Supports/load/To=0.2267, 0.1, 0", "Points/left lip/Position=0.2233, 0, 0",
                             "Points/right lip/Position=0.2267, 0, 0"});
  const SceneResults fine = results_of("notched_beam", finer);
  // Work over ligament: below G_f, because the top of the ligament, pressed by the load, never opens; the same on both meshes.
  const double work[2] = {coarse.figure("dissipated_energy") / ligament, fine.figure("dissipated_energy") / ligament};
  CAPTURE(work[0], work[1]);
  for (const double w : work)
    {
      CHECK(w > 0.75 * fracture_energy);
      CHECK(w < fracture_energy);
    }
  CHECK(work[0] == Approx(work[1]).epsilon(0.03));
  CHECK(coarse.figure("peak_reaction_load_y") == Approx(fine.figure("peak_reaction_load_y")).epsilon(0.05));
}

TEST_CASE("Notched beam in space: symmetric, and work of fracture under the curve", "[verification][slow]")
{
  const SceneResults beam = results_of("notched_beam_3d", {"Control/End=1.2e-3", "Control/Largest step=2e-5"});
  check_beam(beam, "displacement_left_lip_x", "displacement_right_lip_x");
  const double work = beam.figure("dissipated_energy") / ligament;
  CAPTURE(work);
  CHECK(work > 0.75 * fracture_energy);
  CHECK(work < fracture_energy);
}

#include "apps/validation/scene_references.h"

#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/validation/shipped_scene.h"
#include "postprocess/files/scratch_folder.h"

#include <cmath>
#include <limits>
#include <string>

namespace apps
{
  namespace
  {
    using base::Comparisons;

    /** A shipped scene, without any file of results. */
    RunResult result_of(const std::string &name, std::vector<std::string> changes = {})
    {
      const postprocess::ScratchFolder folder("validation");
      folder.write(name + ".prm", shipped_scene(name));
      changes.emplace_back("Output/Snapshots=0");
      const CheckedScene scene   = read_scene((folder / (name + ".prm")).string(), changes);
      RunRequest         request = request_of(scene);
      request.output_folder.clear();
      return scene.scene->run(request);
    }

    double figure_of(const RunResult &result, const std::string &name)
    {
      return result.figure(name).value.value_or(std::numeric_limits<double>::quiet_NaN());
    }

    void widened_hole(Comparisons &rows)
    {
      for (const std::string elements : {"blocks", "simplices"})
        {
          const RunResult plate = result_of("plate_with_hole", {"Mesh/Elements=" + elements});
          // (a s/E)(1 + 2 cos 2 theta). The plate is 30 radii wide, not infinite: (a/W)^2 = 1e-3; the hole is a polygon: 2e-4.
          rows.of("side of the hole, " + elements, "m", figure_of(plate, "final_displacement_side_of_hole_x"))
            .within(5e-3, 3 * 0.01 * 3e6 / 30e9);
          rows.of("its top, " + elements, "m", figure_of(plate, "final_displacement_top_of_hole_y"))
            .within(1e-2, -0.01 * 3e6 / 30e9);
          rows.of("load, " + elements, "N", figure_of(plate, "peak_load_x")).within(1e-10, 3e6 * 0.3);
        }
    }

    void bar_on_wall(Comparisons &rows)
    {
      const RunResult bar = result_of("bar_impact");
      const double    c = std::sqrt(200e9 / 7850), there_and_back = 2 * 0.5 / c;
      const auto     &time = bar.series.column("time"), &wall = bar.series.column("reaction_left_x");
      double          sum = 0, count = 0, turned = 0;
      for (std::size_t i = 0; i < time.size(); ++i)
        {
          if (time[i] < 0.9 * there_and_back)
            {
              sum += wall[i];
              ++count;
            }
          if (turned == 0 && wall[i] < 0)
            turned = time[i];
        }
      // The section of the mesh is a polygon with the area of the circle. A front is an element long, on either end of the mean.
      rows.of("force at the wall, rho c v A", "N", sum / count).within(0.02, 7850 * c * 10 * M_PI * 1e-4);
      // Bars carry short waves more slowly (Pochhammer).
      rows.of("time until it lets go, 2 L/c", "s", turned).within(0.03, there_and_back);
      rows.of("energy that is lost, of the largest", "", bar.balance_error().value_or(1)).within_margin(1e-10, 0);
    }
  } // namespace

  const std::vector<base::Reference> &scene_references()
  {
    static const std::vector<base::Reference> all = {
      {"scene plate_with_hole: the hole widens and narrows", "Kirsch (1898), closed form", widened_hole},
      {"scene bar_impact: wave in a bar that meets a wall", "closed form of a thin bar", bar_on_wall}};
    return all;
  }
} // namespace apps

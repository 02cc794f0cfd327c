#include "apps/runs/transmission/run.h"

#include "apps/process/mpi_session.h"
#include "apps/process/version.h"
#include "apps/results/short_run.h"
#include "apps/results/warning.h"
#include "apps/runs/transmission/report.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  RunResult run(const TransmissionModel &model, const RunRequest &request)
  {
    ShortRun run(request, "a packet of waves");
    start_mpi();
    std::vector<WavePoint> points;
    for (const coupling::WaveMethod &method : model.chosen())
      for (const double length : model.wavelengths)
        {
          if (run.interrupted())
            return run.interrupted_result();
          points.push_back({method.name, length, coupling::transmit(model.wave(method, length))});
          const coupling::WaveAnswer &a = points.back().answer;
          run.says(fmt::format("{:14} wavelength {:<10.4g} m: reflected {:.4f}, transmitted {:.4f}, absorbed {:.4f}\n",
                               method.name, length, a.reflected, a.transmitted, a.absorbed));
        }
    nlohmann::json json;
    json["made_by"] = "breccia " + version();
    json["waves"]   = json_of_waves(points);
    json["figures"] = figures_of_waves(points);

    return run.complete(std::move(json), [&](const std::filesystem::path &folder) {
      postprocess::write_text(folder / "reflection.csv", csv_of_waves(points));
      warn_of_missing("reflection.png",
                      postprocess::plot(folder / "reflection.png", wave_panels(points, model.common)));
    });
  }
} // namespace apps

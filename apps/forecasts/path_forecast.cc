#include "apps/forecasts/path_forecast.h"

#include "apps/figures/link_failure.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace apps
{
  double expected_path_seconds(const dem::LoadedNetwork         &loaded,
                               const dem::LinkMaterials         &materials,
                               const dem::QuasiStaticParameters &parameters)
  {
    constexpr double enough = 0.5, solutions_when_cracking = 6, rounds_of_cracks = 4;
    dem::Physics     physics;
    physics.dimension         = loaded.network.dimension;
    const LinkFailure failure = failure_in_tension(*materials.bonds_in_space(physics));
    // Of a link's damaging strain until it carries nothing.
    const double          growth = failure.softening > 0 ? std::log(5 * failure.softening / failure.onset) : 0.0;
    const base::Stopwatch watch;
    dem::QuasiStaticPath  path(loaded, materials, parameters);
    std::int64_t          solutions = 0;
    while (!path.finished() && (solutions < 2 || watch.seconds() < enough))
      solutions += path.advance().iterations;
    const double solution = watch.seconds() / static_cast<double>(std::max<std::int64_t>(1, solutions));
    const double points =
      parameters.end_strain / parameters.strain_step + rounds_of_cracks * growth / std::log1p(parameters.growth_step);
    return points * solutions_when_cracking * solution;
  }
} // namespace apps

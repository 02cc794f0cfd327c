#include "apps/runs/transmission/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  std::string forecast(const TransmissionModel &model)
  {
    start_mpi();
    // The shortest packet decides; cost grows with the square of the length.
    const auto            all      = model.wavelengths;
    const double          shortest = *std::min_element(all.begin(), all.end());
    const base::Stopwatch watch;
    const auto            answer  = coupling::transmit(model.wave(model.chosen().front(), shortest));
    const double          seconds = watch.seconds();
    double                sum     = 0;
    for (const double length : all)
      sum += coupling::wave_cost(model.wave(model.chosen().front(), length)) /
             coupling::wave_cost(model.wave(model.chosen().front(), shortest));
    return fmt::format("  packets      {}, of {} steps of {} particles at least\n", all.size() * model.chosen().size(),
                       answer.steps, answer.particles) +
           duration_line(seconds * sum * static_cast<double>(model.chosen().size()));
  }

} // namespace apps

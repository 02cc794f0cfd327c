#include "apps/runs/uniaxial/forecast.h"

#include "apps/figures/link_failure.h"
#include "apps/forecasts/duration.h"
#include "apps/forecasts/run_forecast.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/runs/uniaxial/lab_test.h"
#include "apps/specimens/material_counts.h"
#include "apps/specimens/packing_extents.h"
#include "apps/specimens/rank_shares.h"
#include "apps/specimens/specimen_snapshots.h"
#include "apps/specimens/static_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    double expected_end(const UniaxialModel &requested, const dem::Packing &packing, const UniaxialLoad load)
    {
      const dem::UniaxialParameters test = requested.loading.parameters(load);
      if (!requested.physics.damage)
        return test.stop_strain;
      return std::min(
        test.stop_strain,
        strain_of_failure(*requested.mixed().materials(packing.material_names).bonds_in_space(requested.physics),
                          packing, test));
    }

    /** Rows and snapshots of a test that goes to its stop strain. */
    double writing_seconds_of_test(const dem::ObservedSpecimen &body, const OutputSection &output)
    {
      const double row      = seconds_of([&] {
        body.energy();
        body.mean_damage();
      });
      const double snapshot = output.snapshots == 0 ? 0.0 : seconds_to_write([&](const std::filesystem::path &folder) {
        SpecimenSnapshots taken;
        taken.open(folder, "test", output.pieces);
        taken.take(body);
      });
      return static_cast<double>(output.samples) * row +
             static_cast<double>(std::min(output.snapshots, output.samples)) * snapshot;
    }

    /** Of a large specimen it would take longer, and more memory, than all else. */
    std::string line_of_critical_step(const dem::ObservedSpecimen &body)
    {
      constexpr std::size_t most = 200'000;
      if (body.counts().particles > most)
        return fmt::format("               the sharp bound is sought of at most {} particles\n", most);
      return fmt::format("               {:.4g} s would be critical: sharp, by the largest eigenvalue\n",
                         body.critical_step());
    }

    std::string megabytes(const std::size_t bytes)
    {
      return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
    }
  } // namespace

  std::string forecast(const UniaxialModel &requested, const std::size_t ranks)
  {
    const base::Stopwatch set_up;
    const dem::Packing    uncut     = requested.packing();
    const JointedPacking  jointed   = requested.jointed(uncut);
    const dem::Packing   &packing   = jointed.packing();
    const auto            materials = jointed.materials(requested.mixed().materials(packing.material_names));
    dem::Specimen         body(packing, requested.specimen(), materials);
    const double          set_up_seconds = set_up.seconds();
    std::string           text;
    text += fmt::format("  particles    {}\n", body.counts().particles);
    text += fmt::format("  links        {}\n", body.counts().links);
    text += extent_lines(packing, requested.physics.dimension);
    text += lines_of_tension_beyond_apex(requested.material);
    text += MaterialCounts(packing.material_names, body).text();
    text += jointed.text();
    text += fmt::format("  time step    {:.4g} s = {} of the bound of its particles\n", body.time_step(),
                        requested.time.step_factor);
    text += line_of_critical_step(body);
    text += fmt::format("  memory       {} for particles and links\n", megabytes(body.bytes()));
    double steps = 0, expected = 0, parts = 0; // parts of the way to the stop strain, of all tests
    double cost = 0;
    for (const UniaxialLoad load : requested.loading.tests)
      {
        // Refuses what a run would refuse.
        dem::Specimen      fresh(packing, requested.specimen(), materials);
        dem::UniaxialTest  test(fresh, requested.loading.parameters(load));
        const std::int64_t most = most_steps(requested.loading, load, fresh.time_step());
        if (load == requested.loading.tests.front()) // the grips hold alike in all of them
          {
            text +=
              fmt::format("  basis        {}\n", text_of(test.grip_layers(), requested.loading.grips.parameters()));
            if (const StaticStart start = start_statically(fresh, requested.gravity))
              text += fmt::format("  start        {}\n", text_of(*start));
            cost = seconds_per_step(fresh, [&](const std::int64_t count) { test.advance(count); });
          }
        const double part = expected_end(requested, packing, load) / requested.loading.parameters(load).stop_strain;
        steps += static_cast<double>(most);
        expected += static_cast<double>(most) * part;
        parts += part;
        text += fmt::format("  {:<12} at most {} steps\n", name_of(load), most);
      }
    if (ranks > 0)
      text += rank_lines(body, ranks, cost);
    const double writing = writing_seconds_of_test(body, requested.output);
    const double tests   = static_cast<double>(requested.loading.tests.size());
    return text + duration_line(set_up_seconds + expected * cost + parts * writing,
                                set_up_seconds + steps * cost + tests * writing);
  }

} // namespace apps

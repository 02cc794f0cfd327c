#include "apps/specimens/genesis_work.h"

#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "apps/results/warning.h"
#include "apps/specimens/genesis_cache.h"
#include "base/stopwatch.h"
#include "dem/genesis/contact_areas.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/packings/packing_io.h"
#include "postprocess/pictures/packing_picture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  namespace
  {
    constexpr double seconds_at_once = 0.5;
  }

  GenesisWork::GenesisWork(const SpecimenSection &section, const int in_dimension)
    : specimen(section)
    , dimension(in_dimension)
    , parameters(section.genesis.parameters(in_dimension, section.thickness))
    , genesis(parameters, launched_team())
  {
  }

  bool GenesisWork::is_kept() const
  {
    const std::optional<GenesisCache> cache = genesis_cache();
    return cache && cache->has(parameters);
  }

  void GenesisWork::take_kept() { finish_as_kept(genesis_cache(), genesis, parameters); }

  void GenesisWork::advance()
  {
    const base::Stopwatch watch;
    genesis.advance(steps_at_once);
    // Steps of a like piece of time: only where it is cut depends on the clock, nothing of the result.
    const double took = largest_of_ranks(watch.seconds());
    if (took < 0.5 * seconds_at_once)
      steps_at_once *= 2;
    else if (took > 2 * seconds_at_once && steps_at_once > 1)
      steps_at_once /= 2;
    if (!genesis.finished())
      return;
    genesis.gather();
    if (const std::optional<GenesisCache> cache = genesis_cache(); cache && is_first_rank())
      cache->keep(genesis, parameters);
  }

  std::string GenesisWork::details() const { return genesis.details(); }

  dem::Packing GenesisWork::packing() const
  {
    dem::Packing made = genesis.packing();
    specimen.genesis.finish(made);
    return made;
  }

  nlohmann::json GenesisWork::summary(const dem::Packing &packing)
  {
    const auto        bonds  = dem::contact_areas(packing, specimen.installation_gap, dimension, specimen.thickness);
    const auto        energy = genesis.energies();
    const std::size_t n      = packing.size();
    nlohmann::json    all;
    all["particles"]             = n;
    all["inserted_with_overlap"] = genesis.inserted_with_overlap();
    all["aggregates"]            = packing.bodies.size();
    for (const ClassInVessel &one : specimen.genesis.classes_in_vessel(dimension))
      all["sizes"].push_back({{"smallest_m", one.size.smallest},
                              {"largest_m", one.size.largest},
                              {"particles", one.count},
                              {"part_of_solid", one.part},
                              {"part_requested", one.size.fraction}});
    all["bonds"]    = {{"installation_gap_m", specimen.installation_gap},
                       {"count", bonds.pairs},
                       {"per_particle", static_cast<double>(bonds.pairs) / static_cast<double>(n)},
                       {"half_area_m2", bonds.half_area},
                       {"area_m2", bonds.area}};
    all["energy_J"] = {{"growth", energy.growth}, {"stored", energy.stored},     {"kinetic", energy.kinetic},
                       {"damped", energy.damped}, {"friction", energy.friction}, {"stopped", energy.stopped},
                       {"error", energy.error()}};
    for (const dem::GenesisStageReport &r : genesis.reports())
      all["stages"].push_back({{"stage", dem::name_of(r.stage)},
                               {"reached", r.reached},
                               {"steps", r.steps},
                               {"rounds", r.rounds},
                               {"unbalanced_ratio", r.ratio},
                               {"porosity", r.porosity},
                               {"mean_stress_Pa", r.stress},
                               {"floaters", r.floaters},
                               {"contact_number", r.contact_number},
                               {"largest_overlap", r.largest_overlap},
                               {"mean_diameter_change", r.diameter_change},
                               {"scale_of_radii", r.scale}});
    return all;
  }

  void GenesisWork::write(const std::filesystem::path &folder, const dem::Packing &packing)
  {
    std::string table = "stage,reached,steps,rounds,unbalanced_ratio [-],porosity [-],mean_stress [Pa],floaters [-],"
                        "contact_number [-],largest_overlap [-],mean_diameter_change [-],scale_of_radii [-]\n";
    for (const dem::GenesisStageReport &r : genesis.reports())
      table += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", dem::name_of(r.stage), r.reached ? 1 : 0, r.steps,
                           r.rounds, r.ratio, r.porosity, r.stress, r.floaters, r.contact_number, r.largest_overlap,
                           r.diameter_change, r.scale);
    postprocess::write_text(folder / "genesis.csv", table);
    warn_of_missing("genesis.png", postprocess::picture_of_packing(folder / "genesis.png", packing, "Grown packing"));
    postprocess::write_text(folder / "genesis.json", summary(packing).dump(2) + "\n");
    postprocess::write_packing(
      packing, folder / "packing.txt",
      {{"made by", "breccia " + version() + ", genesis"}, {"seed", fmt::format("{}", specimen.genesis.seed)}});
  }

  std::string GenesisWork::text()
  {
    std::string text;
    for (const dem::GenesisStageReport &r : genesis.reports())
      text +=
        fmt::format("{:<13}{}: {} steps, ratio {:.2e}, porosity {:.4f}, stress {:.4g} MPa, floaters {:.2f} %, {:.3f} "
                    "contacts per particle\n",
                    dem::name_of(r.stage), r.reached ? "" : " (not reached)", r.steps, r.ratio, r.porosity,
                    1e-6 * r.stress, 100 * r.floaters, r.contact_number);
    const auto energy = genesis.energies();
    return text + fmt::format("{:<13}{:.4g} J by growth, {:.1e} of it not accounted for\n", "energy", energy.growth,
                              energy.growth > 0 ? energy.error() / energy.growth : 0.0);
  }

  dem::Packing grown_with_progress(const SpecimenSection &specimen, const int dimension)
  {
    Progress    progress("genesis");
    GenesisWork work(specimen, dimension);
    work.take_kept();
    while (!work.finished())
      {
        work.advance();
        progress.update(work.done(), work.details());
        if (interrupted_on_any_rank())
          throw dem::CompactionCancelled();
      }
    return work.packing();
  }
} // namespace apps

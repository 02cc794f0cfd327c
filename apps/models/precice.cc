#include "apps/models/precice.h"

#include "apps/process/mpi_session.h"
#include "base/errors.h"

#include <fmt/format.h>

namespace apps
{
  void PreciceSection::check(const base::EntryPath &root) const
  {
    if (!given())
      return;
    const base::EntryPath section = root.at("preCICE");
    if (!join)
      section.refuse(
        "Participant",
        "this program was built without preCICE. Install preCICE 3, for instance its package for Debian "
        "from https://github.com/precice/precice/releases, and configure the build again: cmake build/release.");
    if (configuration.empty())
      section.refuse("Configuration", "is not given. Name the file that preCICE reads.");
    const coupling::PreciceMesh said{mesh, {0}, reads, writes};
    if (const std::string mistake = said.mistake(); !mistake.empty())
      section.refuse("the mesh " + mistake);
  }

  std::unique_ptr<coupling::PreciceExchange> PreciceSection::couple(coupling::Participant   &body,
                                                                    std::vector<std::size_t> carriers) const
  {
    if (launched_ranks() > 1)
      throw base::InputError(fmt::format("preCICE: a participant is one process, and mpirun has started {}. Start one, "
                                         "and use --threads.",
                                         launched_ranks()));
    return std::make_unique<coupling::PreciceExchange>(
      body, coupling::PreciceMesh{mesh, std::move(carriers), reads, writes},
      [by = join, name = participant, file = configuration] { return by(name, file); });
  }

  std::string PreciceSection::forecast(const std::size_t vertex_count) const
  {
    return fmt::format("  coupling     {} by preCICE, {} vertices of {}; takes as long as the others take\n",
                       participant, vertex_count, mesh);
  }

  std::string PreciceSection::left_early(const coupling::PreciceExchange &exchange, const double end_time) const
  {
    return exchange.is_over() ? "" :
                                fmt::format("preCICE: the run ended at {:g} s, before the coupling: the other "
                                            "participants were left alone. Let it end later.",
                                            end_time);
  }
} // namespace apps

#pragma once

#include "base/entry_path.h"
#include "coupling/precice/exchange.h"
#include "coupling/precice/library.h"

#include <string>

namespace apps
{
  /** Section "preCICE": a body as one side of a coupling with other programs (doc/tutorials/precice.md). */
  struct PreciceSection
  {
    std::string           participant; ///< name of this side; "": nothing is coupled
    std::string           configuration, mesh;
    std::string           vertices; ///< the boundary whose nodes, or the group whose particles they are
    coupling::PreciceData reads, writes;
    coupling::JoinPrecice join =
      coupling::precice_library(); ///< by what the others are met; empty: this was built without

    bool given() const { return !participant.empty(); }

    /** @throws base::InputError. */
    void check(const base::EntryPath &root) const;
    /** @param body with these of its carriers as vertices; must outlive it @throws base::InputError where they are none */
    std::unique_ptr<coupling::PreciceExchange> couple(coupling::Participant   &body,
                                                      std::vector<std::size_t> carriers) const;
    /** A line of a forecast. */
    std::string forecast(std::size_t vertex_count) const;
    /** What a user should doubt about a complete run; "": nothing. */
    std::string left_early(const coupling::PreciceExchange &exchange, double end_time) const;
  };
} // namespace apps

#pragma once

#include "body_state.h"
#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"
#include "dem/specimen/rank_shares.h"
#include "rank_threads.h"

#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

/** How a body goes on, alone and on several ranks. */
namespace shared_bodies
{
  /** What a table of results has of a moment: read without gathering what each rank has. */
  inline std::vector<double> row_of(Body &body)
  {
    std::vector<double> row      = body.reading();
    const auto          energies = energies_of(body.specimen());
    const dem::Counts   n        = body.specimen().counts();
    row.insert(row.end(), energies.begin(), energies.end());
    row.insert(row.end(), {body.specimen().time(), n.deepest_overlap, n.largest_turn, body.specimen().mean_damage()});
    for (const std::size_t count : {n.links, n.contacts, n.broken, n.wall_contacts, body.specimen().logged_breaks()})
      row.push_back(static_cast<double>(count));
    return row;
  }

  using Table = std::vector<std::vector<double>>;

  /** So many steps on, with a row every so many. */
  inline Table go_on(Body &body, const std::int64_t steps, const std::int64_t between_rows)
  {
    Table rows;
    for (std::int64_t done = 0; done < steps; done += between_rows)
      {
        body.advance(between_rows);
        rows.push_back(row_of(body));
      }
    return rows;
  }

  /** Names what of a course is not as it was alone. */
  inline std::string difference_of_rows(const Table &some, const Table &alone)
  {
    if (some.size() != alone.size())
      return " number of rows";
    for (std::size_t r = 0; r < some.size(); ++r)
      if (some[r] != alone[r])
        return " row " + std::to_string(r);
    return "";
  }

  /** Which of so many ranks has a particle, by its packing number, as long as ranges have not been moved. */
  inline std::size_t first_owner_of(const dem::Specimen &specimen, const std::size_t particle, const std::size_t ranks)
  {
    const auto place  = static_cast<std::size_t>(dem::core_of(specimen).slot.at(particle));
    const auto shares = dem::share_out(specimen, ranks);
    return static_cast<std::size_t>(
      std::find_if(shares.begin(), shares.end(), [&](const dem::RankShare &of) { return place < of.end_particle; }) -
      shares.begin());
  }

  /** The packing number of the first particle that one of so many ranks has, likewise. */
  inline std::size_t first_particle_of(const dem::Specimen &specimen, const std::size_t rank, const std::size_t ranks)
  {
    return static_cast<std::size_t>(
      dem::core_of(specimen).particles.number[dem::share_out(specimen, ranks)[rank].first_particle]);
  }
} // namespace shared_bodies

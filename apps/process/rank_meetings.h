#pragma once

#include "apps/process/mpi_session.h"
#include "base/flat_state.h"

#include <cstddef>
#include <functional>
#include <string>

namespace apps
{
  /**
   * Before ranks speak with each other: refuse that one does so alone, within on_first_rank(), where the others would wait for it for ever. With
   * BRECCIA_CHECK_RANKS in the environment besides: compare what each is about to say. @param size of it, as all know it
   * @throws std::logic_error naming what differs, on every rank
   */
  void meet(const char *what, std::size_t size = 0);

  /** Let all ranks have the numbers of the first. */
  void take_from_first_rank(base::Column &numbers);

  /** The same of all that something visits as its state. */
  template <typename Thing>
  void take_state_from_first_rank(Thing &thing)
  {
    if (rank_count() == 1)
      return;
    base::Column          state;
    base::FlatStateWriter writer(state);
    thing.visit_state(writer);
    take_from_first_rank(state);
    base::FlatStateReader reader(state);
    thing.visit_state(reader);
  }

  /** The same of a text. */
  void take_from_first_rank(std::string &text);

  /**
   * Do something on every rank, given its number, that meets no other.
   * @throws what it threw on the first of those where it did, as on_first_rank() does, on every rank
   */
  void on_each_rank(const std::function<void(std::size_t)> &action);
} // namespace apps

#pragma once

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

  /** Let all ranks have a text of the first. */
  void take_from_first_rank(std::string &text);

  /**
   * Do something on every rank, given its number, that meets no other.
   * @throws what it threw on the first of those where it did, as on_first_rank() does, on every rank
   */
  void on_each_rank(const std::function<void(std::size_t)> &action);
} // namespace apps

#pragma once

#include <string>

namespace apps
{
  /**
   * Choose how many threads OpenMP uses.
   * @param requested by the user; 0: OMP_NUM_THREADS if it is set, otherwise as many as there are processors with nothing else to
   * do, at least one: with threads on a busy one, all would wait for it in every step.
   *
   * Several threads shall sleep soon while they wait for each other. Those of libgomp spin for milliseconds by default: alone on
   * the machine that gains nothing measurable, beside another busy process it makes a run many times slower. Libgomp queries the
   * environment when it is loaded, before main: so the program sets it and starts itself anew, once, unless the user (or the
   * launcher) has said how to wait. Call it before anything else is done.
   */
  void use_threads(int requested);

  /** What use_threads() left to others, for the line with which a run begins; "" for nothing. */
  std::string threads_in_words();
} // namespace apps

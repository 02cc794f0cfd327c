#pragma once

#include "apps/results/run_result.h"

#include <memory>

namespace python
{
  /**
   * Has parts of a solid, which must go before MPI ends: that is when the interpreter leaves, and what variables of a program hold goes
   * later still.
   */
  class UntilExit
  {
  public:
    UntilExit();
    virtual ~UntilExit();
    UntilExit(const UntilExit &)            = delete;
    UntilExit &operator=(const UntilExit &) = delete;

    /** It is not used any more. */
    virtual void let_go() = 0;
  };

  /** The same of a result, which may hold the body that its particles belong to. */
  void keep_until_exit(const std::shared_ptr<apps::RunResult> &result);

  /** Let all go that are still there, and end MPI. */
  void leave();
} // namespace python

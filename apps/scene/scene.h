#pragma once

#include "apps/results/run_outcome.h"
#include "apps/scene/section.h"

#include <cstddef>
#include <optional>
#include <string>

namespace apps
{
  struct RunRequest;
  struct RunResult;

  /**
   * A kind of scene: its parameters, and what to do with them. One class per kind, listed in apps/scene/kinds/kinds.h.
   *
   * Order: declare(), then the reader fills the members, check(), and then either forecast() or run().
   */
  class Scene
  {
  public:
    virtual ~Scene() = default;

    /** Bind every parameter of the kind. The object must stay where it is from now on. */
    virtual void declare(Section &root) = 0;

    /** Rules between entries. @throws base::EntryError naming the entry, base::InputError */
    virtual void check() const = 0;

    /**
     * What a run would take, as text for the terminal; sets the model up, but writes nothing.
     * @throws base::InputError.
     */
    virtual std::string forecast() const = 0;

    /**
     * The same, and how the particles would be shared out among ranks. @param ranks >= 1
     * @throws base::InputError too where the kind has no particles of its own to share out
     */
    virtual std::string forecast_over(std::size_t ranks) const = 0;

    /** Names of what a run can find; nothing where they are not known before the model is set up. Sets none up. */
    virtual std::optional<RunOutcome> outcome() const { return std::nullopt; }

    /** Whether processes started by mpirun share the work of run(). */
    virtual bool shares_ranks() const { return false; }

    /**
     * Do the work, and write the results where files are requested. A scene may be run again, and several at a time in threads of one
     * process; those with a solid one after the other, as MPI is the process's.
     * @return what was found; where it was interrupted, with a checkpoint left if there is a folder
     * @throws base::InputError before the output folder is touched; postprocess::OutputError; base::NumericalError.
     */
    virtual RunResult run(const RunRequest &request) const = 0;
  };
} // namespace apps

#pragma once

#include "apps/scene/section.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace apps
{
  class RunObserver;
  struct RunResult;

  /** A file that a scene names, and its content. */
  struct InputFile
  {
    std::string    entry;  ///< "Specimen/File"
    std::string    file;   ///< from the current folder
    std::uintmax_t bytes;  ///< its length
    std::uint64_t  digest; ///< postprocess::digest_of_file()
  };

  /** What a run is asked besides its scene. */
  struct RunRequest
  {
    std::filesystem::path    output_folder;   ///< "": no file is written, and an interrupted run cannot go on
    std::string              command = "run"; ///< by which it can be resumed: "run", "transfer --identify"
    bool                     resume  = false;
    bool                     restart = false; ///< what an interrupted run left may be thrown away
    std::string              scene_file;      ///< as typed
    std::string              scene_text;      ///< the scene as completed, to be written beside the results
    std::string              deciding_text;   ///< of it, what decides the results: a checkpoint belongs to this text
    std::vector<std::string> overrides;       ///< as typed after -s
    std::vector<InputFile>   inputs;          ///< files that the scene names

    std::vector<RunObserver *>
      observers; ///< are told of the run as it goes (apps/results/run_observer.h); they must outlive it
    /** Whether the run shall stop and save its state, besides when the process is interrupted. Asked often; empty: it shall not. */
    std::function<bool()> stop;
  };

  /**
   * A kind of scene: its parameters, and what to do with them. One class per kind, listed in apps/drivers/all.h.
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

    /** Whether processes started by mpirun share the work of run(). */
    virtual bool shares_ranks() const { return false; }

    /**
     * Do the work, and write the results where files are asked for. A scene may be run again, and several at a time in threads of one
     * process; those with a solid one after the other, as MPI is the process's.
     * @return what was found; where it was interrupted, with a checkpoint left if there is a folder
     * @throws base::InputError before the output folder is touched; postprocess::OutputError; base::NumericalError.
     */
    virtual RunResult run(const RunRequest &request) const = 0;
  };
} // namespace apps

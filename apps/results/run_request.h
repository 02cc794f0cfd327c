#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace apps
{
  class RunObserver;

  /** A file that a scene names, and its content. */
  struct InputFile
  {
    std::string    entry;  ///< "Specimen/File"
    std::string    file;   ///< from the current folder
    std::uintmax_t bytes;  ///< its length
    std::uint64_t  digest; ///< postprocess::digest_of_file()
  };

  /** Options of a run besides its scene. */
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
      observers; ///< are notified of the run as it goes (apps/results/run_observer.h); they must outlive it
    /** Whether the run shall stop and save its state, besides when the process is interrupted. Called often; empty: it shall not. */
    std::function<bool()> stop;
  };
} // namespace apps

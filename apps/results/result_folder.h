#pragma once

#include <filesystem>

namespace apps
{
  /**
   * Where a run writes, without ever harming what an earlier run left there.
   *
   * A folder holds the results of the last *completed* run. The run in progress writes to its sub-folder `running`;
   * when it is complete, its files move up and replace those of the earlier run. A run that is interrupted or fails
   * leaves the earlier results as they are, and in `running` its own with the last checkpoint, for `--resume`. A new run
   * replaces `running`; see refuse_to_overwrite().
   *
   * Only one run at a time may write to a folder: it is locked until the object goes.
   */
  class ResultFolder
  {
  public:
    enum class Start
    {
      afresh,
      resume ///< keep what is in `running`
    };

    /**
     * Make the folder and its `running`, and lock it.
     * @throws postprocess::OutputError when it cannot be made or written to, or another run writes to it;
     * base::InputError when there is nothing to resume.
     */
    ResultFolder(const std::filesystem::path &folder, Start start);
    ~ResultFolder();
    ResultFolder(const ResultFolder &)            = delete;
    ResultFolder &operator=(const ResultFolder &) = delete;

    const std::filesystem::path &running() const { return running_path; } ///< write here
    const std::filesystem::path &path() const { return folder_path; }

    /** The run is complete: its files replace those of the earlier run. @throws postprocess::OutputError. */
    void publish();

  private:
    std::filesystem::path folder_path, running_path;
    int                   lock = -1;
  };

  /**
   * Keeps a new run from throwing away what an interrupted one computed.
   * @throws base::InputError, which offers --resume and --restart, when the folder holds a checkpoint.
   */
  void refuse_to_overwrite(const std::filesystem::path &folder);

  /** The name, in a result folder, of what a run goes on from. */
  extern const char *const checkpoint_name;
} // namespace apps

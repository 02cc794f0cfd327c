#include "apps/results/result_folder.h"

#include "base/errors.h"
#include "postprocess/files/errors.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace apps
{
  namespace fs = std::filesystem;

  const char *const checkpoint_name = "checkpoint.h5";

  namespace
  {
    [[noreturn]] void refuse(const fs::path &path, const std::string &what, const std::string &reason)
    {
      throw postprocess::OutputError(path.string() + ": " + what + ": " + reason + ".");
    }

    void make_folder(const fs::path &path)
    {
      std::error_code error;
      fs::create_directories(path, error);
      if (error || !fs::is_directory(path))
        refuse(path, "the output folder cannot be made", error ? error.message() : "a file of this name exists");
      if (access(path.c_str(), W_OK | X_OK) != 0)
        refuse(path, "the output folder cannot be written to", std::strerror(errno));
    }

    int lock_folder(const fs::path &path)
    {
      const int descriptor = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (descriptor < 0)
        refuse(path, "the output folder cannot be opened", std::strerror(errno));
      if (flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        return descriptor;
      const int reason = errno;
      close(descriptor);
      if (reason == EWOULDBLOCK)
        refuse(path, "another run is writing to this folder", "choose another one with -o, or wait for it");
      return -1; // a file system without locks: the user has to take care of it
    }
  } // namespace

  void refuse_to_overwrite(const fs::path &folder)
  {
    std::error_code none;
    if (fs::exists(folder / "running" / checkpoint_name, none))
      throw base::InputError(
        folder.string() + ": an earlier run was interrupted, or failed, and its state is kept in " +
        (folder / "running").string() + ". Go on with it: --resume. Throw it away and start afresh: --restart.");
  }

  ResultFolder::ResultFolder(const fs::path &folder, const Start start)
    : folder_path(folder)
    , running_path(folder / "running")
  {
    if (start == Start::resume && !fs::exists(running_path / checkpoint_name))
      throw base::InputError(folder.string() + ": nothing to resume: there is no " +
                             (running_path / checkpoint_name).string() +
                             (fs::exists(folder / "summary.json") ? "; the run in this folder is complete." : "."));
    make_folder(folder_path);
    lock = lock_folder(folder_path);
    if (start == Start::resume)
      return;
    std::error_code error;
    fs::remove_all(running_path, error);
    if (error)
      refuse(running_path, "what an earlier run left cannot be removed", error.message());
    make_folder(running_path);
  }

  ResultFolder::~ResultFolder()
  {
    if (lock >= 0)
      close(lock);
  }

  void ResultFolder::publish()
  {
    try
      {
        fs::remove(running_path / checkpoint_name);
        for (const fs::directory_entry &entry : fs::directory_iterator(running_path))
          {
            const fs::path destination = folder_path / entry.path().filename();
            if (entry.is_directory())
              fs::remove_all(destination); // a folder of snapshots is replaced as a whole
            fs::rename(entry.path(), destination);
          }
        fs::remove_all(running_path);
      }
    catch (const fs::filesystem_error &error)
      {
        refuse(running_path, "complete results could not be moved to " + folder_path.string(), error.code().message());
      }
  }
} // namespace apps

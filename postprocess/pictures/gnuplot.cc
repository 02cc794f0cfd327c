#include "postprocess/pictures/gnuplot.h"

#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/scratch_folder.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

extern char **environ; // of this process, for the child

namespace postprocess
{
  namespace
  {
    namespace fs = std::filesystem;

    std::function<bool()> &drawing_is_to_stop()
    {
      static std::function<bool()> requested = [] { return false; };
      return requested;
    }

    /** Wait for the end of a child, unless drawing is to stop: then end it. @return its status, as waitpid gives it */
    int status_of(const pid_t child)
    {
      int status = 0;
      for (;;)
        {
          const pid_t ended = ::waitpid(child, &status, WNOHANG);
          if (ended == child)
            return status;
          if (drawing_is_to_stop()())
            break;
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
      ::kill(child, SIGKILL);
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
      throw OutputError("interrupted");
    }

    /** Run `gnuplot script` in the folder; what it says goes to the file `messages`. @return exit status, -1 if killed
     */
    int run_gnuplot(const ScratchFolder &folder)
    {
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
      posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
      posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "messages", O_WRONLY | O_CREAT, 0666);

      std::string program = "gnuplot", own_settings_only = "-d", script = "script";
      char *const arguments[] = {program.data(), own_settings_only.data(), script.data(), nullptr};
      pid_t       child       = 0;
      const int   error       = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
      posix_spawn_file_actions_destroy(&actions);
      if (error == ENOENT)
        throw OutputError("gnuplot is not installed (Debian package gnuplot-nox)");
      if (error != 0)
        throw OutputError("gnuplot cannot be started: " + std::generic_category().message(error));

      const int status = status_of(child);
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    /** The last line that says something: gnuplot repeats the command first and then what is wrong with it. */
    std::string last_line(const std::string &text)
    {
      std::string last = "no message";
      for (numeric_text::Lines lines(text); lines.next();)
        if (!numeric_text::trimmed(lines.text()).empty())
          last = numeric_text::trimmed(lines.text());
      return last;
    }
  } // namespace

  void stop_drawing_if(std::function<bool()> requested) { drawing_is_to_stop() = std::move(requested); }

  void draw_with_gnuplot(const fs::path &destination, const GnuplotJob &job)
  {
    const ScratchFolder folder("plot");
    for (const auto &[name, text] : job.data)
      folder.write(name, text);
    folder.write("script", "set encoding utf8\nset terminal pngcairo enhanced font 'sans,11' size " +
                             std::to_string(job.width) + "," + std::to_string(job.height) +
                             "\nset output 'picture.png'\n" + job.script + "\nunset output\n");

    if (const int status = run_gnuplot(folder); status != 0)
      throw OutputError("gnuplot failed (" + (status < 0 ? "killed" : "status " + std::to_string(status)) +
                        "): " + last_line(numeric_text::read_whole(folder / "messages")));
    write_text(destination, numeric_text::read_whole(folder / "picture.png"));
  }

  std::string gnuplot_quoted(const std::string &text)
  {
    std::string quoted = "'";
    for (const char c : text)
      {
        if (c == '\'')
          quoted += '\'';
        quoted += c == '\n' ? ' ' : c;
      }
    return quoted + "'";
  }
} // namespace postprocess

#include "apps/results/terminal.h"

#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/process/threads.h"
#include "apps/results/result_listing.h"
#include "apps/results/run_result.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** Of the process, which shows one run only on its terminal. */
    void set_words_of_first_rank(const std::string &words) { set_last_words(is_first_rank() ? words : ""); }
  } // namespace

  void ProgressLine::stage(const std::string &name) { line.emplace(name); }

  void ProgressLine::progress(const double done, const std::string &details) { line->update(done, details); }

  void Terminal::prepares() { set_words_of_first_rank("interrupted before there was a state to save."); }

  void Terminal::begins(const RunOutline &outline)
  {
    if (is_first_rank())
      fmt::print(stderr, "{}: {}{}; results {} in {}\n", outline.scene_file, outline.size, threads_in_words(),
                 outline.resumed ? "go on" : "grow", outline.location.string());
  }

  void Terminal::says(const std::string &text)
  {
    if (is_first_rank())
      fmt::print("{}", text);
  }

  void Terminal::warns(const std::string &sentence)
  {
    if (is_first_rank())
      fmt::print(stderr, "breccia: warning: {}\n", sentence);
  }

  void Terminal::saved(const std::string &go_on)
  {
    set_words_of_first_rank(
      "interrupted in work that cannot be stopped half-way; the state of the last checkpoint is kept. " + go_on);
  }

  void Terminal::ends(const RunResult &result)
  {
    ProgressLine::ends(result);
    if (!is_first_rank())
      return;
    if (result.end == RunResult::End::interrupted)
      fmt::print(stderr, "breccia: interrupted{}{}\n", result.stage.empty() ? "" : " in " + result.stage,
                 result.go_on.empty() ? "; nothing was written." : ", state saved. " + result.go_on);
    else
      fmt::print("{}{}", result.words, result_listing(result.folder));
  }
} // namespace apps

#include "apps/process/interrupt.h"

#include "apps/process/exit_status.h"
#include "postprocess/pictures/gnuplot.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>

namespace apps
{
  namespace
  {
    constexpr std::chrono::seconds patience{4};

    volatile std::sig_atomic_t raised = 0;
    std::atomic<int>           answering{0};
    int                        wake_up[2] = {-1, -1}; ///< a pipe: signal handlers may write to it

    /** Kept for ever: the warden may read them while the program's own objects go. */
    struct LastWords
    {
      std::mutex  mutex;
      std::string text = "breccia: interrupted.\n";
    };

    LastWords &last_words()
    {
      static auto *const words = new LastWords;
      return *words;
    }

    void raise_flag(int)
    {
      const int saved       = errno;
      raised                = 1;
      const char    byte    = 0;
      const ssize_t ignored = write(wake_up[1], &byte, 1);
      static_cast<void>(ignored);
      errno = saved;
    }

    /** Sleeps until a signal comes; then gives the work its time to answer. */
    void watch_over_work()
    {
      char byte;
      while (read(wake_up[0], &byte, 1) < 0 && errno == EINTR)
        continue;
      auto silent_since = std::chrono::steady_clock::now();
      while (std::chrono::steady_clock::now() - silent_since < patience)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          if (answering > 0)
            silent_since = std::chrono::steady_clock::now();
        }
      LastWords                        &words = last_words();
      const std::lock_guard<std::mutex> lock(words.mutex);
      const ssize_t                     ignored = write(STDERR_FILENO, words.text.data(), words.text.size());
      static_cast<void>(ignored);
      _exit(exit_interrupted);
    }

    /** Signals are for the thread that works. */
    void start_warden()
    {
      last_words();
      sigset_t all, before;
      sigfillset(&all);
      pthread_sigmask(SIG_SETMASK, &all, &before);
      std::thread(watch_over_work).detach();
      pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
  } // namespace

  void catch_interrupts()
  {
    if (wake_up[0] >= 0 || pipe2(wake_up, O_CLOEXEC) != 0)
      return;
    start_warden();
    postprocess::stop_drawing_if(interrupted);
    struct sigaction action = {};
    action.sa_handler       = raise_flag;
    action.sa_flags         = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    for (const int signal : stop_signals)
      sigaction(signal, &action, nullptr);
  }

  namespace
  {
    thread_local const std::function<bool()> *stop_of_run = nullptr;
  }

  bool interrupted() { return raised != 0 || (stop_of_run && (*stop_of_run)()); }

  StopsToo::StopsToo(const std::function<bool()> &stop)
    : before(stop_of_run)
  {
    if (stop)
      stop_of_run = &stop;
  }

  StopsToo::~StopsToo() { stop_of_run = before; }

  void set_last_words(const std::string &words)
  {
    LastWords                        &kept = last_words();
    const std::lock_guard<std::mutex> lock(kept.mutex);
    kept.text = words.empty() ? "" : "\nbreccia: " + words + "\n";
  }

  AnsweringInterrupt::AnsweringInterrupt() { ++answering; }
  AnsweringInterrupt::~AnsweringInterrupt() { --answering; }
} // namespace apps

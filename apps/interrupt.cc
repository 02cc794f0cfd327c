#include "apps/interrupt.h"

#include <csignal>

namespace apps
{
  namespace
  {
    volatile std::sig_atomic_t raised = 0;

    void raise_flag(int) { raised = 1; }
  } // namespace

  void catch_interrupts()
  {
    struct sigaction action = {};
    action.sa_handler       = raise_flag;
    action.sa_flags         = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }

  bool interrupted() { return raised != 0; }
} // namespace apps

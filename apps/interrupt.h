#pragma once

namespace apps
{
  /** From here on the first SIGINT or SIGTERM only raises the flag below; a second one ends the program at once. */
  void catch_interrupts();

  /** Somebody wants the program to stop: save what is worth saving and leave. */
  bool interrupted();
} // namespace apps

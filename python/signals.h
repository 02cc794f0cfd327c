#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>

namespace python
{
  /** Whether a signal has come that a handler of Python turns into an exception; called often, so it checks ten times a second. */
  class SignalsOfPython
  {
  public:
    bool raised();

    /** What the handler has raised. @pre raised() */
    [[noreturn]] void raise() const { std::rethrow_exception(exception); }

  private:
    std::exception_ptr                    exception;
    std::chrono::steady_clock::time_point checked;
  };

  /** Do work that other threads of Python go on beside; it is given a function that says whether to stop. @throws what Ctrl-C raises, once the work is over */
  template <typename Work>
  auto let_interrupt(const Work &work)
  {
    SignalsOfPython signals;
    const auto      found = [&] {
      const pybind11::gil_scoped_release letting_go;
      return work([&signals] { return signals.raised(); });
    }();
    if (signals.raised())
      signals.raise();
    return found;
  }
} // namespace python

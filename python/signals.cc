#include "python/signals.h"

namespace py = pybind11;

namespace python
{
  bool SignalsOfPython::raised()
  {
    const auto now = std::chrono::steady_clock::now();
    if (exception || now - checked < std::chrono::milliseconds(100))
      return exception != nullptr;
    checked = now;
    const py::gil_scoped_acquire holding;
    if (PyErr_CheckSignals() != 0)
      exception = std::make_exception_ptr(py::error_already_set());
    return exception != nullptr;
  }
} // namespace python

#pragma once

#include <stdexcept>

namespace postprocess
{
  /**
   * A result could not be written: unwritable folder, full disk, a name that is taken by something else.
   *
   * The message names the file and the system's reason. What stood in the file before still stands there, unless the
   * function says otherwise. The program prints the message and leaves with exit status 2.
   */
  class OutputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace postprocess

#pragma once

#include <stdexcept>
#include <string>

namespace base
{
  /**
 * A mistake in what the user gave: a scene entry, a packing file, a combination of choices.
 *
 * The message says what was found, where, and what is allowed, in the form "entry = value: broken rule. Remedy.".
 * The program prints it and leaves with exit status 2.
 */
  class InputError : public std::invalid_argument
  {
  public:
    using std::invalid_argument::invalid_argument;
  };

  /** The state has left the real numbers (NaN or infinity); the message names the step and the particle. */
  class NumericalError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace base

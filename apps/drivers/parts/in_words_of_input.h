#pragma once

#include "dem/core/errors.h"

namespace apps
{
  /** What a library refuses, as a mistake of the user's. @throws dem::InputError */
  template <typename Refusable>
  auto in_words_of_input(const Refusable &work)
  {
    try
      {
        return work();
      }
    catch (const dem::InputError &)
      {
        throw;
      }
    catch (const std::invalid_argument &refusal)
      {
        throw dem::InputError(refusal.what());
      }
  }
} // namespace apps

#pragma once

#include "dem/laws/registry.h"

#include <string>

namespace apps
{
  /** A law of links by the name that was typed. @throws base::InputError with the nearest one */
  const dem::LinkLawKind &link_law_named(const std::string &name);
} // namespace apps

#pragma once

#include "dem/laws/registry.h"

#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A law of links by the name that was typed. @throws base::InputError with the nearest one */
  const dem::LinkLawKind &link_law_named(const std::string &name);

  /** Constants of a law from "Entry=value" texts of the command line. @throws base::InputError as scenes do */
  std::shared_ptr<dem::LinkConstants> constants_of(const dem::LinkLawKind &law, const std::vector<std::string> &texts);
} // namespace apps

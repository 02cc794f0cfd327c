#pragma once

#include "apps/scene/section.h"
#include "dem/laws/cpm.h"

#include <string>

namespace apps
{
  /** Section "Material": the law of the links, and a block with the constants of every law there is. */
  struct MaterialSection
  {
    std::string        law = dem::CpmDescription::name;
    dem::CpmParameters cpm;

    void declare(Section &root);
    /** Rules between the constants of the selected law. @throws dem::InputError. */
    void validate() const;
  };
} // namespace apps

#pragma once

#include "apps/models/contact_law.h"

namespace apps
{
  class Section;

  /** @param used whether there are such contacts at all @param words the same for messages; both empty: there are */
  void declare(Section                     &section,
               ContactLaw                  &contact_law,
               const std::function<bool()> &used  = {},
               const std::string           &words = "");
} // namespace apps

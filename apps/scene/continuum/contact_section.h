#pragma once

#include "apps/runs/continuum/contact_section.h"

namespace apps
{
  class Section;

  void declare(Section &section, ContactSection &contact);
  void declare(Section &root, ContactsSection &contacts, std::function<bool()> is_explicit);
} // namespace apps

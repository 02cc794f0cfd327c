#pragma once

#include "apps/scene/assignment.h"
#include "apps/scene/section.h"

#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /**
   * Bring values into the members that a section tree is bound to; later assignments win. Sections whose names are the
   * scene's choice are opened.
   *
   * @param source the scene file (or what else the values come from), for messages about what is missing in it.
   * @throws base::InputError naming the place and the nearest valid name for an unknown section or key; the place, what
   * was found and what is allowed for a wrong value; and what to add for a needed constant that is not set.
   */
  void assign(Section &root, const std::vector<Assignment> &assignments, const std::string &source);

  /**
   * Check, or work with, a model that a section tree has filled: a base::EntryError becomes a message with the place of the entry in the
   * text and its value.
   * @throws base::InputError, and what `work` throws.
   */
  void with_places(const Section &root, const std::function<void()> &work);
} // namespace apps

#pragma once

#include "dem/genesis/sizes.h"

#include <string>
#include <vector>

namespace apps
{
  /** "0.54e-3: 0.25, 1e-3-2e-3: 0.75": diameters, or smallest and largest ones [m], and fractions. @throws base::InputError */
  std::vector<dem::SizeClass> size_classes_in_text(const std::string &text);

  /**
   * Classes of a table: columns `diameter` and `fraction`; `smallest`, `largest` and `fraction`; or, of a sieve curve, `size` and
   * `passing` (part that is finer, ascending from 0 to 1): a class between each two sieves. Lengths in [m], or [mm] where the name says so.
   * @throws base::InputError naming file and what is missing
   */
  std::vector<dem::SizeClass> size_classes_in_file(const std::string &file);
} // namespace apps

#pragma once

#include "dem/genesis/sizes.h"
#include "dem/mesostructure/grading_curve.h"

#include <string>
#include <vector>

namespace apps
{
  /** "0.54e-3: 0.25, 1e-3-2e-3: 0.75": diameters, or smallest and largest ones [m], and fractions. @throws base::InputError */
  std::vector<dem::SizeClass> size_classes_in_text(const std::string &text);

  /**
   * Classes of a table: columns `diameter` and `fraction`; `smallest`, `largest` and `fraction`; or, of a sieve curve, `size` and
   * `passing` (part that is finer), or `size` and `retained` (part that lies on the sieve and has passed the next coarser one): a class
   * between each two sieves. Rows in any order, parts of 1, percent, or masses; lengths in m, or the unit of the name.
   * @throws base::InputError naming file and what is missing
   */
  std::vector<dem::SizeClass> size_classes_in_file(const std::string &file);

  /** "4.75e-3: 0.6, 9.5e-3: 1": sieves [m], and what passes or lies on each, parts of 1 or percent. @throws base::InputError */
  std::vector<dem::SievePart> sieves_in_text(const std::string &text);
  /** Of these, which are percent where they are too much for parts of 1. @throws base::InputError */
  dem::GradingCurve grading_of(std::vector<dem::SievePart> sieves, bool retained);
  /** The same from a sieve curve of a table, whose finest sieve may let something pass (a sieve of size 0 is the pan). @throws base::InputError naming the file */
  dem::GradingCurve grading_in_file(const std::string &file);
} // namespace apps

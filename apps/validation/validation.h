#pragma once

#include "base/comparison.h"

#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /** Every reference that there is, in the order of the page: those of all rooms, which their tests run too. */
  std::vector<base::Reference> every_reference();

  /** A reference, compared. */
  struct ComparedReference
  {
    base::Reference               reference;
    std::vector<base::Comparison> rows;
    double                        seconds = 0; ///< wall clock

    std::size_t beyond() const; ///< rows whose error is beyond its limit
    double      worst() const;  ///< largest error over its limit [-]; of exact values that hold 0
  };

  ComparedReference compared(const base::Reference &reference);

  /** As a page of the documentation, a section for each. */
  std::string validation_markdown(const std::vector<ComparedReference> &all);
  /** As a page that is one file. */
  std::string validation_html(const std::vector<ComparedReference> &all);
} // namespace apps

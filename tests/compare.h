#pragma once

#include "base/comparison.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

/** Every row of a reference, by its subject: the same that "breccia validate" reports. */
inline void compare(const std::vector<base::Reference> &references, const std::string &subject)
{
  const auto found =
    std::find_if(references.begin(), references.end(), [&](const auto &one) { return one.subject == subject; });
  INFO(subject);
  REQUIRE(found != references.end());
  base::Comparisons rows;
  found->compare(rows);
  REQUIRE_FALSE(rows.all().empty());
  for (const base::Comparison &row : rows.all())
    {
      INFO(row.quantity << " [" << row.unit << "]: " << row.found << " for " << row.reference << ", error "
                        << row.error() << " of " << row.limit);
      CHECK(row.holds());
    }
}

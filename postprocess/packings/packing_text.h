#pragma once

#include "postprocess/packings/packing_io.h"

#include <optional>
#include <utility>

namespace postprocess
{
  /** The text format of read_packing(); all but the checks of dem::check_packing(). @throws base::InputError. */
  std::pair<dem::Packing, Metadata> read_packing_text(const std::filesystem::path           &path,
                                                      const std::optional<base::LengthUnit> &unit);

  /** Whether columns or comments name the unit of the lengths. @throws base::InputError as read_packing_text() */
  bool packing_text_says_unit(const std::filesystem::path &path);

  /** What comments of a text say of a packing besides its rows, lines "# ...": metadata, cell, names of materials. */
  std::string packing_comments(const dem::Packing &packing, const Metadata &metadata);

  /** The same format as text; fields are separated by `separator`. Metadata as for write_packing(). */
  std::string packing_as_text(const dem::Packing &packing, const Metadata &metadata, char separator);
} // namespace postprocess

#pragma once

#include "base/length_unit.h"
#include "postprocess/files/numeric_text.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace postprocess
{
  /** Where the numbers of a particle stand in a row of a packing, and in what units. */
  struct PackingColumns
  {
    static constexpr std::size_t quantities = 4; // x, y, z, and radius or diameter

    std::array<std::size_t, quantities>                     place = {0, 1, 2, 3};
    std::array<std::optional<base::LengthUnit>, quantities> unit; ///< empty: its name says none
    std::optional<std::size_t>                              material, clump;
    std::size_t                                             count    = quantities;
    bool                                                    diameter = false; ///< in place of the radius
    bool                                                    named    = false; ///< by a header
    bool numbers_materials = false; ///< the column of materials is YADE's, matId
  };

  /** Names of columns with their units: `x [mm]`, `x (mm)`, `x(mm)`, `x_mm`; between commas or, where there are none, blanks. */
  std::vector<numeric_text::ColumnName> packing_column_names(std::string_view line);

  /** What a header says. @throws base::InputError "FILE, line N": a quantity that is missing or named twice, a unit that is none */
  PackingColumns
  packing_columns(const std::vector<numeric_text::ColumnName> &names, const std::string &origin, std::size_t line);

  /** What a comment says of the columns of the rows below it. */
  struct CommentedNames
  {
    std::vector<numeric_text::ColumnName> names;            ///< as many as there are columns; empty: it names none
    bool                                  in_doubt = false; ///< it speaks of x, y and z, but not of so many columns
  };

  /** Names may stand within a sentence: "two dimensions: x y z radius [m]". */
  CommentedNames names_in_comment(std::string_view comment, std::size_t columns);

  /** "# the fourth column is the diameter": no names of columns, and yet it says what they are. */
  bool speaks_of_diameters(std::string_view comment);

  /** Whether a comment right above the rows is like a header: one word for each column, none of a sentence. */
  bool looks_like_names(std::string_view comment, std::size_t columns);
} // namespace postprocess

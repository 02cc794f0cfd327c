#pragma once

#include <string>
#include <vector>

namespace postprocess
{
  /** An array of a file for ParaView: its name, unit and meaning, declared once for writers, documentation and macros. */
  struct Field
  {
    enum class Of
    {
      points, ///< point data
      cells   ///< cell data
    };
    std::string name, unit; ///< unit: `-` for a pure number, empty for a number of something or a flag
    int         components; ///< 1; 3: vector; 6: symmetric tensor XX YY ZZ XY YZ XZ
    Of          of;
    std::string meaning;
    std::string only; ///< when it is there, in words; empty: always
  };

  /** A kind of file for ParaView. */
  struct FieldFile
  {
    std::string        name;        ///< "particles"
    std::string        collections; ///< which .pvd files list such files
    std::string        shows;       ///< what the points and cells are
    std::vector<Field> fields;

    /** @throws std::logic_error if there is none of that name: a writer's mistake */
    const Field &field(const std::string &field_name) const;
  };

  /** Every kind of file for ParaView with its fields, in the order in which they are documented. */
  const std::vector<FieldFile> &field_files();

  /** By name. @throws std::logic_error */
  const FieldFile &field_file(const std::string &name);

  /** Tables of all fields in Markdown: a chapter of doc/formats.md. */
  std::string fields_as_markdown();
} // namespace postprocess

#include "postprocess/files/numeric_text.h"
#include "postprocess/packings/packing_text.h"

namespace postprocess
{
  using numeric_text::append;

  namespace
  {
    /** What its materials are called; those without a name by their number. Empty: there is one material. */
    std::vector<std::string> names_of_materials(const dem::Packing &packing)
    {
      std::vector<std::string> names;
      if (packing.material.empty())
        return names;
      names = packing.material_names;
      for (const std::int32_t number : packing.material)
        while (static_cast<std::int32_t>(names.size()) <= number)
          names.push_back(std::to_string(names.size()));
      return names;
    }
  } // namespace

  std::string packing_comments(const dem::Packing &packing, const Metadata &metadata)
  {
    std::string text;
    for (const auto &[key, value] : metadata)
      text += "# " + key + ": " + value + "\n";
    if (packing.periodic_cell)
      {
        text += "# periodic_cell";
        for (int d = 0; d < 3; ++d)
          append(text += ' ', (*packing.periodic_cell)[d]);
        text += '\n';
      }
    const std::vector<std::string> materials = names_of_materials(packing);
    if (materials.empty())
      return text;
    text += "# materials";
    for (const std::string &name : materials)
      text += " " + name;
    return text += '\n';
  }

  std::string packing_as_text(const dem::Packing &packing, const Metadata &metadata, const char separator)
  {
    std::string text = "# breccia packing: lengths in m\n" + packing_comments(packing, metadata);

    const auto append_row = [&](const std::string &begin, const std::vector<double> &values, const char between,
                                const std::string &last = "") {
      text += begin;
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          if (i > 0)
            text += between;
          append(text, values[i]);
        }
      if (!last.empty())
        (text += between) += last;
      text += '\n';
    };
    const std::vector<std::string> materials = names_of_materials(packing);
    for (const dem::PackedBody &body : packing.bodies)
      {
        const Eigen::Matrix3d &I = body.inertia;
        append_row("# body ",
                   {body.volume, body.centre.x(), body.centre.y(), body.centre.z(), I(0, 0), I(1, 1), I(2, 2), I(1, 2),
                    I(0, 2), I(0, 1)},
                   ' ');
      }
    for (const char *const name : {"x", "y", "z"})
      (text += name) += separator;
    text += "radius";
    if (!materials.empty())
      (text += separator) += "material";
    if (!packing.clump.empty())
      (text += separator) += "clump";
    text += '\n';
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        std::string last = materials.empty() ? "" : materials.at(static_cast<std::size_t>(packing.material[i]));
        if (!packing.clump.empty())
          (last.empty() ? last : last += separator) += std::to_string(packing.clump[i]);
        append_row("", {packing.centre[i].x(), packing.centre[i].y(), packing.centre[i].z(), packing.radius[i]},
                   separator, last);
      }
    return text;
  }
} // namespace postprocess

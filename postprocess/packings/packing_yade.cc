#include "postprocess/packings/packing_yade.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/packings/packing_text.h"

namespace postprocess
{
  bool is_named_yade(const std::filesystem::path &path) { return path.extension() == ".yade"; }

  std::string packing_as_yade(const dem::Packing &packing, const Metadata &metadata)
  {
    if (!packing.bodies.empty())
      throw base::InputError("a packing with rigid bodies has no place in a file of YADE; write text or HDF5.");
    if (packing.periodic_cell && !packing.periodic_cell->allFinite())
      throw base::InputError("a packing that is periodic along some edges alone has no place in a file of YADE; write "
                             "text or HDF5.");
    std::string text = packing.material.empty() ? "#format x_y_z_r\n" : "#format x_y_z_r_matId\n";
    text += packing_comments(packing, metadata);
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        for (int d = 0; d < 3; ++d)
          {
            numeric_text::append(text, packing.centre[i][d]);
            text += '\t';
          }
        numeric_text::append(text, packing.radius[i]);
        if (!packing.material.empty())
          (text += '\t') += std::to_string(packing.material[i]);
        text += '\n';
      }
    return text;
  }
} // namespace postprocess

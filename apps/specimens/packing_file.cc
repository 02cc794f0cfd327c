#include "apps/specimens/packing_file.h"

#include "base/errors.h"
#include "postprocess/packings/packing_io.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  dem::Packing packing_in_file(const std::string &file, const std::optional<base::LengthUnit> &unit)
  {
    constexpr double largest = 0.1; // [m], where no unit is given
    dem::Packing     packing = postprocess::read_packing(file, unit);
    const double     radius  = *std::max_element(packing.radius.begin(), packing.radius.end());
    if (radius > largest && !unit && !postprocess::says_length_unit(file))
      throw base::InputError(fmt::format(
        "{}: a particle of radius {:g} m, and nothing says the unit. In mm? Name it in the file, x [mm] or \"# "
        "lengths in mm\", or by Length unit in the scene; if metres are meant, likewise.",
        file, radius));
    return packing;
  }
} // namespace apps

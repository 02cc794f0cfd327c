#include "apps/specimens/left_out_of_balance.h"

#include "dem/kernels/first_order_shear.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  std::string left_out_of_balance(const dem::LinkLaw &law, const std::vector<double> &radius)
  {
    const auto columns       = law.columns();
    const bool first_order   = std::any_of(columns.begin(), columns.end(),
                                           [](const dem::LinkQuantity &c) { return c.name == dem::surface_gap; });
    const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
    return first_order && *least < *most ? "work of spins on links between unequal radii (first-order shear)" : "";
  }

  std::string balance_note(const std::string &left_out)
  {
    return left_out.empty() ? "" : fmt::format("             not in the balance: {}\n", left_out);
  }
} // namespace apps

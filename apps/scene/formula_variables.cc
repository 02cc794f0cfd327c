#include "apps/scene/formula_variables.h"

#include <muParser.h>

namespace apps
{
  bool varies_in_space(const std::string &formula)
  {
    if (formula.empty())
      return false;
    mu::Parser parser; // without variables of its own it lists all that occur
    parser.SetExpr(formula);
    const auto &used = parser.GetUsedVar();
    return used.count("x") + used.count("y") + used.count("z") > 0;
  }
} // namespace apps

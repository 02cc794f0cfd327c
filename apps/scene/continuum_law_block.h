#pragma once

#include "apps/scene/section.h"

#include <cmath>
#include <string>

namespace apps
{
  /**
   * Declare the entries of a continuum material, which describes itself, in a section of the scene (or of the command line).
   *
   * The unit is the first word in brackets of the meaning, which then does without it; a constant whose member is not a number has no default.
   * @tparam Law as fem::IsotropicElastic.
   */
  template <typename Law>
  void declare_continuum_law(Section &block, typename Law::Parameters &parameters)
  {
    Law::describe(parameters, [&block](const char *key, double &member, const std::string &meaning, const double lower,
                                       const double upper) {
      const auto        open = meaning.find('['), close = meaning.find(']');
      const std::string unit =
        open < close && close != std::string::npos ? meaning.substr(open + 1, close - open - 1) : "-";
      const bool required = std::isnan(member);
      block.number(key, member, unit, Range::between(lower, upper), required ? Need::required : Need::optional)
        .means(open < close && close != std::string::npos ?
                 meaning.substr(0, meaning.find_last_not_of(' ', open - 1) + 1) + meaning.substr(close + 1) :
                 meaning);
    });
  }
} // namespace apps

#include "apps/text/corner_list.h"

#include "apps/text/value_text.h"
#include "base/errors.h"

#include <sstream>

namespace apps
{
  std::vector<Eigen::Vector3d> corners_in_text(const std::string &text, const int dimension)
  {
    std::vector<Eigen::Vector3d> corners;
    std::istringstream           all(text);
    for (std::string part; std::getline(all, part, ';');)
      {
        const auto      numbers = comma_separated(part);
        Eigen::Vector3d place   = Eigen::Vector3d::Zero();
        bool            is_one  = numbers.size() == static_cast<std::size_t>(dimension);
        for (std::size_t c = 0; is_one && c < numbers.size(); ++c)
          {
            const auto number                   = number_in(numbers[c]);
            is_one                              = number.has_value();
            place[static_cast<Eigen::Index>(c)] = number.value_or(0);
          }
        if (!is_one)
          throw base::InputError("corner " + std::to_string(corners.size() + 1) + ", \"" + trimmed(part) +
                                 "\": expected " + (dimension == 2 ? "two" : "three") +
                                 " coordinates between commas, and a semicolon between corners.");
        corners.push_back(place);
      }
    return corners;
  }
} // namespace apps

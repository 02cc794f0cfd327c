#include "apps/text/corner_list.h"

#include "apps/text/value_text.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <sstream>

namespace apps
{
  namespace
  {
    [[noreturn]] void refuse_corner(const std::size_t number, const std::string &text, const char *coordinates)
    {
      throw base::InputError(fmt::format(
        "corner {}, \"{}\": expected {} between commas, and a semicolon between corners.", number, text, coordinates));
    }
  } // namespace

  CornerList corners_in_text(const std::string &text)
  {
    CornerList         corners;
    std::istringstream all(text);
    for (std::string part; std::getline(all, part, ';');)
      {
        std::vector<double> &corner = corners.emplace_back();
        for (const std::string &coordinate : comma_separated(part))
          {
            const auto number = number_in(coordinate);
            if (!number)
              refuse_corner(corners.size(), trimmed(part), "coordinates");
            corner.push_back(*number);
          }
      }
    return corners;
  }

  std::vector<Eigen::Vector3d> places_of(const CornerList &corners, const int dimension)
  {
    std::vector<Eigen::Vector3d> places;
    for (const std::vector<double> &corner : corners)
      {
        if (corner.size() != static_cast<std::size_t>(dimension))
          refuse_corner(places.size() + 1, fmt::format("{}", fmt::join(corner, ", ")),
                        dimension == 2 ? "two coordinates" : "three coordinates");
        Eigen::Vector3d &place = places.emplace_back(Eigen::Vector3d::Zero());
        for (int c = 0; c < dimension; ++c)
          place[c] = corner[static_cast<std::size_t>(c)];
      }
    return places;
  }
} // namespace apps

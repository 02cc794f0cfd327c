#include "apps/statistics/surface_designs.h"

#include "base/errors.h"

#include <cmath>
#include <string>
#include <vector>

namespace statistics
{
  namespace
  {
    using Block = std::vector<int>;

    void demand_centres(const std::string &design, const int centres)
    {
      if (centres < 0)
        throw base::InputError(design + ": " + std::to_string(centres) + " centres: at least 0.");
    }

    /** Sign of a place in the combination of that number, the last place changing fastest. */
    double sign(const int combination, const int place, const int places)
    {
      return (combination >> (places - 1 - place)) & 1 ? 1 : -1;
    }

    std::vector<Block> blocks_of(const int factors)
    {
      if (factors == 6)
        return {{0, 1, 3}, {1, 2, 4}, {2, 3, 5}, {0, 3, 4}, {1, 4, 5}, {0, 2, 5}};
      if (factors == 7)
        return {{3, 4, 5}, {0, 5, 6}, {1, 4, 6}, {0, 1, 3}, {2, 3, 6}, {0, 2, 4}, {1, 2, 5}};
      if (factors < 3 || factors > 7)
        throw base::InputError("Box-Behnken design: " + std::to_string(factors) + " factors: 3 to 7.");
      std::vector<Block> pairs;
      for (int first = 0; first < factors; ++first)
        for (int second = first + 1; second < factors; ++second)
          pairs.push_back({first, second});
      return pairs;
    }
  } // namespace

  double rotatable_distance(const int factors) { return std::pow(2.0, factors / 4.0); }

  Eigen::MatrixXd central_composite(const int factors, const double axial_distance, const int centres)
  {
    if (factors < 2 || factors > 10)
      throw base::InputError("central composite design: " + std::to_string(factors) + " factors: 2 to 10.");
    if (!(axial_distance > 0))
      throw base::InputError("central composite design: the axial distance must be above 0.");
    demand_centres("central composite design", centres);
    const int       corners = 1 << factors;
    Eigen::MatrixXd design  = Eigen::MatrixXd::Zero(corners + 2 * factors + centres, factors);
    for (int corner = 0; corner < corners; ++corner)
      for (int factor = 0; factor < factors; ++factor)
        design(corner, factor) = sign(corner, factor, factors);
    for (int factor = 0; factor < factors; ++factor)
      {
        design(corners + 2 * factor, factor)     = -axial_distance;
        design(corners + 2 * factor + 1, factor) = axial_distance;
      }
    return design;
  }

  Eigen::MatrixXd box_behnken(const int factors, const int centres)
  {
    const std::vector<Block> blocks = blocks_of(factors);
    demand_centres("Box-Behnken design", centres);
    const int       size         = static_cast<int>(blocks.front().size());
    const int       combinations = 1 << size;
    Eigen::MatrixXd design       = Eigen::MatrixXd::Zero(blocks.size() * combinations + centres, factors);
    int             run          = 0;
    for (const Block &block : blocks)
      for (int combination = 0; combination < combinations; ++combination, ++run)
        for (int place = 0; place < size; ++place)
          design(run, block[place]) = sign(combination, place, size);
    return design;
  }
} // namespace statistics

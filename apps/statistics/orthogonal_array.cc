#include "apps/statistics/orthogonal_array.h"

#include "apps/statistics/galois_field.h"
#include "base/errors.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace statistics
{
  namespace
  {
    constexpr int most_runs = 6561;

    /** All vectors of the field, one a row, in lexicographic order. */
    Eigen::MatrixXi vectors(const int levels, const int exponent, const int count)
    {
      Eigen::MatrixXi all(count, exponent);
      for (int number = 0; number < count; ++number)
        for (int place = exponent, rest = number; place-- > 0; rest /= levels)
          all(number, place) = rest % levels;
      return all;
    }

    /** The rows whose first element that is not zero is one: a vector of each line through the origin. */
    std::vector<int> projective_points(const Eigen::MatrixXi &all)
    {
      std::vector<int> points;
      for (int row = 0; row < all.rows(); ++row)
        {
          int place = 0;
          while (place < all.cols() && all(row, place) == 0)
            ++place;
          if (place < all.cols() && all(row, place) == 1)
            points.push_back(row);
        }
      return points;
    }
  } // namespace

  Eigen::MatrixXi orthogonal_array(const int levels, const int exponent)
  {
    const GaloisField field(levels);
    int               runs = 1;
    for (int power = 0; power < exponent && runs <= most_runs; ++power)
      runs *= levels;
    if (exponent < 2 || runs > most_runs)
      throw base::InputError("orthogonal array: exponent = " + std::to_string(exponent) + ": at least 2, and at most " +
                             std::to_string(most_runs) + " runs.");
    const Eigen::MatrixXi  all    = vectors(levels, exponent, runs);
    const std::vector<int> points = projective_points(all);
    Eigen::MatrixXi        array(runs, points.size());
    for (int run = 0; run < runs; ++run)
      for (std::size_t column = 0; column < points.size(); ++column)
        {
          int entry = 0;
          for (int k = 0; k < exponent; ++k)
            entry = field.add(entry, field.multiply(all(run, k), all(points[column], k)));
          array(run, column) = entry;
        }
    return array;
  }

  Eigen::MatrixXi collapsed(Eigen::MatrixXi array, const std::vector<int> &columns)
  {
    const int highest = array.maxCoeff();
    for (const int column : columns)
      {
        if (column < 0 || column >= array.cols())
          throw std::invalid_argument("collapsed: there is no column " + std::to_string(column));
        std::replace(array.col(column).begin(), array.col(column).end(), highest, 0);
      }
    return array;
  }
} // namespace statistics

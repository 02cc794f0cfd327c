#include "fem/points/nonlocal_weights.h"

#include <deal.II/numerics/rtree.h>

#include <algorithm>

namespace fem
{
  using dealii::Point;

  NonlocalWeights::NonlocalWeights(const std::vector<Eigen::Vector3d> &places,
                                   const std::vector<double>          &volumes,
                                   const double                        radius)
    : rows(places.size())
  {
    std::vector<Point<3>> points;
    points.reserve(places.size());
    for (const Eigen::Vector3d &x : places)
      points.emplace_back(x[0], x[1], x[2]);
    const auto           tree = dealii::pack_rtree_of_indices(points);
    dealii::Tensor<1, 3> reach;
    for (int d = 0; d < 3; ++d)
      reach[d] = radius;
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const dealii::BoundingBox<3> box(std::make_pair(points[i] - reach, points[i] + reach));
        near.clear();
        boost::geometry::index::query(tree, boost::geometry::index::intersects(box), std::back_inserter(near));
        std::sort(near.begin(), near.end()); // sums are always taken alike
        double sum = 0;
        for (const std::size_t j : near)
          {
            const double share = 1 - points[i].distance_square(points[j]) / (radius * radius);
            if (share <= 0)
              continue;
            rows[i].emplace_back(j, volumes[j] * share * share);
            sum += rows[i].back().second;
          }
        for (auto &entry : rows[i])
          entry.second /= sum;
      }
  }

  std::vector<double> NonlocalWeights::averaged(const std::vector<double> &values, const double m) const
  {
    std::vector<double> result(values);
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        double difference = 0;
        for (const auto &[j, weight] : rows[i])
          difference += weight * (values[j] - values[i]);
        result[i] += m * difference;
      }
    return result;
  }
}

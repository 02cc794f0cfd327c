#include "coupling/sequential/averaging.h"

#include "base/errors.h"

#include <Eigen/Dense>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace coupling
{
  namespace
  {
    using Point = dealii::Point<3>;

    Point point_of(const Eigen::Vector3d &x) { return {x[0], x[1], x[2]}; }

    std::vector<Point> points_of(const std::vector<Eigen::Vector3d> &places)
    {
      std::vector<Point> points;
      points.reserve(places.size());
      for (const Eigen::Vector3d &x : places)
        points.push_back(point_of(x));
      return points;
    }
  } // namespace

  /** Which particles lie around a point, in ascending order so that sums are always taken alike. */
  class Averaging::Search
  {
  public:
    explicit Search(const std::vector<Eigen::Vector3d> &places)
      : points(points_of(places))
      , tree(dealii::pack_rtree_of_indices(points))
    {
    }

    std::vector<std::size_t> within(const Eigen::Vector3d &place, const double radius) const
    {
      const Eigen::Vector3d        reach = Eigen::Vector3d::Constant(radius);
      const dealii::BoundingBox<3> box({point_of(place - reach), point_of(place + reach)});
      const Point                  centre = point_of(place);
      std::vector<std::size_t>     found;
      const auto                   inside = [&](const auto i) { return points[i].distance(centre) <= radius; };
      boost::geometry::index::query(
        tree, boost::geometry::index::intersects(box) && boost::geometry::index::satisfies(inside),
        std::back_inserter(found));
      std::sort(found.begin(), found.end());
      return found;
    }

    std::size_t nearest(const Eigen::Vector3d &place) const
    {
      std::vector<std::size_t> found;
      boost::geometry::index::query(tree, boost::geometry::index::nearest(point_of(place), 1),
                                    std::back_inserter(found));
      return found.at(0);
    }

  private:
    std::vector<Point>                                            points;
    decltype(dealii::pack_rtree_of_indices(std::vector<Point>())) tree;
  };

  struct Averaging::Weighted
  {
    std::size_t     particle;
    double          weight; ///< kernel times volume [m^3]
    Eigen::Vector3d offset; ///< from the point, in widths
  };

  double width_of(const AveragingOptions &options, const ParticleField &field, const double element_size)
  {
    return options.width > 0 ? options.width : std::max(0.5 * element_size, 3 * field.mean_radius);
  }

  Averaging::Averaging(const ParticleField &field_, const AveragingOptions &options_)
    : field(&field_)
    , options(options_)
    , search(std::make_unique<Search>(field_.place))
  {
    if (!(options.width >= 0))
      throw base::InputError("averaging: the width must not be negative.");
  }

  Averaging::~Averaging() = default;

  std::vector<Averaging::Weighted> Averaging::weigh(const Eigen::Vector3d &place, const double width) const
  {
    const bool               all = options.kernel == Kernel::specimen;
    std::vector<std::size_t> near;
    if (options.kernel == Kernel::nearest)
      near = {search->nearest(place)};
    else if (!all)
      near = search->within(place, options.kernel == Kernel::ball ? width : 3 * width);

    const bool            smooth = options.kernel == Kernel::gaussian || options.kernel == Kernel::moving_least_squares;
    std::vector<Weighted> weighted(all ? field->size() : near.size());
    for (std::size_t k = 0; k < weighted.size(); ++k)
      {
        Weighted &w = weighted[k];
        w.particle  = all ? k : near[k];
        w.offset    = (field->place[w.particle] - place) / width;
        w.weight    = field->volume[w.particle] * (smooth ? std::exp(-0.5 * w.offset.squaredNorm()) : 1.0);
      }
    return weighted;
  }

  Average Averaging::at(const Eigen::Vector3d &place, const double element_size) const
  {
    const double                width = width_of(options, *field, element_size);
    const std::vector<Weighted> near  = weigh(place, width);

    Average average;
    average.width          = width;
    average.particles      = near.size();
    double          sum    = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Weighted &w : near)
      {
        sum += w.weight;
        centre += w.weight * w.offset;
        average.stress += w.weight * field->stress[w.particle];
        average.damage += w.weight * field->damage[w.particle];
      }
    if (near.empty())
      return average;
    average.stress /= sum;
    average.damage /= sum;
    average.offset = centre.norm() / sum;
    if (options.kernel == Kernel::moving_least_squares)
      average.linear = fit_linearly(near, average);
    return average;
  }

  /**
   * Moving least squares of order one (Lancaster and Salkauskas, 1981): of the linear function with the least weighted squared
   * distance to the particles' values, the value at the point. As a sum over particles its weights are b_P = w_P p(x_P).M^-1 p(0),
   * M = sum w p p^T, p = (1, offset).
   */
  bool Averaging::fit_linearly(const std::vector<Weighted> &near, Average &average) const
  {
    // A fit that rests on particles nearly in a plane magnifies their scatter: eigenvalues of M are 1 and, inside, 1 per direction.
    constexpr double smallest_condition = 0.02;
    const int        terms              = 1 + field->dimension;
    Eigen::MatrixXd  M                  = Eigen::MatrixXd::Zero(terms, terms);
    Eigen::VectorXd  p(terms);
    for (const Weighted &w : near)
      {
        p[0]                     = 1;
        p.tail(field->dimension) = w.offset.head(field->dimension);
        M += w.weight * p * p.transpose();
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(M);
    const Eigen::VectorXd                               &values = modes.eigenvalues(); // ascending
    if (near.size() < static_cast<std::size_t>(2 * terms) || !(values[0] > smallest_condition * values[terms - 1]))
      return false;
    const Eigen::VectorXd row = M.ldlt().solve(Eigen::VectorXd::Unit(terms, 0));
    average.stress.setZero();
    average.damage.setZero();
    for (const Weighted &w : near)
      {
        const double share = w.weight * (row[0] + row.tail(field->dimension).dot(w.offset.head(field->dimension)));
        average.stress += share * field->stress[w.particle];
        average.damage += share * field->damage[w.particle];
      }
    return true;
  }
} // namespace coupling

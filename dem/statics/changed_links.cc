#include "dem/statics/changed_links.h"

#include "dem/network/slip_matrices.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    constexpr std::size_t kept_numbers = 64000000; ///< of answers, beyond which they are found anew

    bool differs(const base::Matrix6 &stiffness, const base::Matrix6 &other)
    {
      constexpr double rounding = 1e-12;
      return (stiffness - other).cwiseAbs().maxCoeff() > rounding * other.cwiseAbs().maxCoeff();
    }
  } // namespace

  ChangedLinks::ChangedLinks(const LoadedNetwork       &network,
                             const std::vector<int>    &numbers,
                             const int                  unknowns,
                             const double               length,
                             std::vector<base::Matrix6> factorised,
                             Solution                   by_factor,
                             const std::size_t          most)
    : loaded(network)
    , unknown(numbers)
    , count(unknowns)
    , scale(length)
    , before(std::move(factorised))
    , solution(std::move(by_factor))
    , largest(most)
    , place(before.size(), -1)
  {
    const bool moments = std::any_of(before.begin(), before.end(),
                                     [](const base::Matrix6 &C) { return !C.bottomRightCorner<3, 3>().isZero(0); });
    for (int c = 0; c < (moments ? 6 : 3); ++c)
      if (loaded.network.dimension == 3 || c < 2 || c == 5)
        kept.push_back(c);
  }

  std::vector<ChangedLinks::Component> ChangedLinks::components_of(const std::size_t link) const
  {
    const ElasticLink &l = loaded.network.links[link];
    const auto [J, K]    = slip_matrices(l, scale);
    std::vector<Component> all(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
      for (const auto &[end, slip] : {std::pair<std::int32_t, const SlipOf &>(l.first, J), {l.second, K}})
        for (int m = 0; m < motions; ++m)
          if (const int u = unknown[motions * static_cast<std::size_t>(end) + static_cast<std::size_t>(m)];
              u >= 0 && slip(kept[k], m) != 0)
            all[k].emplace_back(u, slip(kept[k], m));
    return all;
  }

  double ChangedLinks::along(const std::size_t of, const std::size_t column) const
  {
    double sum = 0;
    for (const auto &[u, weight] : component[of])
      sum += weight * answer(u, static_cast<Eigen::Index>(column));
    return sum;
  }

  void ChangedLinks::find_answers()
  {
    if ((component.size() + kept.size() * changed.size()) * static_cast<std::size_t>(count) > kept_numbers)
      {
        std::fill(place.begin(), place.end(), -1);
        component.clear();
      }
    const std::size_t first = component.size();
    for (const std::size_t link : changed)
      if (place[link] < 0)
        {
          place[link] = static_cast<int>(component.size());
          for (Component &each : components_of(link))
            component.push_back(std::move(each));
        }
    const auto added = static_cast<Eigen::Index>(component.size() - first);
    if (added == 0)
      return;
    if (answer.cols() < static_cast<Eigen::Index>(component.size()))
      answer.conservativeResize(count, std::max(static_cast<Eigen::Index>(component.size()), 2 * answer.cols()));
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(count, added);
    for (Eigen::Index k = 0; k < added; ++k)
      for (const auto &[u, weight] : component[first + static_cast<std::size_t>(k)])
        unit(u, k) += weight;
    answer.middleCols(static_cast<Eigen::Index>(first), added) = solution(unit);
  }

  std::size_t ChangedLinks::number(const std::vector<base::Matrix6> &stiffness) const
  {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      sum += differs(stiffness[i], before[i]) ? 1 : 0;
    return sum;
  }

  bool ChangedLinks::take(const std::vector<base::Matrix6> &stiffness, const std::size_t most)
  {
    std::vector<std::size_t> found;
    const std::size_t        limit = std::min(most, largest / kept.size());
    for (std::size_t i = 0; i < stiffness.size() && found.size() <= limit; ++i)
      if (differs(stiffness[i], before[i]))
        found.push_back(i);
    if (found.size() > limit)
      return false;
    std::vector<base::Matrix6> by;
    for (const std::size_t i : found)
      {
        by.push_back(stiffness[i] - before[i]);
        for (int c = 3; c < 6 && kept.back() < 3; ++c)
          if (!by.back().row(c).isZero(0) || !by.back().col(c).isZero(0))
            return false;
      }
    changed = std::move(found);
    change  = std::move(by);
    find_answers();
    make_system();
    return true;
  }

  void ChangedLinks::make_system()
  {
    const std::size_t n    = kept.size();
    const auto        rows = static_cast<Eigen::Index>(n), size = static_cast<Eigen::Index>(n * changed.size());
    Eigen::MatrixXd   flexibility(size, size); // slip of one component per force of another
    by_component.setZero(rows, size);
    for (std::size_t i = 0; i < changed.size(); ++i)
      for (std::size_t k = 0; k < n; ++k)
        {
          const auto row = static_cast<Eigen::Index>(n * i + k);
          for (std::size_t c = 0; c < n; ++c)
            by_component(static_cast<Eigen::Index>(c), row) = change[i](kept[c], kept[k]);
          for (std::size_t j = 0; j < changed.size(); ++j)
            for (std::size_t c = 0; c < n; ++c)
              flexibility(row, static_cast<Eigen::Index>(n * j + c)) =
                along(static_cast<std::size_t>(place[changed[i]]) + k, static_cast<std::size_t>(place[changed[j]]) + c);
        }
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(size, size);
    for (Eigen::Index first = 0; first < size; first += rows)
      system.middleRows(first, rows) += by_component.middleCols(first, rows) * flexibility.middleRows(first, rows);
    if (size > 0)
      factor.compute(system);
  }

  void ChangedLinks::correct(Eigen::MatrixXd &answers) const
  {
    const std::size_t n    = kept.size();
    const auto        rows = static_cast<Eigen::Index>(n);
    if (changed.empty())
      return;
    Eigen::MatrixXd slip(by_component.cols(), answers.cols());
    for (std::size_t i = 0; i < changed.size(); ++i)
      {
        Eigen::MatrixXd of_link = Eigen::MatrixXd::Zero(rows, answers.cols());
        for (std::size_t k = 0; k < n; ++k)
          for (const auto &[u, weight] : component[static_cast<std::size_t>(place[changed[i]]) + k])
            of_link.row(static_cast<Eigen::Index>(k)) += weight * answers.row(u);
        const auto first             = static_cast<Eigen::Index>(n * i);
        slip.middleRows(first, rows) = by_component.middleCols(first, rows) * of_link;
      }
    const Eigen::MatrixXd force = factor.solve(slip);
    for (std::size_t i = 0; i < changed.size(); ++i)
      for (Eigen::Index k = 0; k < rows; ++k)
        for (Eigen::Index column = 0; column < answers.cols(); ++column)
          answers.col(column) -=
            force(static_cast<Eigen::Index>(n * i) + k, column) * answer.col(place[changed[i]] + k);
  }

  Eigen::MatrixXd ChangedLinks::under_loads(const std::vector<int> &parameters) const
  {
    const auto      rows = static_cast<Eigen::Index>(kept.size());
    Eigen::MatrixXd sum  = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < changed.size(); ++i)
      {
        const base::Matrix6 all = change[i].leftCols<3>() * loaded.load_slip[changed[i]];
        Eigen::MatrixXd     force(rows, sum.cols());
        for (Eigen::Index k = 0; k < rows; ++k)
          for (Eigen::Index p = 0; p < sum.cols(); ++p)
            force(k, p) = all(kept[static_cast<std::size_t>(k)], parameters[static_cast<std::size_t>(p)]);
        if (!force.isZero(0))
          sum += answer.middleCols(place[changed[i]], rows) * force;
      }
    return sum;
  }
} // namespace dem

#include "dem/statics/surrounded_system.h"

namespace dem
{
  SurroundedSystem::SurroundedSystem(const LoadedNetwork    &loaded,
                                     const std::vector<int> &unknown,
                                     const int               unknowns,
                                     const double            size)
    : count(unknowns)
    , surrounded(loaded.body || loaded.ties)
    , around(unknowns, unknowns)
  {
    if (loaded.body)
      add_body(loaded, unknown);
    if (!loaded.ties)
      return;
    if (loaded.ties->by_leaders().cols() > 0)
      add_leaders(loaded.ties->by_leaders(), unknown);
    else
      add_multipliers(loaded.ties->rows(), unknown, size);
  }

  void SurroundedSystem::add_body(const LoadedNetwork &loaded, const std::vector<int> &unknown)
  {
    const std::size_t                   first = motions * loaded.network.particles();
    std::vector<Eigen::Triplet<double>> entries;
    const auto                          joint = [&](const Eigen::Index x) {
      return unknown[first + motions * static_cast<std::size_t>(x / 3) + static_cast<std::size_t>(x % 3)];
    };
    for (Eigen::Index column = 0; column < loaded.body->stiffness.cols(); ++column)
      for (Sparse::InnerIterator entry(loaded.body->stiffness, column); entry; ++entry)
        if (joint(entry.row()) >= 0 && joint(column) >= 0)
          entries.emplace_back(joint(entry.row()), joint(column), entry.value());
    around.setFromTriplets(entries.begin(), entries.end());
  }

  void SurroundedSystem::add_leaders(const Sparse &by_leaders, const std::vector<int> &unknown)
  {
    led = true;
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < by_leaders.cols(); ++column)
      {
        if (by_leaders.col(column).nonZeros() == 0 || unknown[static_cast<std::size_t>(column)] < 0)
          continue;
        for (Sparse::InnerIterator entry(by_leaders, column); entry; ++entry)
          if (const int driven = unknown[static_cast<std::size_t>(entry.row())]; driven >= 0)
            entries.emplace_back(driven, static_cast<int>(leading.size()), entry.value());
        leading.push_back(unknown[static_cast<std::size_t>(column)]);
      }
    leaders.resize(count, static_cast<Eigen::Index>(leading.size()));
    leaders.setFromTriplets(entries.begin(), entries.end());
  }

  void SurroundedSystem::add_multipliers(const Sparse &ties, const std::vector<int> &unknown, const double size)
  {
    borne = static_cast<int>(ties.rows());
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < ties.cols(); ++column)
      for (Sparse::InnerIterator entry(ties, column); entry; ++entry)
        if (const int u = unknown[static_cast<std::size_t>(column)]; u >= 0)
          {
            // As large as stiffnesses, so that pivots can be compared.
            const int multiplier = count + static_cast<int>(entry.row());
            entries.emplace_back(multiplier, u, size * entry.value());
            entries.emplace_back(u, multiplier, size * entry.value());
          }
    Sparse border(count + borne, count + borne);
    border.setFromTriplets(entries.begin(), entries.end());
    around.conservativeResize(count + borne, count + borne);
    around += border;
  }

  const SurroundedSystem::Sparse &SurroundedSystem::whole(const Sparse &links)
  {
    if (!surrounded)
      return links;
    if (borne == 0)
      sum = links + around;
    else
      {
        Sparse extended = links;
        extended.conservativeResize(around.rows(), around.cols());
        sum = extended + around;
      }
    if (led)
      sum = Sparse(leaders.transpose() * Sparse(sum * leaders));
    return sum;
  }

  std::size_t SurroundedSystem::multipliers(const LoadedNetwork &loaded)
  {
    return loaded.ties && !loaded.ties->is_led() ? static_cast<std::size_t>(loaded.ties->rows().rows()) : 0;
  }

  SurroundedSystem::Sparse SurroundedSystem::by_unknowns() const
  {
    if (led)
      return leaders;
    Sparse extended(count, count + borne);
    extended.reserve(Eigen::VectorXi::Constant(count + borne, 1));
    for (int i = 0; i < count; ++i)
      extended.insert(i, i) = 1;
    return extended;
  }

  SurroundedSystem::Sparse SurroundedSystem::unknowns_of(const Sparse &of_links) const
  {
    if (!led)
      {
        Sparse extended = of_links;
        extended.conservativeResize(count + borne, of_links.cols());
        return extended;
      }
    Sparse picked(leaders.cols(), count);
    picked.reserve(Eigen::VectorXi::Constant(count, 1));
    for (std::size_t k = 0; k < leading.size(); ++k)
      picked.insert(static_cast<Eigen::Index>(k), leading[k]) = 1;
    return picked * of_links;
  }

  Eigen::MatrixXd SurroundedSystem::forces(const Eigen::MatrixXd &on_unknowns) const
  {
    if (led)
      return leaders.transpose() * on_unknowns;
    Eigen::MatrixXd extended = Eigen::MatrixXd::Zero(count + borne, on_unknowns.cols());
    extended.topRows(count)  = on_unknowns;
    return extended;
  }

  Eigen::MatrixXd SurroundedSystem::motions_of(const Eigen::MatrixXd &solution) const
  {
    if (led)
      return leaders * solution;
    return solution.topRows(count);
  }
} // namespace dem

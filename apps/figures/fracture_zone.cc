#include "apps/figures/fracture_zone.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <string>

namespace apps
{
  void SpreadAmount::add(const double more, const Eigen::Vector3d &place)
  {
    amount += more;
    first += more * place;
    second += more * place * place.transpose();
  }

  Eigen::Matrix3d SpreadAmount::covariance() const
  {
    const Eigen::Vector3d middle = first / amount;
    return second / amount - middle * middle.transpose();
  }

  void SpreadAmount::visit_state(base::StateVisitor &visitor, const std::string &name)
  {
    visitor.scalar(name + "/amount", amount); // scalars, as every rank has all of it
    for (int i = 0; i < 3; ++i)
      visitor.scalar(name + "/first_" + std::to_string(i), first[i]);
    for (int i = 0; i < 9; ++i)
      visitor.scalar(name + "/second_" + std::to_string(i), second.data()[i]);
  }

  SpreadAmount operator-(const SpreadAmount &all, const SpreadAmount &part)
  {
    SpreadAmount rest;
    rest.amount = all.amount - part.amount;
    rest.first  = all.first - part.first;
    rest.second = all.second - part.second;
    return rest;
  }

  void FractureZone::note(const double load, const SpreadAmount &dissipated)
  {
    peak = std::max(peak, load);
    if (load >= has_fallen * peak)
      before = dissipated;
    last = dissipated;
  }

  std::optional<double> FractureZone::width(const int dimension) const
  {
    const SpreadAmount since = last - before;
    if (!(since.amount > 0))
      return std::nullopt;
    const Eigen::MatrixXd spread = since.covariance().topLeftCorner(dimension, dimension);
    const double          least  = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(spread).eigenvalues()[0];
    if (!(least > 0))
      return std::nullopt;
    return std::sqrt(12 * least);
  }

  void FractureZone::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("zone/peak", peak);
    before.visit_state(visitor, "zone/before");
    last.visit_state(visitor, "zone/last");
  }
} // namespace apps

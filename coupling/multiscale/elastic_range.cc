#include "coupling/multiscale/elastic_range.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/network/waiting_contacts.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace coupling
{
  using Eigen::Vector3d;

  ElasticRange::ElasticRange(const dem::ElasticNetwork   &network,
                             const dem::LinkMaterials    &materials,
                             const dem::RelaxedStiffness &relaxed,
                             const double                 threshold)
    : law(dem::law_of_links(network, materials))
    , links(network.links)
    , columns(law->columns().size())
    , history(columns * links.size(), 0.0)
    , slips(3 * static_cast<Eigen::Index>(links.size()), 6)
    , stiffness(relaxed.stiffness)
    , watched(threshold)
  {
    if (!(threshold > 0 && threshold <= 1))
      throw base::InputError("cells: promotion at the exertion " + base::number_text(threshold) +
                             ": must lie in (0, 1].");
    if (law->has_moment())
      turns.resize(slips.rows(), 6);
    for (std::size_t i = 0; i < links.size(); ++i)
      {
        const dem::ElasticLink &l = links[i];
        const auto              k = 3 * static_cast<Eigen::Index>(i);
        law->begin(l.pair, l.made, &history[columns * i]);
        slips.middleRows<3>(k) = dem::strain_localisation(l, relaxed) * (l.branch.norm() / l.reference);
        if (law->has_moment())
          turns.middleRows<3>(k) = relaxed.motion[l.second].bottomRows<3>() - relaxed.motion[l.first].bottomRows<3>();
      }
    refuse_curved_links();
    if (law->has_moment())
      return;
    std::vector<double> after(columns);
    safe_energy = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < links.size(); ++i)
      safe_energy = std::min(safe_energy, energy_to_threshold(i, after));
  }

  double ElasticRange::exertion(const std::size_t    i,
                                const double         normal,
                                const Vector3d      &across,
                                const Vector3d      &turn,
                                std::vector<double> &after) const
  {
    const dem::ElasticLink &l      = links[i];
    const double            before = dem::geometry_of(l).strain;
    dem::LinkStep           step;
    step.geometry                  = {before + normal, l.reference * (1 + before + normal), l.reference, l.area};
    step.strain_before             = before;
    step.direction                 = l.direction;
    step.shear_increment           = across;
    step.twist_increment           = l.direction.dot(turn);
    step.bending_increment         = turn - step.twist_increment * l.direction;
    const dem::LinkAnswer   answer = law->update(l.pair, step, &history[columns * i], after.data());
    const dem::LinkExertion near   = law->exertion(l.pair, step.geometry, l.direction, answer.force, after.data());
    // A link that has slid stands at its strength, to rounding.
    return answer.slides ? std::max({1.0, near.damage, near.sliding}) : std::max(near.damage, near.sliding);
  }

  ElasticRange::Nearest ElasticRange::nearest(const base::Voigt &strain) const
  {
    const Eigen::VectorXd slip = slips * strain, turn = turns.rows() > 0 ? Eigen::VectorXd(turns * strain) : slip;
    std::vector<double>   after(columns);
    Nearest               found;
    for (std::size_t i = 0; i < links.size(); ++i)
      {
        const auto     k      = 3 * static_cast<Eigen::Index>(i);
        const Vector3d total  = slip.segment<3>(k);
        const double   normal = links[i].direction.dot(total);
        const Vector3d turned = turns.rows() > 0 ? Vector3d(turn.segment<3>(k)) : Vector3d(Vector3d::Zero());
        const double   here   = exertion(i, normal, total - normal * links[i].direction, turned, after);
        if (here > found.exertion)
          found = {here, i};
      }
    return found;
  }

  double ElasticRange::energy_to_threshold(const std::size_t i, std::vector<double> &after) const
  {
    // With D = L L^T, |m . E| <= |L^-1 m| sqrt(E . D E).
    const Eigen::Matrix<double, 3, 6> M = slips.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::LLT<base::Stiffness> factor(stiffness);
    const Vector3d                    n      = links[i].direction;
    const Eigen::Matrix<double, 3, 6> across = M - n * (n.transpose() * M);
    const double   normal = factor.matrixL().solve(Eigen::Matrix<double, 6, 1>(M.transpose() * n)).norm();
    const double   shear  = factor.matrixL().solve(Eigen::Matrix<double, 6, 3>(across.transpose())).norm();
    const Vector3d side   = n.unitOrthogonal();
    const auto     holds  = [&](const double s) {
      return exertion(i, s * normal, s * shear * side, Vector3d::Zero(), after) < watched &&
             exertion(i, -s * normal, s * shear * side, Vector3d::Zero(), after) < watched;
    };
    double low = 0, high = 1e-6 / std::max({normal, shear, 1e-300}); // a strain of 1e-6
    for (int doubling = 0; holds(high); ++doubling)
      {
        low = high;
        high *= 2;
        if (doubling == 40)
          return std::numeric_limits<double>::infinity(); // a law without an end of elasticity
      }
    for (int halving = 0; halving < 40; ++halving)
      (holds(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low * low;
  }

  void ElasticRange::refuse_curved_links() const
  {
    constexpr double    small = 1e-9, rounding = 1e-6;
    std::vector<double> after(columns);
    for (std::size_t i = 0; i < links.size(); ++i)
      {
        const dem::ElasticLink &l = links[i];
        for (const double sign : {1.0, -1.0})
          {
            const double  before = dem::geometry_of(l).strain;
            dem::LinkStep step;
            step.geometry = {before + sign * small, l.reference * (1 + before + sign * small), l.reference, l.area};
            step.strain_before = before;
            step.direction     = l.direction;
            law->update(l.pair, step, &history[columns * i], after.data());
            const base::Matrix6 tangent =
              law->tangent(l.pair, step, &history[columns * i], after.data(), dem::LinkTangent());
            const double now   = l.direction.dot(tangent.topLeftCorner<3, 3>() * l.direction) * l.area / l.reference,
                         first = l.direction.dot(l.stiffness * l.direction);
            if (std::fabs(now - first) > rounding * first)
              throw base::InputError(std::string("cells: links of the law ") + law->name() +
                                     " are stiffer one way than the other from the start, so that the cell has no "
                                     "elastic answer to begin with. Promote it from the start: From the start = true.");
          }
      }
  }
} // namespace coupling

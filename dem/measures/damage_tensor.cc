#include "dem/measures/damage_tensor.h"

#include "base/mandel.h"
#include "dem/core/symmetric_modes.h"

#include <stdexcept>
#include <string>

namespace dem
{
  namespace
  {
    /** Below this the fit multiplies scatter of the damages by more than 50. */
    constexpr double smallest_condition = 0.02;

    /** The components of a Mandel column that a tensor of the space, or of the plane, has. */
    std::vector<int> components(const int dimension)
    {
      return dimension == 3 ? std::vector<int>{0, 1, 2, 3, 4, 5} : std::vector<int>{0, 1, 5};
    }
  } // namespace

  Eigen::Matrix3d damage_tensor_even(const std::vector<LinkDamage> &links, const int dimension)
  {
    Eigen::Matrix3d directed = Eigen::Matrix3d::Zero();
    double          sum      = 0;
    for (const LinkDamage &l : links)
      {
        directed += l.damage * l.direction * l.direction.transpose();
        sum += l.damage;
      }
    if (links.empty())
      return directed;
    const auto n = static_cast<double>(links.size());
    if (dimension == 3)
      return 15.0 / (2.0 * n) * directed - 3.0 / (2.0 * n) * sum * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d plane = Eigen::Vector3d(1, 1, 0).asDiagonal();
    return 4.0 / n * directed - sum / n * plane;
  }

  std::optional<Eigen::Matrix3d> damage_tensor_fitted(const std::vector<LinkDamage> &links, const int dimension)
  {
    const std::vector<int> at = components(dimension);
    if (links.size() < 2 * at.size() + (dimension == 3 ? 0 : 1))
      return std::nullopt;
    const auto      unknowns = static_cast<Eigen::Index>(at.size());
    Eigen::MatrixXd fabric   = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd directed = Eigen::VectorXd::Zero(unknowns), column(unknowns);
    for (const LinkDamage &l : links)
      {
        const base::Vector6 product = base::to_mandel(l.direction * l.direction.transpose());
        for (Eigen::Index i = 0; i < unknowns; ++i)
          column[i] = product[at[i]];
        fabric += column * column.transpose();
        directed += l.damage * column;
      }
    const SymmetricModes   modes  = symmetric_modes(fabric);
    const Eigen::VectorXd &values = modes.values; // ascending
    if (!(values[0] > smallest_condition * values[unknowns - 1]))
      return std::nullopt;
    const Eigen::VectorXd fit    = modes.vectors * (modes.vectors.transpose() * directed).cwiseQuotient(values);
    base::Vector6         mandel = base::Vector6::Zero();
    for (Eigen::Index i = 0; i < unknowns; ++i)
      mandel[at[i]] = fit[i];
    return base::from_mandel(mandel);
  }

  std::vector<ParticleDamage> particle_damage(const std::vector<std::array<std::size_t, 2>> &ends,
                                              const std::vector<LinkDamage>                 &links,
                                              const std::size_t                              particles,
                                              const DamageFit                                fit,
                                              const int                                      dimension)
  {
    if (ends.size() != links.size())
      throw std::invalid_argument("particle damage: " + std::to_string(ends.size()) + " pairs of ends but " +
                                  std::to_string(links.size()) + " links.");
    std::vector<std::vector<LinkDamage>> of_particle(particles);
    for (std::size_t l = 0; l < links.size(); ++l)
      for (const std::size_t end : ends[l])
        of_particle.at(end).push_back(links[l]);

    std::vector<ParticleDamage> result(particles);
    for (std::size_t i = 0; i < particles; ++i)
      {
        result[i].links   = of_particle[i].size();
        const auto fitted = fit == DamageFit::fitted ? damage_tensor_fitted(of_particle[i], dimension) : std::nullopt;
        result[i].fitted  = fitted.has_value();
        result[i].tensor  = fitted ? *fitted : damage_tensor_even(of_particle[i], dimension);
      }
    return result;
  }

  Eigen::Matrix3d with_published_factor(const Eigen::Matrix3d &t)
  {
    return 0.8 * t - 0.1 * t.trace() * Eigen::Matrix3d::Identity();
  }

  Eigen::Matrix3d from_published_factor(const Eigen::Matrix3d &t)
  {
    return 1.25 * t + 0.25 * t.trace() * Eigen::Matrix3d::Identity();
  }
} // namespace dem

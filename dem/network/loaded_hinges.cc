#include "dem/network/loaded_hinges.h"

#include "dem/core/symmetric_modes.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Share of a load along a free motion, beyond rounding. */
    constexpr double no_load = 1e-9;

    std::vector<int> free_motions(const StiffnessOperator &stiffness, const std::size_t particle)
    {
      std::vector<int> free;
      for (int c = 0; c < motions; ++c)
        if (!stiffness.is_held(particle, c))
          free.push_back(c);
      return free;
    }
  } // namespace

  std::vector<Mechanism>
  hold_loaded_hinges(const ElasticNetwork &network, std::vector<HeldMotions> &held, const ParticleMotions &load)
  {
    const StiffnessOperator  stiffness(network, held);
    const std::vector<Block> diagonal = stiffness.diagonal_blocks();
    std::vector<Mechanism>   hinges;
    for (std::size_t k = 0; k < stiffness.particles(); ++k)
      {
        const std::vector<int> free = free_motions(stiffness, k);
        const auto             n    = static_cast<Eigen::Index>(free.size());
        const std::int32_t     i    = stiffness.order()[k];
        if (n == 0)
          continue;
        Eigen::MatrixXd own(n, n);
        Eigen::VectorXd force(n);
        for (Eigen::Index r = 0; r < n; ++r)
          {
            force[r] = load(free[r], i) / (free[r] < 3 ? 1 : stiffness.length_scale());
            for (Eigen::Index c = 0; c < n; ++c)
              own(r, c) = diagonal[k](free[r], free[c]);
          }
        const SymmetricModes  modes  = symmetric_modes(own);
        const Eigen::VectorXd values = modes.values; // ascending
        const Eigen::Index    loose  = (values.array() <= negligible_stiffness * values[n - 1]).count();
        if (loose == 0 || loose == n)
          continue; // without any link: a body of its own
        const Eigen::MatrixXd motion = modes.vectors.leftCols(loose);
        if ((motion.transpose() * force).norm() <= no_load * force.norm())
          continue;
        for (const Eigen::Index row : rows_to_hold(motion))
          held[i] |= HeldMotions(1u << free[row]);
        Mechanism hinge;
        hinge.particles = {i};
        hinge.links     = stiffness.links_of(k);
        hinges.push_back(hinge);
      }
    std::sort(hinges.begin(), hinges.end(),
              [](const Mechanism &a, const Mechanism &b) { return a.particles < b.particles; });
    return hinges;
  }

  std::vector<Mechanism> unload_hinges(LoadedNetwork &loaded)
  {
    const std::size_t        n    = loaded.network.particles();
    DeadLoad                &dead = *loaded.dead;
    std::vector<HeldMotions> held(loaded.held.begin(), loaded.held.begin() + static_cast<std::ptrdiff_t>(n));
    std::vector<Mechanism>   hinges =
      hold_loaded_hinges(loaded.network, held, dead.force.leftCols(static_cast<Eigen::Index>(n)));
    std::vector<bool> linked(n, false);
    for (const ElasticLink &link : loaded.network.links)
      linked[static_cast<std::size_t>(link.first)] = linked[static_cast<std::size_t>(link.second)] = true;
    for (std::size_t i = 0; i < n; ++i)
      if (!linked[i] && !dead.force.col(static_cast<Eigen::Index>(i)).isZero(0))
        {
          hinges.emplace_back();
          hinges.back().particles = {static_cast<std::int32_t>(i)};
        }
    for (const Mechanism &hinge : hinges)
      {
        const std::int32_t i = hinge.particles.front();
        dead.by_factor -= dead.force.col(i).head<3>().dot(loaded.carried[static_cast<std::size_t>(i)].col(dead.factor));
        dead.force.col(i).setZero();
      }
    return hinges;
  }
} // namespace dem

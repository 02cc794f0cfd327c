#include "dem/linear/brick_border.h"

#include <algorithm>
#include <utility>

namespace dem
{
  BrickBorder::BrickBorder(std::vector<std::int32_t> rows, Sparse of_border, const RowShare &shared)
    : joined(std::move(rows))
    , modes(std::move(of_border))
    , share(shared)
  {
  }

  void BrickBorder::multiply(const base::Column &x, const Eigen::VectorXd &y, double *const w, Eigen::VectorXd &v) const
  {
    const ParticleRange   own    = share.own();
    const Eigen::VectorXd forces = now.C * y;
    base::Column          motion(joined.size() * motions, 0.0);
    for (std::size_t k = 0; k < joined.size(); ++k)
      {
        if (joined[k] < own.first || joined[k] >= own.end)
          continue;
        for (int c = 0; c < motions; ++c)
          w[motions * (joined[k] - own.first) + c] += forces[static_cast<Eigen::Index>(motions * k) + c];
        std::copy_n(&x[static_cast<std::size_t>(motions * joined[k])], motions, &motion[motions * k]);
      }
    share.gather_rows(motion, joined, motions);
    v = now.D * Eigen::Map<const Eigen::VectorXd>(motion.data(), forces.size()) + now.E * y;
  }

  BrickBorder::Blocks BrickBorder::by_modes() const
  {
    const Sparse transposed = modes.transpose();
    return {now.C * modes, transposed * now.D, transposed * Sparse(now.E * modes)};
  }
} // namespace dem

#include "dem/specimen/velocity_kicks.h"

#include <algorithm>

namespace dem
{
  double force_without_push(const Particles &particles, const std::int32_t i, const int c)
  {
    const std::size_t at = record_size * static_cast<std::size_t>(i) + static_cast<std::size_t>(c);
    return particles.pushed.empty() ? particles.force[at] : particles.force[at] - particles.pushed[at];
  }

  void VelocityKicks::add(const std::int32_t i, const std::array<double, 6> &by)
  {
    particle.push_back(i);
    change.insert(change.end(), by.begin(), by.end());
  }

  void VelocityKicks::clear()
  {
    particle.clear();
    change.clear();
  }

  std::vector<std::int32_t> VelocityKicks::particles() const
  {
    std::vector<std::int32_t> all = particle;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  double VelocityKicks::work(const Particles &particles, const double half_step) const
  {
    double power = 0;
    for (std::size_t k = 0; k < particle.size(); ++k)
      for (int c = 0; c < 6; ++c)
        power += force_without_push(particles, particle[k], c) * change[6 * k + static_cast<std::size_t>(c)];
    return half_step * power;
  }

  void VelocityKicks::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("kicks/particle", particle);
    visitor.column("kicks/change", change);
  }
} // namespace dem

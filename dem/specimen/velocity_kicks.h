#pragma once

#include "base/state.h"
#include "dem/model/particles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Force (or moment) of links and weight on a particle at t_n, without the push from outside [N, N m]. @param component of six */
  double force_without_push(const Particles &particles, std::int32_t particle, int component);

  /** Changes of velocity that particles were given since the last step, until its account is struck (doc/theory/integration.md, 4). */
  class VelocityKicks
  {
  public:
    /** @param change of the velocity [m/s] and the spin [rad/s] */
    void add(std::int32_t particle, const std::array<double, 6> &change);
    void clear();
    /** Which have been kicked, ascending. */
    std::vector<std::int32_t> particles() const;
    bool                      empty() const { return particle.empty(); }
    /**
     * Work of the forces at t_n on what was changed, over the half step before t_n [J]. Without the push: the particle pass has counted
     * its work with the changed velocity already.
     */
    double work(const Particles &particles, double half_step) const;

    void visit_state(base::StateVisitor &visitor);

  private:
    std::vector<std::int32_t> particle;
    base::Column              change; ///< six of each
  };
} // namespace dem

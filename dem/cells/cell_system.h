#pragma once

#include "dem/statics/tangent_iteration.h"
#include "dem/statics/tangent_system.h"

#include <array>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * The linearised equilibrium of a network all of whose load parameters are given, as the strains of a cell are: in space, without body
   * and ties, by iteration (dem/statics/tangent_iteration.h); by LU (dem/statics/tangent_system.h) otherwise, and where the
   * iteration does not get there. Laid out when first needed; for one thread after the other.
   */
  class CellSystem
  {
  public:
    /** @param loaded must outlive this object @param may_iterate false: by LU alone, for comparison */
    explicit CellSystem(const LoadedNetwork &loaded, bool may_iterate = true);

    /**
     * What balances the particles while the parameters change.
     * @param stiffness of each link, force and moment per slip and relative rotation [N/m], [N m]
     * @param change of each parameter; also in `correction`
     * @param accuracy largest force left over, over those to be balanced
     * @return false if the linearisation is singular
     */
    bool solve(const std::vector<base::Matrix6> &stiffness,
               const Unbalanced                 &unbalanced,
               const base::Vector6              &change,
               double                            accuracy,
               LoadedMotion                     &correction);

    /** Motion of all particles per unit of each parameter [m], [-]; all empty where they are not known. */
    using Rates = std::array<CarrierMotions, 6>;

    /**
     * Stiffness of the whole network to its parameters, particles in equilibrium: change of each parameter's force per unit of each
     * [J]. In the plane, and of parameters that move nothing, rows and columns are zero.
     * @param rates in: of a stiffness near by, to start from, or empty; out: of this one, or empty
     */
    bool condense(const std::vector<base::Matrix6> &stiffness, double accuracy, base::Matrix6 &forces, Rates &rates);
    bool condense(const std::vector<base::Matrix6> &stiffness, double accuracy, base::Matrix6 &forces);

  private:
    /** Ready for links of that stiffness; nullptr where it does not serve. */
    TangentIteration *iteration_for(const std::vector<base::Matrix6> &stiffness);
    bool              condense(const std::vector<base::Matrix6> &stiffness,
                               double                            accuracy,
                               TangentIteration                 &by_iteration,
                               base::Matrix6                    &forces,
                               Rates                            &rates) const;

    const LoadedNetwork            &loaded;
    bool                            may_iterate;
    std::optional<TangentIteration> iteration;
    TangentSystem                   factor;
  };
} // namespace dem

#pragma once

#include "coupling/volume/bond_ends.h"
#include "coupling/volume/parameters.h"
#include "dem/network/loaded_network.h"
#include "fem/solvers/condensed_solid.h"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace coupling
{
  /**
   * The equilibrium of particles inside a linear solid (doc/theory/static-handshake.md): their network, tied to the nodes of the solid
   * around them, of which nothing else is left than how it answers there.
   */
  template <int dim>
  class StaticHandshake
  {
  public:
    /**
     * @param particles their free network, with what holds or drives particles beside the solid; links share, or go, in the overlaps
     * @param solid made with Overlap::of_solid() as its share, unless particles are constrained; must outlive this
     * @param weight forces by which the solid is drawn down while a part of the particles' dead load acts, as fem::weight_of() has them; where
     * both are, each has its share. Null: particles have no dead load either
     * @throws base::InputError where there are no particles in an overlap, where one of them is not in the solid or driven, and as
     * fem::CondensedSolid does
     */
    StaticHandshake(dem::LoadedNetwork                           particles,
                    fem::Solid<dim>                             &solid,
                    const std::vector<VolumeCouplingParameters> &handshakes,
                    const fem::Vector                           *weight = nullptr);

    /** Particles and joints; the driven parameter is the load factor of the solid. */
    dem::LoadedNetwork       &network() { return loaded; }
    const dem::LoadedNetwork &network() const { return loaded; }

    /** Of the whole solid [m]. */
    fem::Vector displacement(const dem::LoadedMotion &motion) const;

    /** Where the joints are [m]. */
    std::vector<Eigen::Vector3d> joint_places() const;

    /**
     * Whether every motion costs energy of nodes that bonds lead to within elements, and of the particles around them, all others at rest. What is subtracted
     * there may be more than soft elements have. True where nothing is, and where ties are not led.
     */
    bool is_positive() const;

    /** Links with an end in an overlap, by handshake. */
    const std::vector<std::vector<std::size_t>> &shared_links() const { return shared; }

  private:
    using Dof = dealii::types::global_dof_index;

    /** Weight of a node at a particle of an overlap. */
    struct Entry
    {
      std::size_t     row, joint; ///< of the particle among those of its overlap
      double          weight;
      Eigen::Vector3d gradient; ///< of the weight with the place [1/m]
    };

    std::size_t        joint_of(const std::array<Dof, dim> &displacements);
    std::vector<Entry> enter(const std::vector<Eigen::Vector3d> &places);
    bool               lies_in_solid(const Eigen::Vector3d &place) const;
    void               share(const VolumeCouplingParameters &handshake, const std::vector<std::size_t> &particles);
    void               find_shared_links();
    /** Forces of bonds to constrained particles in elements, whose nodes become joints. */
    void enter_bond_ends(const VolumeCouplingParameters &handshake, const std::vector<std::size_t> &particles);
    /** Of the weight of particles in an overlap, what the solid does not have. */
    void share_weight(const VolumeCouplingParameters &handshake, const std::vector<std::size_t> &particles);
    void add_body(const fem::Vector *weight);
    void add_weight(const typename fem::CondensedSolid<dim>::DeadForces &of_solid);
    /** Particles move and turn as the solid does where they are. */
    std::vector<dem::Tie> constrained(const std::vector<std::size_t> &particles,
                                      const std::vector<Entry>       &entries) const;
    /** Displacements are the same in the mean around each node, or at each particle. */
    std::vector<dem::Tie> kept_together(const VolumeCouplingParameters &handshake,
                                        const std::vector<std::size_t> &particles,
                                        const std::vector<Entry>       &entries) const;

    fem::Solid<dim>                        &solid;
    dem::LoadedNetwork                      loaded;
    std::map<Dof, std::size_t>              number; ///< of a joint, by its first displacement
    std::vector<std::array<Dof, dim>>       joints;
    std::vector<std::vector<std::size_t>>   in_overlap;
    std::vector<std::vector<std::size_t>>   shared;
    std::vector<BondEnd>                    ends;    ///< of all overlaps
    std::vector<Entry>                      at_ends; ///< rows as stiffness_of() has them
    std::optional<fem::CondensedSolid<dim>> body;
  };
} // namespace coupling

#pragma once

#include "coupling/multiscale/elastic_range.h"
#include "dem/cells/responding_cell.h"
#include "dem/model/packing.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace coupling
{
  /** What a cell is made of and how it answers. */
  struct CellParameters
  {
    dem::NetworkParameters links;              ///< moduli of the materials' law; spheres, or discs for plane models
    double                 promotion  = 0.9;   ///< exertion of a link at which the cell takes over, in (0, 1]
    bool                   from_start = false; ///< every cell answers from the first step on
    bool only_solved = false; ///< for comparison: cells solve where the elastic solution would be the answer
    dem::CellResponseParameters response;
  };

  /**
   * A packing made ready to stand behind integration points: its elastic stiffness, what its links feel under each strain and the cell as
   * it is before anything has happened, all found once. Points share it; it stays as it is, and threads may read it.
   */
  class PreparedCell
  {
  public:
    /**
     * @param packing with a periodic cell, materials numbered as `materials` are
     * @throws base::InputError for a packing without cell, one that does not resist every strain, and as ElasticRange
     */
    PreparedCell(const dem::Packing &packing, const dem::LinkMaterials &materials, const CellParameters &parameters);

    const base::Stiffness &stiffness() const
    {
      return relaxed->stiffness;
    } ///< particles in equilibrium [Pa]; see in_space()
    bool of_discs() const { return network->network.dimension == 2; }
    /**
     * A stiffness of the cell as a point of a structure has it. Discs do not answer to strains out of their plane, and a plane model has
     * none: there the cell's elastic shear modulus stands in, so that the stiffness is definite; it affects nothing else.
     */
    base::Stiffness in_space(const base::Stiffness &of_cell) const;
    double          volume() const { return network->volume; } ///< [m^3]
    std::size_t     particles() const { return network->network.particles(); }
    std::size_t     links() const { return network->network.bonds(); }
    std::size_t     waiting_contacts() const { return network->network.links.size() - links(); }

    /** Whether elasticity is left (or every cell is promoted from the start). */
    bool is_left_by(const base::Voigt &strain) const { return !range || range->left_by(strain); }
    /** nullptr where cells are promoted from the start. */
    const ElasticRange *elastic_range() const { return range ? &*range : nullptr; }

    /** A cell that has gone elastically to this strain, and holds the static solution there. */
    std::unique_ptr<dem::RespondingCell> promoted_at(const base::Voigt &strain, dem::CellSystem &system) const;

    /** The linear system that cells of this packing share in one thread. */
    dem::CellSystem &system_of_thread(int thread) const;

    /** Volume over area of a plane that cuts through the cell: from face to opposite face of the edge nearest to the normal [m]. */
    double length_along(const Eigen::Vector3d &normal) const;

  private:
    std::shared_ptr<const dem::LoadedNetwork>   network;
    std::shared_ptr<const dem::ElasticResponse> relaxed;
    std::optional<ElasticRange>                 range;
    std::unique_ptr<const dem::RespondingCell>  virgin;
    Eigen::Vector3d                             edges;
    mutable std::deque<dem::CellSystem>         systems; ///< of each thread
  };
} // namespace coupling

#pragma once

#include "apps/results/run_state.h"
#include "apps/runs/coupled/element_region.h"
#include "apps/runs/structure/structure.h"
#include "dem/statics/damaging_links.h"

#include <memory>
#include <optional>
#include <vector>

namespace apps
{
  /**
   * A structure whose region of particles goes with the damage: elements become particles where a bond inside them comes near to what
   * damages it (doc/theory/static-handshake.md, 4). Where a scene asks for none of it, the structure stays the one that it was.
   */
  class Promotion
  {
  public:
    /**
     * @param packing all particles that may ever take part, as StructureModel::packing() gives them @param media of the particles. The model
     * and the media must outlive it.
     * @throws base::InputError as Structure does
     */
    Promotion(const StructureModel &model, const dem::Packing &packing, const ParticleMedia &media);

    Structure       &structure() { return *now; }
    const Structure &structure() const { return *now; }

    /**
     * Where bonds in elements have come near their damage at the last point of the path, these become particles, and the path has one point
     * more, at the same load factor. @return whether there were such elements
     * @throws StoppedShort where a structure without them cannot be
     */
    bool promote();

    /** Elements that may become particles, by handshake. */
    std::vector<std::size_t> promotable() const;

    /** Which elements have become particles; on reading, the structure is made of them. Its path is not part of it. */
    void visit_state(RunState &state);

  private:
    using Numbers = std::vector<std::size_t>;

    void                       find_elements();
    void                       leave_out_burdened();
    void                       refuse_empty();
    HandshakesSection          handshakes() const;
    StructureParts             parts();
    std::unique_ptr<Structure> made();
    dem::LoadedMotion          motion_of_all();
    bool                       add_elements(const dem::LoadedMotion &motion);
    void go_on_from(const Structure &before, const Numbers &awake_before, const dem::LoadedMotion &motion);
    std::vector<std::optional<std::size_t>> links_before(const Structure &before, const Numbers &awake_before) const;

    const StructureModel                    &model;
    const dem::Packing                      &packing;
    const ParticleMedia                     &media;
    std::unique_ptr<coupling::MeshElements>  mesh; ///< none: nothing becomes particles
    std::vector<coupling::MeshElements::Set> first, may,
      region;                                   ///< by handshake: at the start, those that may follow, now
    ParticleGroups                      groups; ///< numbers of the packing; as they were at the start
    Numbers                             awake;  ///< numbers in the packing of the structure's particles
    std::optional<dem::LoadedNetwork>   whole; ///< of the packing, with the bonds that particles in elements would have
    std::unique_ptr<dem::DamagingLinks> bonds; ///< of the whole, as if never damaged
    std::vector<std::optional<PlaceMotion>> in_solid; ///< of all particles of the packing, at the last point looked at
    std::unique_ptr<Structure>              now;
  };
} // namespace apps

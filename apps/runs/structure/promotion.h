#pragma once

#include "apps/results/run_state.h"
#include "apps/runs/structure/structure.h"
#include "coupling/promotion/growing_regions.h"
#include "dem/statics/damaging_links.h"

#include <memory>
#include <optional>
#include <vector>

namespace apps
{
  /**
   * A structure whose region of particles grows with the damage: elements become particles where a bond inside them comes near its
   * damage (doc/theory/static-handshake.md, 4). Without promotion in the model, the structure stays as it was built.
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

    coupling::GrowingRegions   growing_regions() const;
    HandshakesSection          handshakes() const;
    StructureParts             parts();
    std::unique_ptr<Structure> made();
    dem::LoadedMotion          motion_of_all();
    void go_on_from(const Structure &before, const Numbers &awake_before, const dem::LoadedMotion &motion);

    const StructureModel                   &model;
    const dem::Packing                     &packing;
    const ParticleMedia                    &media;
    std::optional<coupling::GrowingRegions> regions; ///< by handshake; none: nothing becomes particles
    ParticleGroups                          groups;  ///< numbers of the packing; as they were at the start
    Numbers                                 awake;   ///< numbers in the packing of the structure's particles
    std::optional<dem::LoadedNetwork>   whole; ///< of the packing, with the bonds that particles in elements would have
    std::unique_ptr<dem::DamagingLinks> bonds; ///< of the whole, as if never damaged
    coupling::PlaceMotions     in_solid;       ///< of all particles of the packing, at the last point that was checked
    bool                       bears_weight = false; ///< as StructureParts has it, of what is made next
    std::unique_ptr<Structure> now;
  };
} // namespace apps

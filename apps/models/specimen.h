#pragma once

#include "apps/models/genesis.h"
#include "base/entry_path.h"
#include "base/length_unit.h"
#include "dem/packing/compaction.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace apps
{
  /** Section "Specimen": where the particles come from, and what is made of them. */
  struct SpecimenSection
  {
    enum class Source
    {
      generator,
      file,
      genesis, ///< grown into a vessel
      none     ///< all particles come from elsewhere
    };

    /** How the faces of a generated box come about. */
    enum class Faces
    {
      cut,     ///< out of a periodic cell
      moulded, ///< against six smooth plates
    };

    /**
     * Sub-section "Generator": periodic isotropic compaction (doc/theory/packing.md, 1), with the defaults of dem.
     */
    struct Generator
    {
      double       radius     = 0; ///< [m]
      std::int64_t cell_count = 0; ///< 0: as many as fill the box in one piece, as long as that costs seconds
      std::int64_t seed       = static_cast<std::int64_t>(dem::CompactionParameters().seed);
      double       friction   = dem::CompactionParameters().friction;
      double       damping    = dem::CompactionParameters().damping;
      double       pressure   = dem::CompactionParameters().low_pressure; ///< that is left, p 2r/k_n
      Faces        faces      = Faces::cut;
      bool         says_faces = false; ///< the scene chose them
    };

    /** What becomes of a specimen whose particles do not all hang together. */
    enum class LoosePieces
    {
      refuse,
      drop, ///< the largest piece is the specimen
      keep
    };

    /** What becomes of the particles. */
    enum class Body
    {
      box, ///< a free body with ends, cropped to a box (or as read)
      cell ///< the periodic cell of the packing
    };

    /** What a kind of scene can do with them, so which entries there are. */
    struct Use
    {
      bool inertia = true, box = true, cell = false;
      bool genesis = false; ///< particles may be grown into a vessel
      bool laboratory =
        false; ///< a generated box is a specimen of a laboratory: moulded, unless the scene says otherwise
      bool other_particles = false; ///< the scene may have particles from elsewhere, and its law need not bond them
    };

    Source                              source   = Source::generator;
    bool                                may_grow = false; ///< the kind of scene has Source = genesis
    Body                                body     = Body::box;
    std::string                         file;
    std::optional<base::LengthUnit>     length_unit; ///< of the file; empty: as it says itself
    Generator                           generator;
    GenesisSection                      genesis;
    std::shared_ptr<const dem::Packing> grown; ///< what a genesis has come to already; empty: it is still to do
    std::array<double, 3>               box     = {0, 0, 0}; ///< [m]; all zero: the file's particles as they are
    double                              density = 0;         ///< [kg/m^3]
    double                              interaction_ratio = 0;
    bool                                says_distance =
      true; ///< up to which distance particles are linked: by one of the two; a scene may leave both out
    double      installation_gap = 0; ///< [m]
    double      thickness        = 0; ///< [m], of discs
    LoosePieces loose_pieces     = LoosePieces::refuse;
    bool        bonded           = true; ///< false: by its law no particle is linked, so that pieces mean nothing

    void check(const base::EntryPath &root, int dimension) const;
    /** Of the generator, for the requested body, or the cell of which it is like. */
    dem::CompactionParameters compaction() const;
    /** Whether the box is compacted between plates instead of being cut out of a cell. */
    bool is_moulded() const { return source == Source::generator && has_box() && generator.faces == Faces::moulded; }
    bool has_box() const { return body == Body::box && box[0] > 0; }
    /** The entry as a vector. @pre has_box() */
    Eigen::Vector3d box_edges() const { return {box[0], box[1], box[2]}; }
  };
} // namespace apps

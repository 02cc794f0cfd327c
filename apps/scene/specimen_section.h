#pragma once

#include "apps/scene/section.h"

#include <string>

namespace apps
{
  /** Section "Specimen": where the particles come from, and what is made of them. */
  struct SpecimenSection
  {
    enum class Source
    {
      generator,
      file
    };

    /** Sub-section "Generator": periodic isotropic compaction (mesoscale specification 9.1). */
    struct Generator
    {
      double       radius     = 0;    ///< [m]
      std::int64_t cell_count = 1000; ///< enough that the period is not seen: about 10 diameters
      std::int64_t seed       = 1;
      // Friction and damping stop the compaction early: 0.5 and 0.6 give a packing fraction near 0.55, as in the published
      // tests (Stransky, 2018); less of both gives denser packings, up to 0.64.
      double friction = 0.5;
      double damping  = 0.6;
    };

    Source                source = Source::generator;
    std::string           file;
    Generator             generator;
    std::array<double, 3> box               = {0, 0, 0}; ///< [m]; all zero: the file's particles as they are
    double                density           = 0;         ///< [kg/m^3]
    double                interaction_ratio = 0;
    double                thickness         = 0; ///< [m], of discs

    /** @param dimension chosen in section "Physics"; read only after reading. */
    void declare(Section &root, const int &dimension);
    void validate(const Section &root, int dimension) const;
    bool has_box() const { return box[0] > 0; }
  };
} // namespace apps

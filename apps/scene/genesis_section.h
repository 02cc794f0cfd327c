#pragma once

#include "apps/scene/section.h"
#include "dem/genesis/aggregates.h"
#include "dem/genesis/genesis.h"
#include "dem/genesis/sizes.h"

#include <string>
#include <vector>

namespace apps
{
  /** Sub-section "Aggregates" of "Genesis": polygons whose particles become rigid clumps. */
  struct AggregatesSection
  {
    double       content = 0; ///< 0: there are none
    std::string  bounds;      ///< of the classes [m], as text
    std::int64_t fewest_corners = 4, most_corners = 6;
    double       clearance    = 0; ///< [m]
    bool         middle_sizes = true;
    std::string  mortar = "mortar", aggregate = "aggregate";

    void                     declare(Section &genesis);
    void                     validate(const Section &genesis, int dimension) const;
    bool                     given() const { return content > 0; }
    dem::AggregateParameters parameters(std::uint64_t seed) const;
  };

  /** Sub-section "Genesis" of "Specimen": particles grown into a vessel (doc/theory/genesis.md). */
  struct GenesisSection
  {
    enum class Sizes
    {
      classes, ///< listed in the scene
      file,    ///< a table
      uniform  ///< radii evenly spread about a mean one
    };

    dem::GenesisParameters growth;            ///< but for radii, seed and thickness
    std::array<double, 3>  size  = {0, 0, 0}; ///< of the vessel [m]
    Sizes                  sizes = Sizes::classes;
    std::string            classes, file;
    double                 size_factor = 1;
    double                 mean_radius = 0, radius_ratio = 1; ///< [m], largest over smallest
    double                 porosity = 0.1;
    std::int64_t           seed     = 1;
    AggregatesSection      aggregates;

    /** @param chosen whether the scene asks for it */
    void declare(Section &specimen, const int &dimension, const std::function<bool()> &chosen);
    void validate(const Section &specimen, int dimension) const;

    dem::Vessel vessel(int dimension) const;
    /** Classes of sizes, the factor included. @throws base::InputError naming file or entry */
    std::vector<dem::SizeClass> size_classes() const;
    /** Particles of each class; of uniform radii one number. */
    std::vector<std::size_t> counts(int dimension) const;
    /** Everything. @param thickness of discs [m] @throws base::InputError */
    dem::GenesisParameters parameters(int dimension, double thickness) const;
    /** What becomes of the grown packing: aggregates, where there are some. @throws base::InputError */
    void finish(dem::Packing &packing) const;
  };
} // namespace apps

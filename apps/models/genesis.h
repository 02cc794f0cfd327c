#pragma once

#include "base/entry_path.h"
#include "dem/genesis/aggregates.h"
#include "dem/genesis/genesis.h"
#include "dem/genesis/sizes.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section "Aggregates" of "Genesis": polygons whose particles become rigid clumps. */
  struct AggregatesSection
  {
    double              content = 0; ///< 0: there are none
    std::vector<double> bounds;      ///< of the classes [m]
    std::int64_t        fewest_corners = 4, most_corners = 6;
    double              clearance    = 0; ///< [m]
    bool                middle_sizes = true;
    std::string         mortar = "mortar", aggregate = "aggregate";

    /** @param vessel that they lie in, valid @param tolerance part of it by which a class may miss what the grading gives */
    void                     check(const base::EntryPath &genesis, const dem::Vessel &vessel, double tolerance) const;
    bool                     given() const { return content > 0; }
    dem::AggregateParameters parameters(std::uint64_t seed) const;
  };

  /** A class of sizes in a vessel: its requested part, and how many whole particles it has. */
  struct ClassInVessel
  {
    dem::SizeClass size;
    std::size_t    count = 0;
    double         part  = 0; ///< of the solid [-]
  };

  /** Its diameters [m] in words: "0.001", "0.001 to 0.002". */
  std::string text_of(const dem::SizeClass &size);

  /** Sub-section "Genesis" of "Specimen": particles grown into a vessel (doc/theory/genesis.md). */
  struct GenesisSection
  {
    enum class Sizes
    {
      classes, ///< listed in the scene
      file,    ///< a table
      uniform  ///< radii evenly spread about a mean one
    };

    dem::GenesisParameters      growth;            ///< but for radii, seed and thickness
    std::array<double, 3>       size  = {0, 0, 0}; ///< of the vessel [m]
    Sizes                       sizes = Sizes::classes;
    std::vector<dem::SizeClass> classes; ///< of the scene
    std::string                 file;
    double                      size_factor = 1;
    double                      mean_radius = 0, radius_ratio = 1; ///< [m], largest over smallest
    double       porosity = 0.1, laboratory_porosity = 0; ///< the latter, where it is given, in place of the former
    double       size_tolerance = 0.05; ///< part of the solid by which whole particles may miss a fraction
    std::int64_t seed           = 1;
    AggregatesSection aggregates;

    void check(const base::EntryPath &specimen, int dimension) const;

    dem::Vessel vessel(int dimension) const;
    double      full_porosity() const; ///< at full size, in the plane or in space
    /** Classes of sizes, the factor included. @throws base::InputError naming file or entry */
    std::vector<dem::SizeClass> size_classes() const;
    /** Particles of each class; of uniform radii one number. */
    std::vector<std::size_t> counts(int dimension) const;
    /** Each class with its count; of uniform radii none. @throws base::InputError as size_classes() */
    std::vector<ClassInVessel> classes_in_vessel(int dimension) const;
    /** Everything. @param thickness of discs [m] @throws base::InputError */
    dem::GenesisParameters parameters(int dimension, double thickness) const;
    /** What becomes of the grown packing: aggregates, where there are some. @throws base::InputError */
    void finish(dem::Packing &packing) const;

  private:
    void require_enough_room(const base::EntryPath &genesis, int dimension, const char *sizes_from) const;
  };
} // namespace apps

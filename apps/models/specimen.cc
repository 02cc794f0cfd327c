#include "apps/models/specimen.h"

#include "dem/packing/box_cell.h"

#include <fmt/format.h>

#include <filesystem>

namespace apps
{
  dem::CompactionParameters SpecimenSection::compaction() const
  {
    dem::CompactionParameters requested;
    requested.radius       = generator.radius;
    requested.seed         = static_cast<std::uint64_t>(generator.seed);
    requested.friction     = generator.friction;
    requested.damping      = generator.damping;
    requested.low_pressure = generator.pressure;
    if (generator.cell_count > 0)
      requested.count = static_cast<std::size_t>(generator.cell_count);
    else if (has_box() && !is_moulded())
      return dem::cell_for_box(requested, box_edges());
    return requested;
  }

  void SpecimenSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath section = root.at("Specimen");
    if (source == Source::file && !std::filesystem::is_regular_file(file))
      section.refuse("File",
                     "there is no such file (" + std::filesystem::absolute(file).lexically_normal().string() + ").");
    if (source == Source::genesis)
      {
        genesis.check(section, dimension);
        if (body == Body::cell)
          section.refuse("Body", "a grown packing has faces: a periodic cell comes from the generator or a file.");
      }
    if (source != Source::generator)
      return;
    if (generator.cell_count > 0 && generator.cell_count < 8)
      section.at("Generator").refuse("Cell particles", "must be 0, or at least 8.");
    if (generator.says_faces && generator.faces == Faces::moulded && body == Body::cell)
      section.at("Generator").refuse("Faces", "a periodic cell has none: leave it out, or set Body = box.");
    if (generator.faces == Faces::moulded && body == Body::box && generator.cell_count > 0)
      section.at("Generator")
        .refuse("Cell particles", fmt::format("a moulded box{} is made in one piece: leave it out, or set Faces = cut.",
                                              generator.says_faces ? "" : ", which Faces has by default,"));
    if (dimension == 2)
      section.refuse(
        "Source",
        std::string(
          "the generator packs spheres, and Physics/Dimension is 2 or Particles = discs. Read the discs from a "
          "file") +
          (may_grow ? ", or grow them: Source = genesis." : "."));
    if (body == Body::cell)
      return;
    for (const double edge : box)
      if (edge < 2 * generator.radius)
        section.refuse("Box size",
                       fmt::format("no sphere of radius {} m fits in. Enlarge the box or check the units: metres.",
                                   generator.radius));
    // A specimen beyond this does not fit into the memory of one machine, and is far more likely a wrong unit.
    constexpr double most_particles = 1e9;
    const double     estimate       = 0.6 * box[0] * box[1] * box[2] /
                            (4.0 / 3.0 * 3.141592653589793 * generator.radius * generator.radius * generator.radius);
    if (estimate > most_particles)
      section.refuse(
        "Box size",
        fmt::format("would hold about {:.0e} spheres of radius {} m. Shrink it, or check the units: metres.", estimate,
                    generator.radius));
  }
} // namespace apps

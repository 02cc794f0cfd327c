#include "apps/scene/specimen_section.h"

#include "apps/scene/length_unit_entry.h"
#include "dem/packing/box_cell.h"

#include <fmt/format.h>

#include <filesystem>

namespace apps
{
  dem::CompactionParameters SpecimenSection::compaction() const
  {
    dem::CompactionParameters asked;
    asked.radius       = generator.radius;
    asked.seed         = static_cast<std::uint64_t>(generator.seed);
    asked.friction     = generator.friction;
    asked.damping      = generator.damping;
    asked.low_pressure = generator.pressure;
    if (generator.cell_count > 0)
      asked.count = static_cast<std::size_t>(generator.cell_count);
    else if (has_box() && !is_moulded())
      return dem::cell_for_box(asked, box_edges());
    return asked;
  }

  namespace
  {
    Section &declare_generator(Section &specimen, SpecimenSection::Generator &generator, const bool box)
    {
      using Faces    = SpecimenSection::Faces;
      Section &inner = specimen.section("Generator", "Random packing of equal spheres, compacted in a periodic cell");
      inner.number("Particle radius", generator.radius, "m", Range::positive(), Need::required)
        .means("Of every sphere");
      inner.integer("Cell particles", generator.cell_count, "", Range::between(0, 1e7), Need::optional)
        .means(
          "Spheres in the periodic cell, which is repeated to fill the box: its pattern repeats too, and cracks follow "
          "it; 1000 make its edge about ten diameters. 0: a box of up to " +
          std::to_string(dem::most_in_one_cell) +
          " spheres is filled in one piece, in some ten seconds; a larger one is filled with cells of so many; a "
          "periodic "
          "cell has 1000");
      inner.integer("Seed", generator.seed, "", Range::between(0, 9007199254740992.0), Need::optional)
        .means("Another seed gives another random packing; the same seed the same packing");
      inner.number("Friction coefficient", generator.friction, "-", Range::between(0, 10), Need::optional)
        .means("Between the spheres while they are compacted: 0 gives a packing fraction of 0.65, 0.1 0.61, 1 0.55");
      inner.number("Damping", generator.damping, "-", Range::from_up_to(0, 1), Need::optional)
        .means("Local damping while they are compacted; hardly matters for the result from 0.3 upwards, and takes "
               "longer the more there is");
      inner
        .number("Pressure", generator.pressure, "-", Range::from_up_to(1e-5, dem::CompactionParameters().high_pressure),
                Need::optional)
        .means(
          "Of the contacts, p 2r/k_n, in which the finished packing is left: with more of it spheres overlap more and "
          "have more neighbours");
      if (box)
        inner.choice("Faces", generator.faces, {{"cut", Faces::cut}, {"moulded", Faces::moulded}}, Need::optional)
          .means(
            "Of a box. cut: out of a periodic cell; particles wholly inside are kept, so that faces are ragged and "
            "sparse, and "
            "specimens of less than some twenty diameters weaker and softer than their inside; moulded: compacted "
            "between six smooth plates, a layer of particles against each, as a specimen comes out of a laboratory's "
            "mould; in one piece whatever its size");
      return inner;
    }
  } // namespace

  void SpecimenSection::declare(Section &root, const int &dimension, const Use &use)
  {
    const auto boxed = [this] { return source == Source::generator && body == Body::box; };
    body             = use.box ? Body::box : Body::cell;
    const auto read  = [this] { return source == Source::file; };

    Section &section = root.section("Specimen", "The particles: where they come from, and what is made of them");
    if (use.other_particles)
      section
        .choice("Source", source,
                {{"generator", Source::generator},
                 {"file", Source::file},
                 {"genesis", Source::genesis},
                 {"none", Source::none}},
                Need::required)
        .means(
          "generator: compact a random packing, tile and crop it; file: read a packing; genesis: grow particles of "
          "given sizes into a vessel; none: there are only those of section More particles");
    else
      section.choice("Source", source, {{"generator", Source::generator}, {"file", Source::file}}, Need::required)
        .means("generator: compact a random packing, tile and crop it; file: read a packing");
    section.file("File", file)
      .means(
        "Packing: HDF5, or text with a line \"x y z radius\" [m] per particle; a header may name other columns and "
        "units, x [mm], diameter. From the scene's folder")
      .only_if(read, "Specimen/Source = file");
    declare_packing_unit(section, length_unit).only_if(read, "Specimen/Source = file");
    if (use.box && use.cell)
      section.choice("Body", body, {{"box", Body::box}, {"cell", Body::cell}}, Need::optional)
        .means("box: a specimen with ends, gripped; cell: the periodic cell of the packing");
    if (use.box)
      section.vector("Box size", box, "m", Range::positive(), Need::required)
        .means(
          "Edges of the specimen: particles that lie wholly inside are kept; a periodic packing is repeated until "
          "it covers the box. "
          "May be left out for a file: its particles are then taken as they are. In two dimensions the third edge is "
          "not looked at")
        .only_if(boxed,
                 use.cell ? "Specimen/Source = generator and Specimen/Body = box" : "Specimen/Source = generator");
    if (use.inertia)
      section.number("Density", density, "kg/m^3", Range::positive(), Need::required)
        .means("Of the particles, not of the bulk: bulk density over packing fraction");
    if (use.other_particles)
      {
        interaction_ratio = 1;
        says_distance     = false;
      }
    section
      .number("Interaction ratio", interaction_ratio, "-", Range::between(1, 10),
              use.other_particles ? Need::optional : Need::required)
      .notes(says_distance)
      .means(use.other_particles ?
               "iota: particles closer than iota times the sum of their radii are linked, if the law bonds them; "
               "about 1.5 for concrete. A law without bonds does not ask for it" :
               "iota: particles closer than iota times the sum of their radii are linked; a constant of the material "
               "model, about 1.5");
    if (use.other_particles)
      section.number("Installation gap", installation_gap, "m", Range::at_least(0), Need::optional)
        .notes(says_distance)
        .means("Particles whose surfaces are nearer than this are linked as well, if the law bonds them");
    if (use.box)
      section
        .choice("Loose pieces", loose_pieces,
                {{"refuse", LoosePieces::refuse}, {"drop", LoosePieces::drop}, {"keep", LoosePieces::keep}},
                Need::optional)
        .means("What becomes of particles that are not linked to the rest, directly or over others. refuse: the scene "
               "is refused with their number; drop: the largest piece is the specimen; keep: they stay, and nothing "
               "holds them");
    section.number("Thickness", thickness, "m", Range::positive(), Need::required)
      .means("Of the discs")
      .only_if([&dimension] { return dimension == 2; }, "Physics/Dimension = 2");
    declare_generator(section, generator, use.box)
      .only_if([this] { return source == Source::generator; }, "Specimen/Source = generator");
    if (use.other_particles)
      genesis.declare(section, dimension, [this] { return source == Source::genesis; });
  }

  void SpecimenSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath section = root.at("Specimen");
    if (source == Source::file && !std::filesystem::is_regular_file(file))
      section.refuse("File",
                     "there is no such file (" + std::filesystem::absolute(file).lexically_normal().string() + ").");
    if (source == Source::genesis)
      genesis.check(section, dimension);
    if (source != Source::generator)
      return;
    if (generator.cell_count > 0 && generator.cell_count < 8)
      section.at("Generator").refuse("Cell particles", "must be 0, or at least 8.");
    if (generator.faces == Faces::moulded && body == Body::cell)
      section.at("Generator").refuse("Faces", "a periodic cell has none: leave it out, or set Body = box.");
    if (generator.faces == Faces::moulded && generator.cell_count > 0)
      section.at("Generator")
        .refuse("Cell particles", "a moulded box is made in one piece: leave it out, or set Faces = cut.");
    if (dimension == 2)
      section.refuse(
        "Source",
        "the generator packs spheres, and Physics/Dimension is 2 or Particles = discs. Read the discs from a file.");
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

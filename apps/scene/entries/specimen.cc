#include "apps/scene/entries/specimen.h"

#include "apps/scene/entries/genesis.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/section.h"
#include "dem/packing/box_cell.h"

namespace apps
{
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
          .notes(generator.says_faces)
          .means(
            "Of a box. cut: out of a periodic cell; particles wholly inside are kept, so that faces are ragged and "
            "sparse, and "
            "specimens of less than some twenty diameters weaker and softer than their inside; moulded: compacted "
            "between six smooth plates, a layer of particles against each, as a specimen comes out of a laboratory's "
            "mould; in one piece whatever its size");
      return inner;
    }

    void declare_source(Section &section, SpecimenSection::Source &source, const SpecimenSection::Use &use)
    {
      using Source              = SpecimenSection::Source;
      const char *const made    = "generator: compact a random packing, tile and crop it; file: read a packing";
      const char *const grown   = "; genesis: grow particles of given sizes into a vessel";
      const char *const without = "; none: there are only those of section More particles";
      const std::pair<const char *, Source> generator{"generator", Source::generator}, file{"file", Source::file},
        genesis{"genesis", Source::genesis}, none{"none", Source::none};
      if (use.other_particles)
        section.choice("Source", source, {generator, file, genesis, none}, Need::required)
          .means(std::string(made) + grown + without);
      else if (use.genesis)
        section.choice("Source", source, {generator, file, genesis}, Need::required).means(std::string(made) + grown);
      else
        section.choice("Source", source, {generator, file}, Need::required).means(made);
    }
  } // namespace

  void declare(Section &root, SpecimenSection &specimen, const int &dimension, const SpecimenSection::Use &use)
  {
    using Source      = SpecimenSection::Source;
    using LoosePieces = SpecimenSection::LoosePieces;
    using Body        = SpecimenSection::Body;
    const auto boxed  = [&specimen] { return specimen.source == Source::generator && specimen.body == Body::box; };
    specimen.body     = use.box ? Body::box : Body::cell;
    specimen.may_grow = use.genesis;
    if (use.laboratory)
      specimen.generator.faces = SpecimenSection::Faces::moulded;
    const auto read = [&specimen] { return specimen.source == Source::file; };

    Section &section = root.section("Specimen", "The particles: where they come from, and what is made of them");
    declare_source(section, specimen.source, use);
    section.file("File", specimen.file)
      .means(
        "Packing: HDF5, or text with a line \"x y z radius\" [m] per particle; a header may name other columns and "
        "units, x [mm], diameter. From the scene's folder")
      .only_if(read, "Specimen/Source = file");
    declare_packing_unit(section, specimen.length_unit).only_if(read, "Specimen/Source = file");
    if (use.box && use.cell)
      section.choice("Body", specimen.body, {{"box", Body::box}, {"cell", Body::cell}}, Need::optional)
        .means("box: a specimen with ends, gripped; cell: the periodic cell of the packing");
    if (use.box)
      section.vector("Box size", specimen.box, "m", Range::positive(), Need::required)
        .means(
          "Edges of the specimen: particles that lie wholly inside are kept; a periodic packing is repeated until "
          "it covers the box. "
          "May be left out for a file: its particles are then taken as they are. In two dimensions the third edge is "
          "ignored")
        .only_if(boxed,
                 use.cell ? "Specimen/Source = generator and Specimen/Body = box" : "Specimen/Source = generator");
    if (use.inertia)
      section.number("Density", specimen.density, "kg/m^3", Range::positive(), Need::required)
        .means("Of the particles, not of the bulk: bulk density over packing fraction");
    if (use.other_particles)
      {
        specimen.interaction_ratio = 1;
        specimen.says_distance     = false;
      }
    section
      .number("Interaction ratio", specimen.interaction_ratio, "-", Range::between(1, 10),
              use.other_particles ? Need::optional : Need::required)
      .notes(specimen.says_distance)
      .means(use.other_particles ?
               "iota: particles closer than iota times the sum of their radii are linked, if the law bonds them; "
               "about 1.5 for concrete. A law without bonds does not need it" :
               "iota: particles closer than iota times the sum of their radii are linked; a constant of the material "
               "model, about 1.5");
    if (use.other_particles)
      section.number("Installation gap", specimen.installation_gap, "m", Range::at_least(0), Need::optional)
        .notes(specimen.says_distance)
        .means("Particles whose surfaces are nearer than this are linked as well, if the law bonds them");
    if (use.box)
      section
        .choice("Loose pieces", specimen.loose_pieces,
                {{"refuse", LoosePieces::refuse}, {"drop", LoosePieces::drop}, {"keep", LoosePieces::keep}},
                Need::optional)
        .means("What becomes of particles that are not linked to the rest, directly or over others. refuse: the scene "
               "is refused with their number; drop: the largest piece is the specimen; keep: they stay, and nothing "
               "holds them");
    section.number("Thickness", specimen.thickness, "m", Range::positive(), Need::required)
      .means("Of the discs")
      .only_if([&dimension] { return dimension == 2; }, "Physics/Dimension = 2");
    declare_generator(section, specimen.generator, use.box)
      .only_if([&specimen] { return specimen.source == Source::generator; }, "Specimen/Source = generator");
    if (use.genesis)
      declare(
        section, specimen.genesis, [&specimen] { return specimen.source == Source::genesis; }, use.other_particles);
  }
} // namespace apps

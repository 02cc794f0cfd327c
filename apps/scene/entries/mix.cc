#include "apps/scene/entries/mix.h"

#include "apps/scene/number_list.h"
#include "apps/scene/section.h"
#include "apps/text/size_table.h"

namespace apps
{
  namespace
  {
    void declare_amounts(Section &section, MixSection &mix)
    {
      Section &of = section.section("Constituents", "One sub-section per material of a cubic metre of fresh concrete");
      of.named_list("CONSTITUENT", mix.constituents, &MixConstituent::name, [](Section &opened, MixConstituent &added) {
        opened.number("Mass", added.mass, "kg/m^3", Range::at_least(0), Need::required).means("Per volume of concrete");
        opened.number("Density", added.density, "kg/m^3", Range::positive(), Need::required)
          .means("Of the material itself");
        opened.flag("Aggregate", added.aggregate)
          .means("Sand or filler: part of the grading, finer than all classes with sizes");
        opened.number("Smallest size", added.smallest, "m", Range::at_least(0), Need::optional)
          .means("Of a class of aggregates");
        opened.number("Largest size", added.largest, "m", Range::at_least(0), Need::optional)
          .means("Of a class of aggregates; 0: of none");
      });
      section.number("Unit weight", mix.unit_weight, "kg/m^3", Range::at_least(0), Need::optional)
        .means("Of the fresh concrete, from which its voids follow; 0: not measured, Air counts");
      section.number("Air", mix.air, "-", Range::from_up_to(0, 1), Need::optional).means("Part of the volume");
      section.number("Content", mix.content, "-", Range::from_up_to(0, 1), Need::optional)
        .means("Aggregates of every size, part of the volume, where there are no Constituents");
    }

    void declare_grading(Section &section, MixSection &mix)
    {
      using Grading = MixSection::Grading;
      using Sizes   = MixSection::Sizes;
      const auto is = [&mix](const Grading grading) {
        return [&mix, grading] { return mix.given() && mix.grading == grading; };
      };
      const auto listed = [&mix] {
        return mix.given() && (mix.grading == Grading::passing || mix.grading == Grading::retained);
      };
      section
        .choice("Grading", mix.grading,
                {{"constituents", Grading::constituents},
                 {"passing", Grading::passing},
                 {"retained", Grading::retained},
                 {"file", Grading::file},
                 {"Fuller", Grading::fuller}},
                Need::optional)
        .means("constituents: their classes of sizes; passing or retained: Curve, of sieves; file: a table of one or "
               "the other; Fuller: "
               "(size/largest)^exponent. Linear in the logarithm of the size between sieves");
      declare_list(
        section, "Curve", [&mix](const std::string &text) { mix.curve = sieves_in_text(text); }, "m", Need::required)
        .means("sieve: part, sieve: part, ... in any order: what passes each sieve, or lies on it having passed the "
               "next coarser one; parts of "
               "1, or percent")
        .only_if(listed, "Mix/Grading = passing or retained");
      section.file("Curve file", mix.curve_file)
        .means("Table with the columns size and passing, or size and retained, as Specimen/Genesis/Size file; the "
               "finest sieve may let "
               "something pass")
        .only_if(is(Grading::file), "Mix/Grading = file");
      section.number("Fuller exponent", mix.fuller_exponent, "-", Range::between(0.1, 2), Need::optional)
        .means("Of Fuller's curve");
      section.number("Smallest aggregate", mix.smallest, "m", Range::at_least(0), Need::optional)
        .means("That is modelled; all finer ones belong to the mortar. 0: the specimen has no mix");
      section.number("Largest aggregate", mix.largest, "m", Range::at_least(0), Need::optional)
        .means("Of Fuller's curve");
      section.choice("Sizes", mix.sizes, {{"increments", Sizes::increments}, {"drawn", Sizes::drawn}}, Need::optional)
        .means("increments: by constant number increment, the same for every seed; drawn: from the density of numbers "
               "of each class");
      section.number("Increment", mix.increment, "m", Range::at_least(0), Need::optional)
        .means("First increment of sizes; 0: tuned until volume and curve are right");
    }

    void declare_places(Section &section, MixSection &mix, const std::string &places)
    {
      using Kind = dem::AggregateShape::Kind;
      section
        .choice("Shape", mix.shape.kind,
                {{"sphere", Kind::sphere}, {"ellipsoid", Kind::ellipsoid}, {"polyhedron", Kind::polyhedron}},
                Need::optional)
        .means("Of aggregates, each with the volume of the sphere of its size");
      section.number("Elongation", mix.shape.elongation, "-", Range::between(0.1, 1), Need::optional)
        .means("Middle over longest axis, of ellipsoids and polyhedra");
      section.number("Flatness", mix.shape.flatness, "-", Range::between(0.1, 1), Need::optional)
        .means("Shortest over middle axis");
      section.integer("Corners", mix.corners, "", Range::between(6, 24), Need::optional).means("Of polyhedra");
      section.number("Clearance", mix.clearance, "-", Range::between(0.001, 1), Need::optional)
        .means("Between two aggregates, at least this part of the sum of their radii");
      section.number("Distance", mix.distance, "m", Range::at_least(0), Need::optional)
        .means("Between two aggregates, at least");
      section.number("Wall distance", mix.wall, "m", Range::at_least(0), Need::optional)
        .means("Between an aggregate and a face of the box, at least; a periodic cell has none");
      section.integer("Seed", mix.seed, "", Range::between(0, 9007199254740992.0), Need::optional)
        .means("Another seed gives other places, and other drawn sizes")
        .only_if([&mix] { return mix.given(); }, "Mix/Smallest aggregate > 0");
      section.integer("Tries", mix.tries, "", Range::between(1, 1e9), Need::optional)
        .means("Places drawn for one aggregate before all begin anew");
      section.integer("Restarts", mix.restarts, "", Range::between(0, 1e6), Need::optional)
        .means("After these aggregates are placed smaller, and grow among each other");
      section.text("Mortar", mix.mortar, Need::optional).means("What it is called; with Materials the name of one");
      section.text("Aggregate", mix.aggregate, Need::optional).means("Likewise, of " + places);
    }
  } // namespace

  void declare_factors(Section              &mix,
                       const std::string    &name,
                       const std::string    &meaning,
                       dem::ConstantFactors &factors,
                       const bool            ductility)
  {
    Section &section = mix.section(name, meaning);
    section.number("Stiffness factor", factors.stiffness, "-", Range::positive(), Need::optional)
      .means("Of the mortar's moduli");
    section.number("Strength factor", factors.strength, "-", Range::positive(), Need::optional)
      .means("Of its strengths and cohesions; of its limit elastic strain this over the stiffness factor");
    if (ductility)
      section.number("Ductility factor", factors.ductility, "-", Range::positive(), Need::optional)
        .means("Of its relative ductility");
  }

  Section &declare_geometry(Section &section, MixSection &mix, const std::string &places)
  {
    Section &made = section.section("Mix", "Concrete: aggregates in mortar, from what is mixed");
    declare_amounts(made, mix);
    declare_grading(made, mix);
    declare_places(made, mix, places);
    return made;
  }

  void declare(Section &specimen, MixSection &mix)
  {
    Section &section = declare_geometry(specimen, mix, "particles that lie in an aggregate by half their radius");
    declare_factors(section, "Aggregates",
                    "Constants of links within an aggregate, where section Material is that of the mortar",
                    mix.aggregates);
    declare_factors(section, "Interface", "Likewise of links with one end in an aggregate, or both in different ones",
                    mix.interface);
  }
} // namespace apps

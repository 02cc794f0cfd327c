#include "apps/drivers/particles/laboratory_section.h"

#include <algorithm>

namespace apps
{
  void SpecimenTestSection::declare(Section &root)
  {
    Section &s = root.section("Laboratory",
                              "A test of a laboratory on the specimen: it brings its own platens, walls or membrane, "
                              "leads them, ends when it is over, and is read off in every step");
    s.choice("Test", test,
             {{"none", Test::none},
              {"uniaxial compression", Test::compression},
              {"direct tension", Test::tension},
              {"Brazilian splitting", Test::splitting},
              {"three-point bending", Test::bending},
              {"biaxial compression", Test::biaxial},
              {"triaxial compression", Test::triaxial}},
             Need::optional)
      .means("none: there is no test; biaxial: in the plane under a pressure across; triaxial: the same in space");
    declare_machine(s);
    declare_seating(s);
    declare_confinement(s);
    const auto any = [this] { return given(); };
    s.number("Stop at", asked.stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "Part of the largest stress: the test ends when the stress has fallen below for good; 0: however far it falls")
      .only_if(any, "Test is not none");
    s.number("Largest strain", asked.stop_strain, "-", Range::positive(), Need::required)
      .means("By the platens, at which the test ends at the latest")
      .only_if(any, "Test is not none");
    s.flag("Check speed", check_speed)
      .means("When the test is over, load once more at half the speed, from the state in which the loading began: a "
             "loading is quasi-static if that changes the strength by less than 2 %. Costs twice the loading besides")
      .only_if(any, "Test is not none");
    published.declare(s, any);
  }

  void SpecimenTestSection::declare_machine(Section &s)
  {
    const auto any     = [this] { return given(); };
    const auto platens = [this] { return presses(); };
    const auto flat    = [this] { return flat_platens(); };
    const auto outside = [this] { return flat_platens() && !at_vessel; };
    const auto bending = [this] { return test == Test::bending; };
    s.choice("Axis", asked.press.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
      .means("Along which the specimen is loaded")
      .only_if(any, "Test is not none");
    s.number("Speed", asked.speed, "m/s", Range::positive(), Need::required)
      .means("At which both sides come together, or part; grows from zero")
      .only_if(any, "Test is not none");
    s.integer("Ramp steps", asked.ramp_steps, "", Range::between(1, 1e9), Need::optional)
      .means("Over which the speed, or the confining pressure, grows from zero")
      .only_if(any, "Test is not none");
    s.choice("Moving sides", asked.press.both, {{"both", true}, {"high", false}}, Need::optional)
      .means("both: each at half the speed; high: that of the larger coordinates alone")
      .only_if(any, "Test is not none");
    contact.declare(s, platens, "Test is of platens or rollers");
    s.find_entry("Friction coefficient")->means("Of platens, walls and rollers");
    s.choice("Platens", at_vessel, {{"outermost particles", false}, {"vessel walls", true}}, Need::optional)
      .means(
        "Where they stand at first. vessel walls: where the walls of genesis stood; what was pressed into these is "
        "cut off, so that all that touched them touches the platens, and nothing pushes yet; stress is then that of "
        "the vessel's section")
      .only_if(flat, "Test is of platens");
    s.number("Smoothing depth", asked.press.smoothing, "m", Range::at_least(0), Need::optional)
      .means("By which the platens stand inside the outermost particles, at most half a radius: what reaches beyond is "
             "cut off, so that "
             "the specimen's ends are flat and nothing pushes yet")
      .only_if(outside, "Test is of platens, and Platens = outermost particles");
    s.number("Glued layer", asked.press.layer, "m", Range::positive(), Need::required)
      .means("Centres within it of the outermost centre are held by the platen")
      .only_if([this] { return test == Test::tension; }, "Test = direct tension");
    s.choice("Body axis", asked.press.along, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
      .means("Of a beam, between its supports; in space also of a disk that is split, its own")
      .only_if([this] { return test == Test::bending || test == Test::splitting; }, "Test is of a beam or a disk");
    s.number("Span", asked.press.span, "m", Range::positive(), Need::required)
      .means("Between the two supports")
      .only_if(bending, "Test = three-point bending");
    s.number("Roller radius", asked.press.roller, "m", Range::positive(), Need::required)
      .means("Of the supports and of the roller between them; polygons of 72 sides")
      .only_if(bending, "Test = three-point bending");
  }

  void SpecimenTestSection::declare_seating(Section &s)
  {
    const auto seats = [this] { return presses() && !confined(); };
    const auto rests = [this] { return presses(); };
    s.number("Seating stress", asked.seating_stress, "Pa", Range::at_least(0), Need::optional)
      .means("To which the platens come to sit, and the specimen to rest, before the loading; 0: they do not")
      .only_if(seats, "Test is of platens or rollers, without a confining pressure");
    s.number("Seating speed", asked.seating_speed, "m/s", Range::at_least(0), Need::optional)
      .means("0: Speed")
      .only_if(seats, "Test is of platens or rollers, without a confining pressure");
    s.number("Rest", asked.rest, "-", Range::positive(), Need::optional)
      .means(
        "Mean force on a particle over the mean sum of the forces that act on one, below which the specimen rests: "
        "after seating, and under the confining pressure before the loading")
      .only_if(rests, "Test is of platens or rollers");
    s.integer("Rest steps", asked.rest_steps, "", Range::between(1, 1e9), Need::optional)
      .means("After which the loading begins even so, and the summary says it")
      .only_if(rests, "Test is of platens or rollers");
  }

  void SpecimenTestSection::declare_confinement(Section &s)
  {
    using Confinement    = dem::LabParameters::Confinement;
    const auto  within   = [this] { return confined(); };
    const auto  membrane = [this] { return confined() && asked.confinement == Confinement::membrane; };
    const char *words    = "Test is biaxial or triaxial compression";
    s.choice("Confinement", asked.confinement,
             {{"walls", Confinement::walls}, {"membrane", Confinement::membrane}, {"cylinder", Confinement::cylinder}},
             Need::optional)
      .means("walls: rigid ones across all other axes, each held at the pressure by a servo; membrane: the pressure "
             "acts on the outermost particles, whatever the shape of the specimen; cylinder: rigid facets around a "
             "cylinder, that all move alike and hold the mean pressure")
      .only_if(within, words);
    s.number("Confining pressure", asked.pressure, "Pa", Range::positive(), Need::required)
      .means("Across the axis; before the loading along it as well")
      .only_if(within, words);
    s.number("Largest wall speed", asked.largest_speed, "m/s", Range::at_least(0), Need::optional)
      .means("Of walls and platens that are held at a pressure; 0: Speed")
      .only_if(within, words);
    s.number("Gain", asked.gain, "-", {std::numeric_limits<double>::min(), 1.0, false}, Need::optional)
      .means("Part of what the force of such a wall lacks that a step makes good, by the stiffness of its contacts")
      .only_if(within, words);
    s.number("Membrane ball", asked.ball, "m", Range::at_least(0), Need::optional)
      .means("Radius of the ball that finds the particles under the membrane: it rolls around the specimen; 0: half "
             "the mean diameter")
      .only_if(membrane, "Confinement = membrane");
    s.integer("Membrane steps", asked.membrane_steps, "", Range::between(1, 1e9), Need::optional)
      .means("After which the membrane is laid anew")
      .only_if(membrane, "Confinement = membrane");
  }

  void SpecimenTestSection::check(const base::EntryPath          &root,
                                  const SpecimenSection          &specimen,
                                  const dem::Physics             &physics,
                                  const std::vector<std::string> &other) const
  {
    if (!given())
      return;
    const base::EntryPath s     = root.at("Laboratory");
    const bool            plane = physics.dimension == 2;
    if (at_vessel && flat_platens() && specimen.source != SpecimenSection::Source::genesis)
      s.refuse("Platens", "only a specimen of Specimen/Source = genesis has a vessel.");
    if (test == Test::biaxial && !plane)
      s.refuse("Test", "a biaxial test is one of the plane, and Physics/Dimension is 3. Take the triaxial one.");
    if (test == Test::triaxial && plane)
      s.refuse("Test", "a triaxial test is one of space, and Physics/Dimension is 2. Take the biaxial one.");
    if (test == Test::biaxial && asked.confinement == dem::LabParameters::Confinement::cylinder)
      s.refuse("Confinement", "in the plane there are walls or a membrane, no cylinder.");
    if (plane && asked.press.axis == 2)
      s.refuse("Axis", "in two dimensions the axes are x and y.");
    const bool bodied = test == Test::bending || (test == Test::splitting && !plane);
    if (bodied && plane && asked.press.along == 2)
      s.refuse("Body axis", "in two dimensions the axes are x and y.");
    if (bodied && asked.press.along == asked.press.axis)
      s.refuse("Body axis", "is the axis of the load.");
    for (const postprocess::SeriesColumn &column : columns())
      if (std::find(other.begin(), other.end(), column.name) != other.end())
        s.refuse("Test", "it adds a column \"" + column.name +
                           "\" to series.csv, and a probe has that name. Rename the probe.");
  }

  dem::LabParameters SpecimenTestSection::parameters(const dem::Vessel &vessel, const double thickness) const
  {
    dem::LabParameters made = asked;
    made.press.contact      = contact.materials();
    if (at_vessel && flat_platens())
      {
        const int axis   = asked.press.axis;
        made.press.stand = {0.0, vessel.size[axis]};
        // Across another axis a cylinder has no one section.
        if (vessel.shape == dem::Vessel::Shape::box || axis == 2)
          made.section = vessel.space() / vessel.size[axis] * (vessel.dimension == 2 ? thickness : 1.0);
      }
    using Kind = dem::LabParameters::Test;
    made.test  = test == Test::tension   ? Kind::tension :
                 test == Test::splitting ? Kind::splitting :
                 test == Test::bending   ? Kind::bending :
                 confined()              ? Kind::confined :
                                           Kind::compression;
    return made;
  }

  const char *SpecimenTestSection::name() const
  {
    switch (test)
      {
      case Test::compression:
        return "uniaxial compression";
      case Test::tension:
        return "direct tension";
      case Test::splitting:
        return "Brazilian splitting";
      case Test::bending:
        return "three-point bending";
      case Test::biaxial:
        return "biaxial compression";
      case Test::triaxial:
        return "triaxial compression";
      default:
        return "none";
      }
  }

  std::vector<postprocess::SeriesColumn> SpecimenTestSection::columns() const
  {
    if (!given())
      return {};
    std::vector<postprocess::SeriesColumn> all = {
      {"strain", "-"},         {"stress", "Pa"},      {"force_low", "N"}, {"force_high", "N"},    {"gauge_strain", "-"},
      {"lateral_strain", "-"}, {"confinement", "Pa"}, {"test_stage", ""}, {"broken_elements", ""}};
    return all;
  }

  std::vector<double> SpecimenTestSection::row(const dem::LabTest &test)
  {
    const dem::LabReading &now = test.reading();
    return {now.strain,       now.stress,         now.low,         now.high,
            now.gauge_strain, now.lateral_strain, now.confinement, static_cast<double>(test.stage()),
            now.breaks};
  }
} // namespace apps

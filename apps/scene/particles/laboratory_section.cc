#include "apps/scene/particles/laboratory_section.h"

#include "apps/scene/entries/contact_law.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/particles/published_figures.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    void declare_machine(Section &s, SpecimenTestSection &specimen_test)
    {
      using Test = SpecimenTestSection::Test;
      const Condition any{[&specimen_test] { return specimen_test.given(); }, "Test is not none"};
      const auto      platens = [&specimen_test] { return specimen_test.presses(); };
      const auto      flat    = [&specimen_test] { return specimen_test.flat_platens(); };
      const auto      outside = [&specimen_test] { return specimen_test.flat_platens() && !specimen_test.at_vessel; };
      const auto      glued   = [&specimen_test] { return specimen_test.test == Test::tension; };
      const auto      bending = [&specimen_test] { return specimen_test.test == Test::bending; };
      s.choice("Axis", specimen_test.requested.press.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
        .means("Along which the specimen is loaded")
        .only_if(any);
      s.number("Speed", specimen_test.requested.speed, "m/s", Range::positive(), Need::required)
        .means("At which both sides come together, or part; grows from zero")
        .only_if(any);
      s.integer("Ramp steps", specimen_test.requested.ramp_steps, "", Range::between(1, 1e9), Need::optional)
        .means("Over which the speed, or the confining pressure, grows from zero")
        .only_if(any);
      s.choice("Moving sides", specimen_test.requested.press.both, {{"both", true}, {"high", false}}, Need::optional)
        .means("both: each at half the speed; high: that of the larger coordinates alone")
        .only_if(any);
      declare(s, specimen_test.contact, platens, "Test is of platens or rollers");
      s.find_entry("Friction coefficient")->means("Of platens, walls and rollers");
      s.choice("Platens", specimen_test.at_vessel, {{"outermost particles", false}, {"vessel walls", true}},
               Need::optional)
        .means(
          "Where they stand at first. vessel walls: where the walls of genesis stood; what was pressed into these is "
          "cut off, so that all that touched them touches the platens, and nothing pushes yet; stress is then that of "
          "the vessel's section")
        .only_if(flat, "Test is of platens");
      s.number("Smoothing depth", specimen_test.requested.press.smoothing, "m", Range::at_least(0), Need::optional)
        .means(
          "By which the platens stand inside the outermost particles, at most half a radius: what reaches beyond is "
          "cut off, so that "
          "the specimen's ends are flat and nothing pushes yet")
        .only_if(outside, "Test is of platens, and Platens = outermost particles");
      s.number("Glued layer", specimen_test.requested.press.layer, "m", Range::positive(), Need::required)
        .means("Centres within it of the outermost centre are held by the platen")
        .only_if(glued, "Test = direct tension");
      s.flag("Platens turn", specimen_test.requested.press.turns)
        .means("Each glued platen turns about its middle, as on a spherical seat; otherwise both stay parallel")
        .only_if(glued, "Test = direct tension");
      s.choice("Body axis", specimen_test.requested.press.along, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
        .means("Of a beam, between its supports; in space also of a disk that is split, its own")
        .only_if(
          [&specimen_test] { return specimen_test.test == Test::bending || specimen_test.test == Test::splitting; },
          "Test is of a beam or a disk");
      s.number("Span", specimen_test.requested.press.span, "m", Range::positive(), Need::required)
        .means("Between the two supports")
        .only_if(bending, "Test = three-point bending");
      s.number("Roller radius", specimen_test.requested.press.roller, "m", Range::positive(), Need::required)
        .means("Of the supports and of the roller between them; polygons of 72 sides")
        .only_if(bending, "Test = three-point bending");
    }

    void declare_seating(Section &s, SpecimenTestSection &specimen_test)
    {
      const Condition seats{[&specimen_test] { return specimen_test.presses() && !specimen_test.confined(); },
                            "Test is of platens or rollers, without a confining pressure"};
      const auto      rests = [&specimen_test] { return specimen_test.presses(); };
      s.number("Seating stress", specimen_test.requested.seating_stress, "Pa", Range::at_least(0), Need::optional)
        .means("To which the platens come to sit, and the specimen to rest, before the loading; 0: they do not")
        .only_if(seats);
      s.number("Seating speed", specimen_test.requested.seating_speed, "m/s", Range::at_least(0), Need::optional)
        .means("0: Speed")
        .only_if(seats);
      s.number("Rest", specimen_test.requested.rest, "-", Range::positive(), Need::optional)
        .means(
          "Mean force on a particle over the mean sum of the forces that act on one, below which the specimen rests: "
          "after seating, and under the confining pressure before the loading")
        .only_if(rests, "Test is of platens or rollers");
      s.integer("Rest steps", specimen_test.requested.rest_steps, "", Range::between(1, 1e9), Need::optional)
        .means("After which the loading begins even so, and the summary says it")
        .only_if(rests, "Test is of platens or rollers");
    }

    void declare_confinement(Section &s, SpecimenTestSection &specimen_test)
    {
      using Confinement   = dem::LabParameters::Confinement;
      const auto within   = [&specimen_test] { return specimen_test.confined(); };
      const auto membrane = [&specimen_test] {
        return specimen_test.confined() && specimen_test.requested.confinement == Confinement::membrane;
      };
      const char *words = "Test is biaxial or triaxial compression";
      s.choice(
         "Confinement", specimen_test.requested.confinement,
         {{"walls", Confinement::walls}, {"membrane", Confinement::membrane}, {"cylinder", Confinement::cylinder}},
         Need::optional)
        .means("walls: rigid ones across all other axes, each held at the pressure by a servo; membrane: the pressure "
               "acts on the outermost particles, whatever the shape of the specimen; cylinder: rigid facets around a "
               "cylinder, that all move alike and hold the mean pressure")
        .only_if(within, words);
      s.number("Confining pressure", specimen_test.requested.pressure, "Pa", Range::positive(), Need::required)
        .means("Across the axis; before the loading along it as well")
        .only_if(within, words);
      s.number("Largest wall speed", specimen_test.requested.largest_speed, "m/s", Range::at_least(0), Need::optional)
        .means("Of walls and platens that are held at a pressure; 0: Speed")
        .only_if(within, words);
      s.number("Gain", specimen_test.requested.gain, "-", {std::numeric_limits<double>::min(), 1.0, false},
               Need::optional)
        .means("Part of what the force of such a wall lacks that a step makes good, by the stiffness of its contacts")
        .only_if(within, words);
      s.number("Membrane ball", specimen_test.requested.ball, "m", Range::at_least(0), Need::optional)
        .means("Radius of the ball that finds the particles under the membrane: it rolls around the specimen; 0: half "
               "the mean diameter")
        .only_if(membrane, "Confinement = membrane");
      s.integer("Membrane steps", specimen_test.requested.membrane_steps, "", Range::between(1, 1e9), Need::optional)
        .means("After which the membrane is laid anew")
        .only_if(membrane, "Confinement = membrane");
    }
  } // namespace

  void declare(Section &root, SpecimenTestSection &specimen_test)
  {
    using Test = SpecimenTestSection::Test;
    Section &s = root.section("Laboratory",
                              "A test of a laboratory on the specimen: it brings its own platens, walls or membrane, "
                              "leads them, ends when it is over, and is read off in every step");
    s.choice("Test", specimen_test.test,
             {{"none", Test::none},
              {"uniaxial compression", Test::compression},
              {"direct tension", Test::tension},
              {"Brazilian splitting", Test::splitting},
              {"three-point bending", Test::bending},
              {"biaxial compression", Test::biaxial},
              {"triaxial compression", Test::triaxial}},
             Need::optional)
      .means("none: there is no test; biaxial: in the plane under a pressure across; triaxial: the same in space");
    declare_machine(s, specimen_test);
    declare_seating(s, specimen_test);
    declare_confinement(s, specimen_test);
    const auto any = [&specimen_test] { return specimen_test.given(); };
    s.number("Stop at", specimen_test.requested.stop_fraction, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "Part of the largest stress: the test ends when the stress has fallen below for good; 0: however far it falls")
      .only_if(any, "Test is not none");
    s.number("Largest strain", specimen_test.requested.stop_strain, "-", Range::positive(), Need::required)
      .means("By the platens, at which the test ends at the latest")
      .only_if(any, "Test is not none");
    s.flag("Check speed", specimen_test.check_speed)
      .means("When the test is over, load once more at half the speed, from the state in which the loading began: a "
             "loading is quasi-static if that changes the strength by less than 2 %. Costs twice the loading besides")
      .only_if(any, "Test is not none");
    declare(s, specimen_test.published, any);
  }
} // namespace apps

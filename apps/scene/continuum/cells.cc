#include "apps/scene/continuum/cells.h"

#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &block, CellsModel &cells)
  {
    const auto  in_motion = [&cells] { return cells.moves; };
    const auto  at_rest   = [&cells] { return !cells.moves; };
    const char *when      = "Answer = motion";
    const char *otherwise = "Answer = equilibrium";
    for (const char *number : {"Promotion", "Tolerance", "Growth step", "Contact reach"})
      block.find_entry(number)->only_if(at_rest, otherwise);
    block.choice("Answer", cells.moves, {{"equilibrium", false}, {"motion", true}}, Need::optional)
      .means(
        "equilibrium: of the particles at each strain; motion: they have inertia, and take steps while an explicit "
        "solid takes one (no promotion, no tangent)");
    block.number("Particle density", cells.density, "kg/m^3", Range::positive(), Need::required)
      .means("Of the particles, not of the bulk")
      .only_if(in_motion, when);
    block.number("Particle damping", cells.damping, "-", Range::from_up_to(0, 1), Need::optional)
      .means("Local (Cundall) damping of their motion about the cell's")
      .only_if(in_motion, when);
    block.integer("Particle steps", cells.steps, "", Range::between(0, 1e6), Need::optional)
      .means("In one of the solid; 0: as many as their stable step requires, and two at least: in the last one the "
             "cell stays as it "
             "is, so that its stress is that of the new strain. 1: the stress is one step old, as published")
      .only_if(in_motion, when);
    block.flag("From the start", cells.from_start)
      .means("The particles of all cells answer from the first step on; for comparison, and for laws that are not "
             "linear to begin with")
      .only_if(at_rest, otherwise);
    block.flag("Elastic by solving", cells.only_solved)
      .means("Promoted cells solve for equilibrium also where no link has damaged or slid; for comparison of costs")
      .only_if(at_rest, otherwise);
    block.integer("Packings", cells.packings, "", Range::between(1, 1e6), Need::optional)
      .means(
        "Different packings of the generator, with seeds from its own on; the points of the mesh take them in turn");
    block
      .choice("When localised", cells.localised,
              {{"stop", coupling::Localised::stop},
               {"crack band", coupling::Localised::crack_band},
               {"refuse", coupling::Localised::refuse},
               {"go on", coupling::Localised::go_on}},
              Need::optional)
      .means(
        "What becomes of a cell whose tangent has lost ellipticity; in motion, one whose damage has gathered in a "
        "band since its stress began to fall. stop: the run ends with that state; crack "
        "band: it goes on as a layer of its element, the rest of which unloads; refuse: the solver seeks "
        "another state with shorter steps; go on: what follows depends on the size of the elements. In motion stop "
        "or go on");
    block.flag("Rotations", cells.rotations).means("Particles spin; off: they only translate");
    SpecimenSection::Use use;
    use.inertia = use.box = false;
    use.cell              = true;
    block.choice("Particles", cells.dimension, {{"spheres", 3}, {"discs", 2}}, Need::optional)
      .means("discs: of a plane model, read from a file; the model is then neither in plane strain nor in plane "
             "stress, but as "
             "the discs are");
    declare(block, cells.source, cells.dimension, use);
    block.find_section("Specimen")
      ->find_entry("Thickness")
      ->only_if([&cells] { return cells.dimension == 2; }, "Particles = discs");
    declare(*block.find_section("Specimen"), cells.mix);
    declare(block, cells.material, false);
  }
} // namespace apps

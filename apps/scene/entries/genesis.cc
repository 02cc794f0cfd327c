#include "apps/scene/entries/genesis.h"

#include "apps/scene/number_list.h"
#include "apps/scene/section.h"
#include "apps/text/size_table.h"
#include "base/errors.h"
#include "dem/model/packing.h"

#include <limits>

namespace apps
{
  namespace
  {
    void declare_sizes(Section &section, GenesisSection &of)
    {
      const auto of_kind = [&of](const GenesisSection::Sizes kind) { return [&of, kind] { return of.sizes == kind; }; };
      section
        .choice("Sizes", of.sizes,
                {{"classes", GenesisSection::Sizes::classes},
                 {"file", GenesisSection::Sizes::file},
                 {"uniform", GenesisSection::Sizes::uniform}},
                Need::optional)
        .means("classes: diameters and fractions of the solid area (volume), listed in the scene; file: a table of "
               "these; uniform: radii evenly spread about a mean one");
      declare_list(
        section, "Classes", [&of](const std::string &text) { of.classes = size_classes_in_text(text); }, "m",
        Need::required)
        .means("diameter: fraction, diameter: fraction, ... [m], or smallest-largest: fraction; fractions of area (in "
               "space of volume) sum up to 1")
        .only_if(of_kind(GenesisSection::Sizes::classes), "Specimen/Genesis/Sizes = classes");
      section.file("Size file", of.file)
        .means(
          "Table with the columns diameter and fraction; or smallest, largest and fraction; or of a sieve curve "
          "size and passing (finer than the sieve), or size and retained (on the sieve, passing the next larger "
          "one), rows in any order; parts of 1, [%] or masses [g]. Lengths in m, or the unit in the header: size [mm]")
        .only_if(of_kind(GenesisSection::Sizes::file), "Specimen/Genesis/Sizes = file");
      section.number("Size factor", of.size_factor, "-", Range::positive(), Need::optional)
        .means("All diameters of classes or file times this: the scale of the particles");
      section.number("Mean radius", of.mean_radius, "m", Range::positive(), Need::required)
        .means("Of uniform sizes; decides how many particles there are")
        .only_if(of_kind(GenesisSection::Sizes::uniform), "Specimen/Genesis/Sizes = uniform");
      section
        .number("Size tolerance", of.size_tolerance, "-", {std::numeric_limits<double>::min(), 1, false},
                Need::optional)
        .means("Part of the solid (of aggregates: of the section) by which a class may miss its fraction, because "
               "particles are whole; beyond it the vessel is too small for the sizes");
      section.number("Radius ratio", of.radius_ratio, "-", Range::at_least(1), Need::optional)
        .means("Largest over smallest radius of uniform sizes");
    }

    void declare_growth(Section &section, dem::GenesisParameters &g)
    {
      section.number("Effective modulus", g.material.contact.effective_modulus, "Pa", Range::positive(), Need::required)
        .means("E* of linear contacts of particles, and of these with walls, during genesis");
      section.number("Stiffness ratio", g.material.contact.stiffness_ratio, "-", Range::positive(), Need::optional)
        .means("k_n/k_s of these");
      section
        .number("Friction coefficient", g.material.contact.friction_coefficient, "-", Range::at_least(0),
                Need::optional)
        .means("Between particles, once they have grown; walls have none");
      section.number("Growth friction", g.growth_friction, "-", Range::at_least(0), Need::optional)
        .means("The same while they grow; without any they become denser");
      section.number("Damping", g.material.damping, "-", Range::from_up_to(0, 1), Need::optional)
        .means("Local damping");
      section.integer("Increments", g.increments, "", Range::between(1, 1e6), Need::optional)
        .means("Of radii from half to full size");
      section.number("Increment ratio", g.increment_ratio, "-", Range::positive(), Need::optional)
        .means("Unbalanced ratio that an increment ends with");
      section.integer("Increment steps", g.increment_steps, "", Range::between(1, 1e9), Need::optional)
        .means("At most for one increment");
      section.number("Ratio", g.ratio, "-", Range::positive(), Need::optional)
        .means("Unbalanced ratio that stages end with");
      section.integer("Solve steps", g.solve_steps, "", Range::between(1, 1e9), Need::optional)
        .means("At most, to get there once");
      section.number("Stress", g.stress, "Pa", Range::at_least(0), Need::required)
        .means("Low isotropic pressure that all radii are changed for at last; a hundredth of the strength at most. 0: "
               "they stay as the porosity has them");
      section.number("Stress tolerance", g.stress_tolerance, "-", Range::positive(), Need::optional)
        .means("Of the stress, over it");
      section.integer("Stress rounds", g.stress_rounds, "", Range::between(1, 1e6), Need::optional)
        .means("Changes of the radii at most, to get there");
      section.flag("Fit floaters", g.fit_floaters)
        .means("Enlarge particles with too few contacts until they have enough");
      section.number("Floaters allowed", g.floaters_allowed, "-", Range::between(0, 1), Need::optional)
        .means("Part of the particles that may have fewer than three contacts");
      section.integer("Floater rounds", g.floater_rounds, "", Range::between(1, 1000), Need::optional).means("At most");
    }
  } // namespace

  void declare(Section &genesis, AggregatesSection &aggregates)
  {
    Section &section =
      genesis.section("Aggregates", "Polygons in the plane, whose particles move as rigid bodies of the "
                                    "polygons' mass and inertia");
    const auto there = [&aggregates] { return aggregates.given(); };
    section.number("Content", aggregates.content, "-", Range::between(0, 1), Need::optional)
      .means("Part of the volume that is aggregate of any size, for Walraven's grading of a plane section; 0: none");
    declare_numbers(section, "Sizes", aggregates.bounds, "m", "numbers", Need::required)
      .means("Bounds of the classes of diameters that are modelled, ascending, between commas [m]; the last is the "
             "largest of the grading")
      .only_if(there, "Specimen/Genesis/Aggregates/Content > 0");
    section.integer("Fewest corners", aggregates.fewest_corners, "", Range::between(3, 20), Need::optional)
      .means("Of a polygon");
    section.integer("Most corners", aggregates.most_corners, "", Range::between(3, 20), Need::optional)
      .means("Of a polygon");
    section.number("Clearance", aggregates.clearance, "m", Range::at_least(0), Need::optional)
      .means("Between two, at least");
    section.flag("Middle sizes", aggregates.middle_sizes)
      .means("All of a class have its middle diameter; off: diameters are evenly spread over it");
    section.text("Mortar material", aggregates.mortar, Need::optional)
      .means("Section in Materials, of particles between them");
    section.text("Aggregate material", aggregates.aggregate, Need::optional)
      .means("Section in Materials, of their pebbles");
  }

  void declare(Section &specimen, GenesisSection &genesis, const std::function<bool()> &chosen, const bool rigid_bodies)
  {
    genesis.growth.material.contact.friction_coefficient = 0.1;
    Section &section                                     = specimen.section(
                                          "Genesis",
                                          "Particles of given sizes, put into a vessel at half size and grown until they touch under a low stress");
    section.only_if(chosen, "Specimen/Source = genesis");
    section
      .choice("Vessel", genesis.growth.vessel.shape,
              {{"box", dem::Vessel::Shape::box}, {"cylinder", dem::Vessel::Shape::cylinder}}, Need::optional)
      .means("box: with a corner in the origin, in the plane a window; cylinder: upright in such a box");
    section.vector("Size", genesis.size, "m", Range::at_least(0), Need::required)
      .means("Edges of the vessel; the third does not count in the plane");
    declare_sizes(section, genesis);
    section.number("Porosity", genesis.porosity, "-", Range::from_up_to(0, 1), Need::optional)
      .means("At full size, before the stress is set: how many particles there are");
    section.number("Laboratory porosity", genesis.laboratory_porosity, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "n of the material, in space, in place of Porosity: discs then have 0.42 n^2 + 0.25 n (Wang et al. 2014), e.g. "
        "0.22: 0.075; 0: Porosity counts");
    section.integer("Seed", genesis.seed, "", Range::between(0, 9007199254740992.0), Need::optional)
      .means("Another seed gives another packing; the same seed the same packing");
    declare_growth(section, genesis.growth);
    if (rigid_bodies)
      declare(section, genesis.aggregates);
  }
} // namespace apps

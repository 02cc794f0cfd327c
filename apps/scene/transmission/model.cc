#include "apps/scene/transmission/model.h"

#include "apps/runs/transmission/methods.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, TransmissionModel &model)
  {
    Section &s = root.section("Waves", "Packets of waves that run through particles and on into a continuum");
    s.choice("Medium", model.common.medium.lattice,
             {{"chain", coupling::WaveMedium::Lattice::chain},
              {"strip", coupling::WaveMedium::Lattice::strip},
              {"plane", coupling::WaveMedium::Lattice::plane},
              {"bar", coupling::WaveMedium::Lattice::bar}},
             Need::optional)
      .means("Particles in a row, in hexagonal rows of an unbounded plane for waves along them, the same for narrow "
             "packets of any "
             "direction, or spheres without order in a bar");
    s.number("Spacing", model.common.medium.spacing, "m", Range::positive(), Need::optional).means("Of neighbours");
    s.number("Normal modulus", model.common.medium.modulus, "Pa", Range::positive(), Need::required)
      .means("Of the links");
    s.number("Density", model.common.medium.density, "kg/m^3", Range::positive(), Need::required)
      .means("Of the medium, voids included; the continuum has the same");
    s.integer("Rows", model.common.medium.rows, "-", Range::between(2, 1000), Need::optional)
      .means("Of a strip, from one line of symmetry to the other")
      .only_if([&model] { return model.common.medium.lattice == coupling::WaveMedium::Lattice::strip; },
               "Medium = strip");
    const auto of_bar = [&model] { return model.common.medium.lattice == coupling::WaveMedium::Lattice::bar; };
    s.integer("Width", model.common.medium.width, "-", Range::between(1, 64), Need::optional)
      .means("Of a bar, in elements")
      .only_if(of_bar, "Medium = bar");
    s.number("Shear ratio", model.common.medium.shear_ratio, "-", Range::positive(), Need::optional)
      .means("Of the links of spheres, shear over normal modulus")
      .only_if(of_bar, "Medium = bar");
    s.number("Scatter", model.common.medium.scatter, "-", Range::between(0, 0.9), Need::optional)
      .means("Of the links' stiffness: anywhere between 1 - Scatter and 1 + Scatter of what the normal modulus gives")
      .only_if([of_bar] { return !of_bar(); }, "Medium = chain, strip or plane");
    s.integer("Seed", model.common.medium.seed, "-", Range::between(0, 1000000), Need::optional)
      .means("Of the spheres' packing, and of what Scatter says");
    s.flag("Shear", model.common.shear).means("Waves of shear, not of compression; in a strip");
    declare_numbers(s, "Wavelengths", model.wavelengths, "m", "numbers", Need::required)
      .means("[m], four spacings at least, separated by commas");
    declare_names(s, "Methods", model.methods, Need::optional)
      .means("Of the coupling, separated by commas: " + wave_method_names());
    s.integer("Element size", model.common.element, "-", Range::between(1, 64), Need::optional)
      .means("Of the continuum, over the spacing");
    s.integer("Overlap", model.common.overlap, "-", Range::between(1, 64), Need::optional)
      .means("Where both fill the same space, in elements");
    s.choice("Node masses", model.common.nearest_masses, {{"rows", false}, {"nearest", true}}, Need::optional)
      .means(
        "Of the continuum in the overlap: sums over rows of the consistent mass, which keep its centre, or what lies "
        "nearest to the node, as the published tables have it");
    s.number("Step factor", model.common.step_factor, "-", Range::from_up_to(1e-3, 1), Need::optional)
      .means("Time step over the stable one of the particles");
    s.number("Layer", model.proportions.layer, "-", Range::at_least(0), Need::optional)
      .means("How far absorbers reach into the particles, in elements");
    s.number("Rate", model.proportions.rate, "-", Range::at_least(0), Need::optional)
      .means("Of absorbers at its largest, times element size over speed of compression waves");
    s.number("Grid", model.proportions.grid, "-", Range::between(0.1, 10), Need::optional)
      .means("Of the absorbers' averages, in elements");
    s.number("Phase", model.proportions.phase, "-", Range::from_up_to(0.1, 2), Need::optional)
      .means(
        "Longest time that absorbers damp at once, times their largest eigenvalue; less is nearer to the exponential");
    s.number("Angle", model.degrees, "-", Range::between(0, 60), Need::optional)
      .means("Of the packets' way with the normal of the overlap, in degrees")
      .only_if([&model] { return model.common.medium.lattice == coupling::WaveMedium::Lattice::plane; },
               "Medium = plane");
  }
} // namespace apps

#include "apps/runs/particles/laboratory_section.h"

#include <algorithm>

namespace apps
{
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
    if (test == Test::biaxial && requested.confinement == dem::LabParameters::Confinement::cylinder)
      s.refuse("Confinement", "in the plane there are walls or a membrane, no cylinder.");
    if (plane && requested.press.axis == 2)
      s.refuse("Axis", "in two dimensions the axes are x and y.");
    const bool bodied = test == Test::bending || (test == Test::splitting && !plane);
    if (bodied && plane && requested.press.along == 2)
      s.refuse("Body axis", "in two dimensions the axes are x and y.");
    if (bodied && requested.press.along == requested.press.axis)
      s.refuse("Body axis", "is the axis of the load.");
    for (const postprocess::SeriesColumn &column : columns())
      if (std::find(other.begin(), other.end(), column.name) != other.end())
        s.refuse("Test", "it adds a column \"" + column.name +
                           "\" to series.csv, and a probe has that name. Rename the probe.");
  }

  dem::LabParameters SpecimenTestSection::parameters(const dem::Vessel &vessel, const double thickness) const
  {
    dem::LabParameters made = requested;
    made.press.contact      = contact.materials();
    if (at_vessel && flat_platens())
      {
        const int axis   = requested.press.axis;
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

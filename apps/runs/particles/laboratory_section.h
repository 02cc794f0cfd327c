#pragma once

#include "apps/models/contact_law.h"
#include "apps/models/specimen.h"
#include "apps/runs/particles/published_figures.h"
#include "base/entry_path.h"
#include "dem/genesis/vessel.h"
#include "dem/laboratory/lab_test.h"
#include "postprocess/files/series.h"

#include <string>
#include <vector>

namespace apps
{
  /** Section "Laboratory" of scenes of kind "particles": a test of a laboratory on the specimen (doc/theory/laboratory.md). */
  struct SpecimenTestSection
  {
    enum class Test
    {
      none,
      compression,
      tension,
      splitting,
      bending,
      biaxial,
      triaxial
    };

    Test               test = Test::none;
    dem::LabParameters requested;
    ContactLaw         contact; ///< of platens, walls and rollers with particles
    PublishedFigures   published;
    bool               check_speed = false; ///< load once more at half the speed, from where the loading began
    bool               at_vessel   = false; ///< platens stand where the walls stood in which the specimen grew

    /** @param other names of columns that the series has already @throws base::InputError. */
    void check(const base::EntryPath          &root,
               const SpecimenSection          &specimen,
               const dem::Physics             &physics,
               const std::vector<std::string> &other) const;
    bool given() const { return test != Test::none; }
    bool confined() const { return test == Test::biaxial || test == Test::triaxial; }
    /** @param vessel in which the specimen grew @param thickness of discs [m] @pre given() */
    dem::LabParameters parameters(const dem::Vessel &vessel, double thickness) const;
    bool               presses() const { return given() && test != Test::tension; }
    bool               flat_platens() const { return presses() && test != Test::bending; }
    const char        *name() const; ///< "uniaxial compression"

    /** Columns that it adds to the series; none where there is no test. */
    std::vector<postprocess::SeriesColumn> columns() const;
    /** Their values. */
    static std::vector<double> row(const dem::LabTest &test);
  };
} // namespace apps

#pragma once

#include "apps/runs/coupled/couplings.h"
#include "base/entry_path.h"
#include "dem/loading/curve_figures.h"
#include "postprocess/files/csv_table.h"
#include "postprocess/files/series.h"

#include <string>
#include <vector>

namespace apps
{
  /**
   * Section "Laboratory": a specimen of particles between two faces of the solid, as a press has it. Two columns of the series follow,
   * "stress" and "strain", both positive in compression: the mean of the forces on both faces over the area, and the approach of two
   * points of the solid over the length.
   */
  struct LaboratorySection
  {
    std::string low, high;             ///< couplings; "" the second: no such test
    std::string low_point, high_point; ///< of Continuum/Points
    int         axis = 2;
    double      area = 0, length = 0; ///< [m^2], [m]

    /** @throws base::InputError for a coupling or point that is not there */
    void check(const base::EntryPath  &root,
               const CouplingsSection &couplings,
               const LoadsSection     &loads,
               int                     dimension) const;
    bool given() const { return !high.empty(); }

    /** Columns that it adds; none where there is no such test. */
    std::vector<postprocess::SeriesColumn> columns() const;
    /** Their values. @param columns of the series @param values of its first ones, those of couplings and points among them */
    std::vector<double> read(const std::vector<postprocess::SeriesColumn> &columns,
                             const std::vector<double>                    &values) const;
    /** What a laboratory notes. @param series with the columns @pre given() */
    static dem::UniaxialFigures figures(const postprocess::CsvTable &series);
  };
} // namespace apps

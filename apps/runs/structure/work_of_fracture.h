#pragma once

#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** What the load of a fracture test has done to a structure, from the series of its run. */
  struct WorkOfFracture
  {
    double peak = 0, last = 0; ///< load [N]
    double work = 0;           ///< by all that is driven [J]
    double lost = 0;           ///< of it dissipated [J]

    /** @param series complete @param load column of the load */
    WorkOfFracture(const postprocess::CsvTable &series, const std::string &load);

    double left() const { return peak > 0 ? last / peak : 0; } ///< load at the end, over the peak [-]
    /**
     * work_of_fracture: the external work over the ligament (RILEM TC 50-FMC, 1985, Mater. Struct. 18, 285: G_F = W / A; no weight acts here,
     * so that none has done work); dissipated_over_ligament: without what is still stored; load_left: the work is that of the whole
     * crack only where this is small
     * @param ligament [m^2]
     */
    void put_into(nlohmann::json &figures, double ligament) const;
    /** End of a line: "work over ligament ...". @param ligament [m^2] */
    std::string                     text(double ligament) const;
    static std::vector<std::string> names(); ///< of what put_into() adds
  };
} // namespace apps

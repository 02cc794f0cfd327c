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
    double peak = 0, last = 0; ///< load, as a size and as it is [N]
    double work = 0;           ///< by what is driven, from where the weight is on [J]
    double lost = 0;           ///< dissipated, of this and of the work of the weight [J]
    double way  = 0; ///< of the load from there to the end, along which it works; only where a weight acts [m]

    /** @param series complete @param load column of the load */
    WorkOfFracture(const postprocess::CsvTable &series, const std::string &load);

    double left() const { return peak > 0 ? last / peak : 0; } ///< load at the end, over the peak [-]
    /** What RILEM TC 50-FMC (1985) adds for a weight between the supports that the beam bears beside the load (doc/theory/static-handshake.md, 5) [J]. @param weight [N] */
    double of_weight(const double weight) const { return weight * way; }
    /**
     * work_of_fracture: the work over the ligament (RILEM TC 50-FMC, 1985, Mater. Struct. 18, 285: G_F = (W_0 + m g d_0) / A); where there is a
     * weight also work_of_load, W_0 / A, and deflection, d_0; dissipated_over_ligament: without what is still stored; load_left: the
     * work is that of the whole crack only where this is small, or the weight has taken its place
     * @param ligament [m^2] @param weight m g [N]; 0: none
     */
    void put_into(nlohmann::json &figures, double ligament, double weight = 0) const;
    /** End of a line: "work over ligament ...". @param ligament [m^2] @param weight likewise */
    std::string                     text(double ligament, double weight = 0) const;
    static std::vector<std::string> names(bool heavy); ///< of what put_into() adds
  };
} // namespace apps

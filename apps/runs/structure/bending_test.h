#pragma once

#include "base/entry_path.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /**
   * Section "Bending test": the dimensions of a notched beam on two supports that is loaded at mid-span, by which its load and its
   * work become figures of the material.
   */
  struct BendingTestSection
  {
    double span  = 0;            ///< between the supports [m]; 0: nothing is evaluated
    double depth = 0, width = 0; ///< along the load, across the plane of bending [m]
    double notch  = 0;           ///< its depth [m]
    double length = 0;           ///< of the whole beam, where its weight acts [m]

    /** @throws base::InputError @param heavy whether the weight of the beam acts */
    void check(const base::EntryPath &root, bool heavy) const;

    bool   evaluate() const { return span > 0; }
    double ligament() const { return width * (depth - notch); } ///< area that the crack has to go through [m^2]
    /** Bending stress that the load would cause in the section over the notch, were it elastic [Pa]: 3 F S / (2 b (d - a)^2). */
    double nominal_stress(double load) const;

    /** Of the weight of the beam what is between the supports, as RILEM TC 50-FMC (1985) takes it: in proportion to the length [N]. */
    double weight_between(const double weight) const { return weight > 0 ? weight * span / length : 0; }

    /**
     * @param series of the run, complete @param load column of the load @param weight of the whole beam [N]; 0: none acts
     * @return nominal_strength: of the largest load; and as WorkOfFracture has it
     */
    nlohmann::json figures(const postprocess::CsvTable &series, const std::string &load, double weight) const;
    std::string    text(const postprocess::CsvTable &series, const std::string &load, double weight) const;
    static std::vector<std::string> names(bool heavy); ///< of figures()
  };
} // namespace apps

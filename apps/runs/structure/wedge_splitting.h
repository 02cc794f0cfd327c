#pragma once

#include "base/entry_path.h"
#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /**
   * Section "Wedge splitting": the dimensions of a notched specimen whose groove a wedge drives apart, by which the splitting force and
   * its work become figures of the material (doc/theory/size-effect.md, 3; Tschegg, 1986, patent AT 390328; Bruehwiler, Wittmann, 1990,
   * Eng. Fract. Mech. 35, 117).
   */
  struct WedgeSplittingSection
  {
    double ligament_depth = 0;  ///< from the tip of the notch to the other face [m]; 0: nothing is evaluated
    double width          = 0;  ///< across the plane of splitting [m]
    double arm            = 0;  ///< from the line of the splitting force to the tip of the notch [m]
    double angle          = 30; ///< between the faces of the wedge [degrees]
    double friction       = 0;  ///< of the wedge on its rollers [-]

    /** @throws base::InputError */
    void check(const base::EntryPath &root) const;

    bool   evaluate() const { return ligament_depth > 0; }
    double ligament() const { return width * ligament_depth; } ///< area that the crack has to go through [m^2]
    /** Force on the wedge for that splitting force: 2 F (tan(a/2) + mu) / (1 - mu tan(a/2)) [N]. */
    double machine_force(double splitting_force) const;
    /** Stress that the force would cause at the tip of the notch, by tension and bending of the ligament, were it elastic [Pa]: F/(b h) (4 + 6 c/h). */
    double nominal_stress(double splitting_force) const;

    /**
     * @param series of the run, complete @param load column of the splitting force
     * @return splitting_force, machine_force, nominal_strength: of the largest; and as WorkOfFracture has it
     */
    nlohmann::json                  figures(const postprocess::CsvTable &series, const std::string &load) const;
    std::string                     text(const postprocess::CsvTable &series, const std::string &load) const;
    static std::vector<std::string> names(); ///< of figures()
  };
} // namespace apps

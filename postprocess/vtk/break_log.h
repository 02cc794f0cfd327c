#pragma once

#include "dem/model/break_log.h"

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /** How a bond broke, in a word: "tension", "shear", "gradual". */
  const char *name_of(dem::BreakMode mode);

  /** How wide it was: in the plane its length, in space the diameter of a disk of its area [m]. @param thickness of discs [m]; 0: space */
  double width_of(const dem::Break &broken, double thickness);

  /** Names of the two materials that a pair of them joins: "mortar-aggregate". @param materials their names; empty: there is one */
  std::string name_of_pair(std::int32_t pair, const std::vector<std::string> &materials);

  /**
   * A row per bond, or element of one, that broke: when, between which particles (numbers from 1) or from which
   * surface, which element, how, where, across what, and what area it had.
   * @param surfaces their names; of breaks between particles "-" is written, and -1 for the second particle of the others @throws OutputError
   */
  void write_break_table(const std::filesystem::path    &path,
                         const std::vector<dem::Break>  &breaks,
                         const std::vector<std::string> &materials,
                         const std::vector<std::string> &surfaces = {});

  /**
   * The same for ParaView: in the plane a segment as long as what broke, across the bond; in space a point with the direction across it.
   * @param thickness of discs [m]; 0: space @throws OutputError
   */
  void write_vtk_breaks(const std::filesystem::path   &path,
                        const std::vector<dem::Break> &breaks,
                        double                         thickness,
                        double                         time);
} // namespace postprocess

#pragma once

#include "fem/solid/solid.h"

#include <filesystem>
#include <string>

namespace apps
{
  /** Where and as what the state of a solid is written: FOLDER/NAME_000012.vtu. */
  struct SnapshotPlace
  {
    std::filesystem::path folder; ///< exists
    std::string           name;
    std::size_t           number = 0;
    double                time   = 0;
  };

  /**
   * Write the state of a solid for ParaView; on several ranks, which all call it, a .pvtu record and a file per rank.
   *
   * @param reaction internal less external force [N]
   * @return name of the file to open, within the folder
   * @throws postprocess::OutputError on all ranks if one cannot write
   */
  template <int dim>
  std::string write_solid(fem::Solid<dim>     &solid,
                          const fem::Vector   &displacement,
                          const fem::Vector   &reaction,
                          const SnapshotPlace &place);

  /** The same of a solid that every rank has whole, by one of them: FOLDER/NAME_000012.vtu. @throws postprocess::OutputError */
  template <int dim>
  void write_whole_solid(fem::Solid<dim>     &solid,
                         const fem::Vector   &displacement,
                         const fem::Vector   &reaction,
                         const SnapshotPlace &place);
} // namespace apps

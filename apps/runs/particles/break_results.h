#pragma once

#include "dem/specimen/observation.h"
#include "postprocess/pictures/specimen_picture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What a run of bonded particles leaves of its cracks and forces when it ends: breaks.csv, breaks.png, directions.png, forces.png, and its emission. */
  struct BreakResults
  {
    const dem::ObservedSpecimen    &specimen;
    const std::vector<std::string> &materials; ///< their names; empty: there is one

    /**
     * Pictures that cannot be drawn are warned of; of what broke there are none where nothing did. All ranks call this, the first writes.
     * @param particles dem::particles_for_first() @throws postprocess::OutputError on all ranks
     */
    void write(const std::filesystem::path &folder, const dem::ParticleOutput &particles) const;
    /** How many broke in which way, for the terminal. */
    std::string text() const;

  private:
    void write_alone(const std::filesystem::path    &folder,
                     const dem::ParticleOutput      &particles,
                     const postprocess::PictureSlab &slab) const;
  };
} // namespace apps

#pragma once

#include "base/entry_path.h"
#include "dem/grips/grip_layers.h"

#include <string>

namespace apps
{
  /** Entries of a loading section that say what grips hold, and what stress and strain refer to; the same in every kind of scene. */
  struct GripEntries
  {
    double      thickness = 0;
    std::string area      = "nominal";
    dem::Gauge  gauge     = dem::Gauge::inner_faces;
    double      low_plane = 0, high_plane = 0;

    /** @throws base::InputError naming the entry */
    void                check(const base::EntryPath &loading) const;
    dem::GripParameters parameters() const;
  };

  /** Section and gauge length in words, for the terminal. */
  std::string text_of(const dem::GripLayers &layers, const dem::GripParameters &requested);
} // namespace apps

#include "apps/scene/output_section.h"

namespace apps
{
  void OutputSection::declare(Section &root)
  {
    Section &section = root.section("Output", "How often results are written");
    section.integer("Samples", samples, "", Range::between(1, 1e9), Need::optional)
      .means("Rows of series.csv from the start of a test to its stop strain (it may stop earlier)")
      .housekeeping();
    section.integer("Snapshots", snapshots, "", Range::between(0, 1e6), Need::optional)
      .means(
        "ParaView files from the start of a test to its stop strain; its first and last state besides; 0: none at all")
      .housekeeping();
    section.number("Checkpoint interval", checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
  }
} // namespace apps

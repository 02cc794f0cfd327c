#include "apps/scene/entries/output.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, OutputSection &output)
  {
    Section &section = root.section("Output", "How often results are written");
    section.integer("Samples", output.samples, "", Range::between(1, 1e9), Need::optional)
      .means("Rows of series.csv from the start of a test to its stop strain (it may stop earlier)")
      .housekeeping();
    section.integer("Snapshots", output.snapshots, "", Range::between(0, 1e6), Need::optional)
      .means(
        "ParaView files from the start of a test to its stop strain; its first and last state besides; 0: none at all")
      .housekeeping();
    section.number("Checkpoint interval", output.checkpoint_interval, "s", Range::positive(), Need::optional)
      .means("Longest wall-clock time between checkpoints; from one minute on they are made wherever saving is cheap")
      .housekeeping();
  }

  void declare_for_ranks(Section &root, OutputSection &output)
  {
    declare(root, output);
    root.find_section("Output")
      ->choice("Pieces", output.pieces, {{"one", SnapshotPieces::one}, {"per rank", SnapshotPieces::per_rank}},
               Need::optional)
      .means("ParaView files of particles and links: one (.vtp), which the first rank holds while it writes it, or a "
             "piece per rank with a record of the pieces (.pvtp), which needs memory for a rank's own part alone; on "
             "one rank there is one piece");
  }
} // namespace apps

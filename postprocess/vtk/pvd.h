#pragma once

#include "base/column.h"

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /**
   * The snapshots of one kind as ParaView opens them: OUTPUT/NAME.pvd lists OUTPUT/NAME/NAME_000000.vtp (or .vtu, .pvtu, .pvtp), ... with
   * times.
   *
   * The list is rewritten (atomically) after every snapshot, so it can be opened while the run goes on. File names
   * follow from the number of the snapshot: the times are all that a checkpoint must remember, and a resumed run
   * overwrites the snapshots that were written after its checkpoint.
   */
  class PvdCollection
  {
  public:
    /** Makes the folder OUTPUT/NAME. @throws OutputError. */
    PvdCollection(const std::filesystem::path &output_folder,
                  const std::string           &name,
                  const std::string           &extension = ".vtp");

    /** The file to write the next snapshot to. */
    std::filesystem::path next() const;

    /** Call it after next() was written: lists that file with its time [s]. @throws OutputError. */
    void add(double time);

    std::size_t size() const { return times.size(); }

    /** The times of all snapshots listed: all that must be remembered. */
    const base::Column &listed() const { return times; }

    /** Go on after these, and write the list anew. @throws OutputError. */
    void restore(const base::Column &listed_before);

  private:
    void write_list() const;

    std::filesystem::path folder;
    std::string           name, extension;
    base::Column          times;
  };

  /** The file of one rank's piece of a snapshot: NAME_000012.3.vtp. @param stem of the snapshot's file */
  std::string piece_name(const std::string &stem, std::size_t rank, const std::string &extension);

  /** One file of a collection that shows several things at once. */
  struct PvdPart
  {
    double      time;
    int         part;       ///< 0, 1, ...: what is shown together at a time has different numbers
    std::string name, file; ///< of the part; relative to the collection
  };

  /** Writes such a collection. @throws OutputError. */
  void write_pvd(const std::filesystem::path &path, const std::vector<PvdPart> &parts);
} // namespace postprocess

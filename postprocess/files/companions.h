#pragma once

#include <filesystem>
#include <string>

namespace postprocess
{
  /**
   * The series, snapshots and states that lie beside a checkpoint (and in folders there), as a text: a line for each with size, time
   * of change, fingerprint and name. A run that goes on from the checkpoint counts on them.
   *
   * @param earlier such a text, or "": fingerprints of files that have not changed since are taken from it, not computed anew
   */
  std::string list_companions(const std::filesystem::path &checkpoint, const std::string &earlier);

  /**
   * Are they still there, and do they still begin with what they held? They may have grown: a run that was killed went on after its
   * checkpoint.
   * @throws base::InputError naming the first file that is missing, shorter or changed
   */
  void check_companions(const std::filesystem::path &checkpoint, const std::string &list);
} // namespace postprocess

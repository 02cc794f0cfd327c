#pragma once

#include <string>
#include <vector>

namespace apps
{
  /**
   * Fewest insertions, deletions, substitutions and swaps of neighbours that turn one word into the other, case
   * ignored.
   */
  std::size_t edit_distance(const std::string &from, const std::string &to);

  /**
   * The candidate with the smallest edit distance, the first of equals, of those that contain what was typed if any does (three
   * letters at least, from the beginning of a word); empty if none is like it.
   */
  std::string nearest_name(const std::string &typed, const std::vector<std::string> &candidates);

  /** The candidate that is the same but for slips of the keyboard, one in four letters at most; empty if none is. For long lists. */
  std::string nearest_spelling(const std::string &typed, const std::vector<std::string> &candidates);

  /** "Did you mean "X"?", or "" if none is like it. */
  std::string did_you_mean(const std::string &typed, const std::vector<std::string> &candidates);

  /** The same, for messages without a list of their own: where none is like it "Known: X, Y.", or "" if these are too many. */
  std::string did_you_mean_or_known(const std::string              &typed,
                                    const std::vector<std::string> &candidates,
                                    const std::string              &where_listed = "");
} // namespace apps

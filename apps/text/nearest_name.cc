#include "apps/text/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace apps
{
  namespace
  {
    constexpr std::size_t a_word       = 3;  ///< letters; fewer stand in too many names
    constexpr std::size_t a_short_list = 20; ///< names that a message may list

    bool same(const char a, const char b)
    {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    }

    bool is_letter(const char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

    /** Whether a word of the name begins with what was typed, case ignored: "MPI" is nothing of "Damping". */
    bool contains(const std::string &name, const std::string &word)
    {
      if (word.size() < a_word)
        return false;
      auto at = std::search(name.begin(), name.end(), word.begin(), word.end(), same);
      while (at != name.end() && at != name.begin() && is_letter(*(at - 1)))
        at = std::search(at + 1, name.end(), word.begin(), word.end(), same);
      return at != name.end();
    }

    /** Whether one may be meant by the other: a third of the letters may be wrong; half of them, of a short name, where the first is right. */
    bool is_like(const std::string &typed, const std::string &name)
    {
      if (contains(name, typed))
        return true;
      const std::size_t letters = std::max(typed.size(), name.size()), wrong = edit_distance(typed, name);
      if (typed.empty() || name.empty() || wrong > (letters + 2) / 3)
        return false;
      return 2 * wrong < letters || (typed.size() >= a_word && same(typed.front(), name.front()));
    }
  } // namespace

  std::size_t edit_distance(const std::string &from, const std::string &to)
  {
    // Rows of the dynamic programme: the two before this one and this one.
    std::vector<std::size_t> before_last(to.size() + 1), last(to.size() + 1), row(to.size() + 1);
    for (std::size_t j = 0; j <= to.size(); ++j)
      row[j] = j;
    for (std::size_t i = 1; i <= from.size(); ++i)
      {
        before_last = last;
        last        = row;
        row[0]      = i;
        for (std::size_t j = 1; j <= to.size(); ++j)
          {
            const bool equal = same(from[i - 1], to[j - 1]);
            row[j]           = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
            if (i > 1 && j > 1 && same(from[i - 1], to[j - 2]) && same(from[i - 2], to[j - 1]))
              row[j] = std::min(row[j], before_last[j - 2] + 1);
          }
      }
    return row[to.size()];
  }

  std::string nearest_name(const std::string &typed, const std::vector<std::string> &candidates)
  {
    const auto missed = [&](const std::string &name) { return !contains(name, typed); };
    const auto nearer = [&](const std::string &a, const std::string &b) {
      return missed(a) != missed(b) ? missed(b) : edit_distance(typed, a) < edit_distance(typed, b);
    };
    const auto nearest = std::min_element(candidates.begin(), candidates.end(), nearer);
    return nearest == candidates.end() || !is_like(typed, *nearest) ? std::string() : *nearest;
  }

  std::string nearest_spelling(const std::string &typed, const std::vector<std::string> &candidates)
  {
    const auto nearest =
      std::min_element(candidates.begin(), candidates.end(), [&](const std::string &a, const std::string &b) {
        return edit_distance(typed, a) < edit_distance(typed, b);
      });
    const std::size_t slips = std::max<std::size_t>(1, typed.size() / 4);
    return nearest == candidates.end() || edit_distance(typed, *nearest) > slips ? std::string() : *nearest;
  }

  std::string did_you_mean(const std::string &typed, const std::vector<std::string> &candidates)
  {
    const std::string name = nearest_name(typed, candidates);
    return name.empty() ? std::string() : "Did you mean \"" + name + "\"?";
  }

  std::string did_you_mean_or_known(const std::string              &typed,
                                    const std::vector<std::string> &candidates,
                                    const std::string              &where_listed)
  {
    const std::string meant = did_you_mean(typed, candidates);
    if (!meant.empty() || candidates.empty())
      return meant;
    if (candidates.size() > a_short_list)
      return where_listed;
    std::string all;
    for (const std::string &candidate : candidates)
      all += (all.empty() ? "Known: " : ", ") + candidate;
    return all + ".";
  }
} // namespace apps

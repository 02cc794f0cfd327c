#pragma once

#include "base/errors.h"

#include <string>
#include <vector>

namespace base
{
  /** A value of a model that breaks a rule: which entry, by the names of the sections around it, and the rule. */
  class EntryError : public InputError
  {
  public:
    /**
     * @param refused "" for the section itself
     * @param before_rule between the path and the rule: "/" where that begins with the entry's own path in the section
     */
    EntryError(std::vector<std::string> around,
               std::string              refused,
               std::string              broken_rule,
               const std::string       &before_rule = ": ")
      : InputError(text(around, refused) + before_rule + broken_rule)
      , sections(std::move(around))
      , entry(std::move(refused))
      , rule(std::move(broken_rule))
      , separator(before_rule)
    {
    }

    const std::vector<std::string> sections; ///< from the outermost
    const std::string              entry, rule, separator;

  private:
    static std::string text(const std::vector<std::string> &sections, const std::string &entry)
    {
      std::string path;
      for (const std::string &section : sections)
        path += (path.empty() ? "" : "/") + section;
      return entry.empty() ? path : path.empty() ? entry : path + "/" + entry;
    }
  };

  /**
   * Where a part of a model stands in the whole, for messages: the sections around it. Models are checked with it, whatever has filled
   * them; the reader of a text adds the place in its file.
   */
  class EntryPath
  {
  public:
    /** A section in here. */
    EntryPath at(const std::string &section) const
    {
      EntryPath inner = *this;
      inner.sections.push_back(section);
      return inner;
    }
    /** @throws base::EntryError always */
    [[noreturn]] void refuse(const std::string &entry, const std::string &rule) const
    {
      throw EntryError(sections, entry, rule);
    }
    /** An entry within, by a message that begins with its path in here, "CPM/Cohesion = -1: ...". @throws base::EntryError always */
    [[noreturn]] void refuse_within(const std::string &message) const { throw EntryError(sections, "", message, "/"); }
    /** The section itself. @throws base::EntryError always */
    [[noreturn]] void refuse(const std::string &rule) const { throw EntryError(sections, "", rule); }

  private:
    std::vector<std::string> sections;
  };
} // namespace base

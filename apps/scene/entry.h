#pragma once

#include "apps/text/place.h"

#include <functional>
#include <string>
#include <utility>

namespace apps
{
  /** When an entry is needed, and the same in words: "Shape = plane". */
  struct Condition
  {
    std::function<bool()> holds; ///< evaluated after reading
    std::string           words;
  };

  /**
   * One declared parameter: what it means, what it accepts, where its value goes and, after reading, where it came
   * from.
   *
   * Declared once, by Section; the reader, `breccia describe` and the completed scene all work from it.
   */
  struct Entry
  {
    std::string name;
    std::string unit; ///< "" for words and switches, "-" for pure numbers
    std::string meaning;
    std::string type;             ///< "number", "whole number", "switch", "word", "list of words", "vector", "file"
    std::string allowed;          ///< "> 0", "one of: a, b"; "" when every value of the type is accepted
    std::string value;            ///< as text: the default, then what was read; empty if neither exists
    bool        required = false; ///< no default: the scene must say
    bool        set      = false; ///< read from a file or the command line
    bool        decides  = true;  ///< the results depend on it (a folder or a checkpoint interval does not)
    Place       place;            ///< of the value, if set

    std::string           condition; ///< when the entry is needed, in words; "" for always
    std::function<bool()> holds;     ///< the same, evaluated after reading

    /** Stores the value of a text. @return what is wrong with it, "" if nothing. */
    std::function<std::string(const std::string &text, const Place &from)> store;

    Entry &means(std::string words)
    {
      meaning = std::move(words);
      return *this;
    }

    /** The entry is needed only if the condition holds. */
    Entry &only_if(std::function<bool()> is_needed, std::string words)
    {
      holds     = std::move(is_needed);
      condition = std::move(words);
      return *this;
    }
    Entry &only_if(const Condition &needed) { return only_if(needed.holds, needed.words); }

    /** Keep in a member whether the scene has given a value. */
    Entry &notes(bool &given)
    {
      store = [&given, keep = std::move(store)](const std::string &text, const Place &from) {
        given = true;
        return keep(text, from);
      };
      return *this;
    }

    /** The results do not depend on this entry: a run may be resumed with another value. */
    Entry &housekeeping()
    {
      decides = false;
      return *this;
    }

    bool needed() const { return !holds || holds(); }
  };
} // namespace apps

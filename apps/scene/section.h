#pragma once

#include "apps/scene/entry.h"
#include "apps/text/expression.h"
#include "base/entry_path.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** Bounds of a number, both included unless the upper is open. */
  struct Range
  {
    double lower      = -std::numeric_limits<double>::max();
    double upper      = std::numeric_limits<double>::max();
    bool   upper_open = false;

    static Range positive() { return {std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), false}; }
    static Range at_least(const double lower) { return {lower, std::numeric_limits<double>::max(), false}; }
    static Range between(const double lower, const double upper) { return {lower, upper, false}; }
    static Range from_up_to(const double lower, const double upper) { return {lower, upper, true}; } ///< upper excluded

    /** False also for what is not a finite number. */
    bool        contains(double value) const;
    std::string text() const; ///< "> 0", "in [0, 1)"; "" for no bound
  };

  /** Whether the scene has to give a value, or the member's own is the default. */
  enum class Need
  {
    required,
    optional
  };

  /** Words that a choice accepts, and what each means to the program. */
  template <typename Value>
  using Words = std::initializer_list<std::pair<const char *, Value>>;

  /**
   * One section of a scene: its entries, bound to the members that receive them, and its sub-sections.
   *
   * The members must outlive the section. A default is the value the member has when it is declared.
   */
  class Section
  {
  public:
    explicit Section(std::string section_name = "", std::string section_meaning = "");
    Section(const Section &)            = delete;
    Section &operator=(const Section &) = delete;

    Entry &number(const std::string &entry, double &member, const std::string &unit, const Range &range, Need need);
    Entry &
    integer(const std::string &entry, std::int64_t &member, const std::string &unit, const Range &range, Need need);
    Entry &flag(const std::string &entry, bool &member);
    Entry &vector(
      const std::string &entry, std::array<double, 3> &member, const std::string &unit, const Range &range, Need need);
    /** Relative to the place it is written in; "" if unset. */
    Entry &file(const std::string &entry, std::string &member, Need need = Need::required);
    Entry &text(const std::string &entry, std::string &member, Need need);
    /** A formula in x, y, z [m] and t [s], or a table by time; nothing, or an empty text, leaves it unset. */
    Entry &expression(const std::string &entry, Expression &member, const std::string &unit);

    template <typename Value>
    Entry &
    choice(const std::string &entry, Value &member, Words<typename std::common_type<Value>::type> words, Need need);
    template <typename Value>
    Entry &choices(const std::string                            &entry,
                   std::vector<Value>                           &member,
                   Words<typename std::common_type<Value>::type> words,
                   Need                                          need);

    /** A choice whose words are known at run time only. @param initial the default's place among them; beyond: none */
    Entry &choice_of(const std::string               &entry,
                     const std::vector<std::string>  &words,
                     std::size_t                      initial,
                     std::function<void(std::size_t)> assign,
                     Need                             need)
    {
      return add_choice(entry, words, initial, std::move(assign), need);
    }

    /** A sub-section. */
    Section &section(const std::string &subsection, const std::string &subsection_meaning);
    /**
     * Sub-sections that a scene names as it likes, e.g. after the parts of its mesh; each has its own members.
     * @param placeholder stands for the name in descriptions.
     * @param declare gives a newly opened one its entries.
     */
    void named_sections(const std::string &placeholder, std::function<void(Section &)> declare);
    /**
     * The same, each an element added to a list: it keeps its name, and gets its entries by declare(section, element).
     * @param list of which elements stay where they are as others are added
     */
    template <typename List>
    void named_list(const std::string &placeholder, List &list, std::string List::value_type::*name);
    /** @param declare_element in place of that declare() */
    template <typename List, typename Declare>
    void named_list(const std::string &placeholder,
                    List              &list,
                    std::string List::value_type::*name,
                    Declare                        declare_element);
    /** The sub-section, opened now if its name is the scene's choice; nullptr if there is none of that name. */
    Section *open_section(const std::string &subsection, const Place &from);
    /** One sub-section named by the placeholder wherever names are the scene's choice: for descriptions. */
    void open_placeholders();
    /** Where a scene opened it, if its name was the scene's choice. */
    const Place &place() const { return opened_at; }

    /**
     * Entries in here are needed only if the condition holds after reading; the words say it in messages and
     * descriptions.
     */
    void only_if(std::function<bool()> condition, std::string condition_in_words);

    const std::string &name() const { return own_name; }
    const std::string &meaning() const { return own_meaning; }
    const std::string &condition() const { return words_of_condition; } ///< "" for always
    std::string        path() const;                                    ///< "Loading/Tension"; "" for the root
    std::string        path_of(const std::string &entry) const;         ///< "Loading/Tension/Strain rate"
    bool               needed() const;
    const std::vector<std::unique_ptr<Entry>>   &entries() const { return own_entries; }
    const std::vector<std::unique_ptr<Section>> &sections() const { return subsections; }

    /** By name; nullptr if there is none. */
    Entry   *find_entry(const std::string &entry) const;
    Section *find_section(const std::string &subsection) const;
    /** Names of all entries (sections) in here, for messages. */
    std::vector<std::string> entry_names() const;
    std::vector<std::string> section_names() const;

    /**
     * Refuse a value that breaks a rule between entries: "place: entry = value: rule".
     * @throws base::InputError always.
     */
    [[noreturn]] void refuse(const std::string &entry, const std::string &rule) const;

  private:
    Entry &add(const std::string &entry, const std::string &type, Need need, const std::string &initial);
    /** A choice without its type: the position of the member's value among the words, and how to change it. */
    Entry &add_choice(const std::string               &entry,
                      const std::vector<std::string>  &words,
                      std::size_t                      initial,
                      std::function<void(std::size_t)> assign,
                      Need                             need);
    Entry &add_choices(const std::string                                    &entry,
                       const std::vector<std::string>                       &words,
                       const std::string                                    &initial,
                       std::function<void(const std::vector<std::size_t> &)> assign,
                       Need                                                  need);

    std::string                           own_name, own_meaning, words_of_condition;
    std::function<bool()>                 holds;
    const Section                        *parent = nullptr;
    std::string                           placeholder;
    std::function<void(Section &)>        declare_named; // empty: names are not free
    Place                                 opened_at;
    std::vector<std::unique_ptr<Entry>>   own_entries;
    std::vector<std::unique_ptr<Section>> subsections;
  };

  template <typename List>
  void Section::named_list(const std::string &placeholder_of_names, List &list, std::string List::value_type::*name_of)
  {
    named_list(placeholder_of_names, list, name_of,
               [](Section &opened, typename List::value_type &added) { declare(opened, added); });
  }

  template <typename List, typename Declare>
  void Section::named_list(const std::string &placeholder_of_names,
                           List              &list,
                           std::string List::value_type::*name_of,
                           Declare                        declare_element)
  {
    named_sections(placeholder_of_names, [&list, name_of, declare_element](Section &opened) {
      typename List::value_type &added = list.emplace_back();
      added.*name_of                   = opened.name();
      declare_element(opened, added);
    });
  }

  template <typename Value>
  Entry &Section::choice(const std::string                                  &entry,
                         Value                                              &member,
                         const Words<typename std::common_type<Value>::type> words,
                         const Need                                          need)
  {
    std::vector<std::string> names;
    std::vector<Value>       values;
    std::size_t              initial = words.size(); // none of them: a required choice need not start at a legal value
    for (const auto &[word, value] : words)
      {
        if (value == member)
          initial = names.size();
        names.push_back(word);
        values.push_back(value);
      }
    return add_choice(
      entry, names, initial, [&member, values](const std::size_t i) { member = values[i]; }, need);
  }

  template <typename Value>
  Entry &Section::choices(const std::string                                  &entry,
                          std::vector<Value>                                 &member,
                          const Words<typename std::common_type<Value>::type> words,
                          const Need                                          need)
  {
    std::vector<std::string> names;
    std::vector<Value>       values;
    for (const auto &[word, value] : words)
      {
        names.push_back(word);
        values.push_back(value);
      }
    std::string initial;
    for (const Value &chosen : member)
      for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] == chosen)
          initial += (initial.empty() ? "" : ", ") + names[i];
    const auto assign = [&member, values](const std::vector<std::size_t> &positions) {
      member.clear();
      for (const std::size_t i : positions)
        member.push_back(values[i]);
    };
    return add_choices(entry, names, initial, assign, need);
  }
} // namespace apps

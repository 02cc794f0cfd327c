#pragma once

#include "apps/scene/section.h"

namespace apps
{
  /** Receives the words of a law's choice; a function object because its type must not fix the word's meaning. */
  struct ChoiceOfLaw
  {
    Section &block;

    template <typename Value>
    void operator()(const char                                   *key,
                    Value                                        &member,
                    Words<typename std::common_type<Value>::type> words,
                    const char                                   *meaning) const
    {
      block.choice(key, member, words, Need::optional).means(meaning);
    }
  };

  /**
   * Declare the entries of a law, which describes itself, in a section of the scene (or of the command line).
   * @tparam Description as dem::CpmDescription.
   */
  template <typename Description, typename Parameters>
  void declare_law(Section &block, Parameters &parameters)
  {
    const auto number = [&block](const char *key, double &member, const char *unit, const char *meaning,
                                 const double lower, const double upper, const bool required) {
      block.number(key, member, unit, Range::between(lower, upper), required ? Need::required : Need::optional)
        .means(meaning);
    };
    Description::describe(parameters, number, ChoiceOfLaw{block});
  }
} // namespace apps

#pragma once

#include "apps/scene/constant_entries.h"
#include "dem/laws/registry.h"

namespace apps
{
  /** Declare the constants of a link law, which describes itself, in a section of the scene (or of the command line). */
  class LawBlock : public dem::ConstantVisitor
  {
  public:
    explicit LawBlock(Section &declared_in)
      : block(declared_in)
    {
    }

    void number(const char  *key,
                double      &member,
                const char  *unit,
                const char  *meaning,
                const double lower,
                const double upper,
                const bool   required) override
    {
      ConstantEntries{block}(key, member, unit, meaning, lower, upper, required);
    }
    void choice(const char                      *key,
                const std::vector<std::string>  &words,
                const std::size_t                initial,
                std::function<void(std::size_t)> assign,
                const char                      *meaning) override
    {
      block.choice_of(key, words, initial, std::move(assign), Need::optional).means(meaning);
    }

  private:
    Section &block;
  };
} // namespace apps

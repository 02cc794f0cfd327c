#pragma once

namespace dem
{
  /** Rules that a law's constants obey; what breaks one is refused by the law's name and the entry. */
  class Requirements
  {
  public:
    explicit constexpr Requirements(const char *law)
      : name(law)
    {
    }

    /** @throws base::InputError "law/entry = value: rule" unless the rule is fulfilled and the value finite */
    void operator()(bool fulfilled, const char *entry, double value, const char *rule) const;
    /** A strength is not negative; without a limit nothing breaks. @throws base::InputError likewise */
    void strength(const char *entry, double value) const;

  private:
    const char *name;
  };
} // namespace dem

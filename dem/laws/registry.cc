#include "dem/laws/registry.h"

#include "dem/laws/all.h"

#include <algorithm>
#include <cctype>

namespace dem
{
  namespace
  {
    template <typename... Laws>
    std::vector<std::shared_ptr<const LinkLawKind>> kinds_of(const std::tuple<Laws...> &)
    {
      return {std::make_shared<LinkLawKindOf<Laws>>()...};
    }

    std::vector<std::shared_ptr<const LinkLawKind>> &all()
    {
      static auto laws = kinds_of(LinkLaws());
      return laws;
    }

    bool same_without_case(const std::string &a, const std::string &b)
    {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const unsigned char x, const unsigned char y) {
        return std::tolower(x) == std::tolower(y);
      });
    }
  } // namespace

  const std::vector<std::shared_ptr<const LinkLawKind>> &link_laws() { return all(); }

  const LinkLawKind *find_link_law(const std::string &name)
  {
    for (const auto &law : all())
      if (same_without_case(law->name(), name))
        return law.get();
    return nullptr;
  }

  void add_link_law(std::shared_ptr<const LinkLawKind> law) { all().push_back(std::move(law)); }
} // namespace dem

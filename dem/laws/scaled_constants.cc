#include "dem/laws/scaled_constants.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <array>
#include <string>

namespace dem
{
  namespace
  {
    /** What laws call their moduli and strengths. */
    constexpr std::array<const char *, 5> moduli    = {"Normal modulus", "Effective modulus", "Bond effective modulus",
                                                       "Contact effective modulus", "Young modulus"};
    constexpr std::array<const char *, 2> strengths = {"Tensile strength", "Cohesion"};

    class Scaler final : public ConstantVisitor
    {
    public:
      explicit Scaler(const ConstantFactors &factors)
        : by(factors)
      {
      }

      void number(const char *key, double &member, const char *, const char *, double, double, bool) override
      {
        const std::string name = key;
        const auto        is   = [&](const char *one) { return name == one; };
        if (std::any_of(moduli.begin(), moduli.end(), is))
          {
            member *= by.stiffness;
            stiff = true;
          }
        else if (std::any_of(strengths.begin(), strengths.end(), is))
          {
            member *= by.strength;
            strong = true;
          }
        else if (name == "Limit elastic strain" || name == "Compression yield strain")
          member *= by.strength / by.stiffness;
        else if (name == "Relative ductility")
          {
            member *= by.ductility;
            ductile = true;
          }
      }
      void choice(const char *,
                  const std::vector<std::string> &,
                  std::size_t,
                  std::function<void(std::size_t)>,
                  const char *) override
      {
      }

      void require_all() const
      {
        for (const auto &[factor, known, what] :
             {std::tuple{by.stiffness, stiff, "modulus"}, std::tuple{by.strength, strong, "strength"},
              std::tuple{by.ductility, ductile, "ductility"}})
          if (factor != 1 && !known)
            throw base::InputError("a factor of " + base::number_text(factor) + ": the law has no " + what +
                                   " to multiply. Leave it out.");
      }

    private:
      ConstantFactors by;
      bool            stiff = false, strong = false, ductile = false;
    };
  } // namespace

  std::shared_ptr<LinkConstants> scaled(const LinkConstants &constants, const ConstantFactors &factors)
  {
    std::shared_ptr<LinkConstants> copy = constants.copy();
    Scaler                         scaler(factors);
    copy->visit(scaler);
    scaler.require_all();
    return copy;
  }
} // namespace dem

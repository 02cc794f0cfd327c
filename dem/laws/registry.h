#pragma once

#include "dem/model/materials.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dem
{
  /** Receives what a law's constants are: a scene section, a help text, a test. */
  class ConstantVisitor
  {
  public:
    virtual ~ConstantVisitor() = default;
    /** A number between bounds (both included). A required one has no default; the others keep the member's own. */
    virtual void number(const char *key,
                        double     &member,
                        const char *unit,
                        const char *meaning,
                        double      lower,
                        double      upper,
                        bool        required) = 0;
    /** One of several words. @param initial the member's own among them @param assign takes the chosen one */
    virtual void choice(const char                      *key,
                        const std::vector<std::string>  &words,
                        std::size_t                      initial,
                        std::function<void(std::size_t)> assign,
                        const char                      *meaning) = 0;
  };

  /** Constants of the links of one material, of whatever law. */
  class LinkConstants
  {
  public:
    virtual ~LinkConstants()                                               = default;
    virtual void                           visit(ConstantVisitor &visitor) = 0;
    virtual void                           check() const = 0; ///< @throws base::InputError naming the entry
    virtual std::shared_ptr<LinkConstants> copy() const  = 0;
  };

  /** A material of a scene: its constants are those that the law of the scene made. */
  struct NamedConstants
  {
    std::string          name;
    const LinkConstants *constants;
    double               density = 0; ///< [kg/m^3]; 0: the specimen's
  };

  /** Constants of the law of the scene for links between two of its materials. */
  struct PairConstants
  {
    std::int32_t         one = 0, other = 0; ///< numbers of the materials
    const LinkConstants *constants;
    bool                 bonded = true;
  };

  /** A law of links as it can be named, described and made materials of. */
  class LinkLawKind
  {
  public:
    virtual ~LinkLawKind()                                      = default;
    virtual std::string                    name() const         = 0;
    virtual std::string                    meaning() const      = 0;
    virtual bool                           touches_only() const = 0; ///< it bonds nothing: surfaces can have it
    virtual std::shared_ptr<LinkConstants> constants() const    = 0; ///< with their defaults
    /** @pre constants of this law @param between pairs that do not take the means of two materials */
    virtual LinkMaterials materials(const std::vector<NamedConstants> &of,
                                    const std::vector<PairConstants>  &between = {}) const = 0;
    /** Constants of links between two materials where nothing else is said. @pre likewise @throws base::InputError where they have no mean */
    virtual std::shared_ptr<LinkConstants> mean_of(const NamedConstants &one, const NamedConstants &other) const = 0;
  };

  /** All laws: those of dem/laws/all.h, and what was added since. */
  const std::vector<std::shared_ptr<const LinkLawKind>> &link_laws();
  /** By name, case ignored; nullptr if there is none. */
  const LinkLawKind *find_link_law(const std::string &name);
  /** Before scenes are read: a test, or a program that brings a law of its own. */
  void add_link_law(std::shared_ptr<const LinkLawKind> law);

  /** The kind of a law that describes itself: name, meaning, touches_only, Parameters, describe(), check(), mean_of(), bonds(), contacts(). */
  template <typename Law>
  class LinkLawKindOf final : public LinkLawKind
  {
  public:
    using Parameters = typename Law::Parameters;

    std::string                    name() const override { return Law::name; }
    std::string                    meaning() const override { return Law::meaning; }
    bool                           touches_only() const override { return Law::touches_only; }
    std::shared_ptr<LinkConstants> constants() const override { return std::make_shared<Constants>(); }
    /** Constants that a program has at hand. */
    static std::shared_ptr<LinkConstants> constants_of(const Parameters &parameters)
    {
      auto made        = std::make_shared<Constants>();
      made->parameters = parameters;
      return made;
    }
    LinkMaterials materials(const std::vector<NamedConstants> &of,
                            const std::vector<PairConstants>  &between) const override
    {
      std::vector<Material<Parameters>> list;
      for (const NamedConstants &material : of)
        list.push_back(material_of(material));
      std::vector<MaterialPair<Parameters>> pairs;
      for (const PairConstants &pair : between)
        pairs.push_back(
          {pair.one, pair.other, static_cast<const Constants &>(*pair.constants).parameters, pair.bonded});
      return Materials<Parameters>(std::move(list), std::move(pairs));
    }
    std::shared_ptr<LinkConstants> mean_of(const NamedConstants &one, const NamedConstants &other) const override
    {
      return constants_of(Law::mean_of(material_of(one), material_of(other)));
    }

  private:
    static Material<Parameters> material_of(const NamedConstants &material)
    {
      return {material.name, static_cast<const Constants &>(*material.constants).parameters, material.density};
    }

    /** Forwards the words of a choice without their type. */
    struct Choice
    {
      ConstantVisitor &visitor;
      template <typename Value>
      void operator()(const char                                                                            *key,
                      Value                                                                                 &member,
                      std::initializer_list<std::pair<const char *, typename std::common_type<Value>::type>> words,
                      const char *meaning) const
      {
        std::vector<std::string> names;
        std::vector<Value>       values;
        std::size_t              initial = words.size();
        for (const auto &[word, value] : words)
          {
            if (value == member)
              initial = names.size();
            names.push_back(word);
            values.push_back(value);
          }
        visitor.choice(
          key, names, initial, [&member, values](const std::size_t chosen) { member = values.at(chosen); }, meaning);
      }
    };

    struct Constants final : LinkConstants
    {
      void visit(ConstantVisitor &visitor) override
      {
        const auto number = [&](const char *key, double &member, const char *unit, const char *meaning,
                                const double lower, const double upper, const bool required) {
          visitor.number(key, member, unit, meaning, lower, upper, required);
        };
        Law::describe(parameters, number, Choice{visitor});
      }
      void                           check() const override { Law::check(parameters); }
      std::shared_ptr<LinkConstants> copy() const override { return std::make_shared<Constants>(*this); }

      Parameters parameters;
    };
  };
} // namespace dem

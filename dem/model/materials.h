#pragma once

#include "dem/model/link_law.h"
#include "dem/model/packing.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
  /** Number of the pair of two materials: 0-0, 1-0, 1-1, 2-0, ... */
  constexpr std::int32_t material_pair(const std::int32_t one, const std::int32_t other)
  {
    return one < other ? other * (other + 1) / 2 + one : one * (one + 1) / 2 + other;
  }

  /** One of the materials that particles can be of. @tparam Parameters of a link law; Parameters::Law is the law */
  template <typename Parameters>
  struct Material
  {
    std::string name;
    Parameters  parameters;  ///< of links between two of its particles
    double      density = 0; ///< of its particles [kg/m^3]; 0: the specimen's
  };

  /** Constants of links between two materials that are not the means of theirs. */
  template <typename Parameters>
  struct MaterialPair
  {
    std::int32_t one = 0, other = 0; ///< numbers of the materials; they may be the same
    Parameters   parameters;
    bool         bonded = true; ///< off: the two are not linked at the start, and touch only
  };

  /** The materials of a specimen, numbered from 0 as Packing::material numbers them; at least one. */
  template <typename Parameters>
  struct Materials
  {
    std::vector<Material<Parameters>>     list;
    std::vector<MaterialPair<Parameters>> between; ///< pairs with constants of their own; the last of several counts

    Materials(const Parameters &only) // of one material; implicit, because then there is nothing else to say
      : list{{"", only, 0}}
    {
    }
    explicit Materials(std::vector<Material<Parameters>> materials, std::vector<MaterialPair<Parameters>> pairs = {})
      : list(std::move(materials))
      , between(std::move(pairs))
    {
    }

    bool several() const { return list.size() > 1; }

    /** Parameters of every pair, in the order of material_pair(). @throws base::InputError for a pair that has none */
    std::vector<Parameters> pairs() const
    {
      std::vector<Parameters> all;
      for (std::size_t one = 0; one < list.size(); ++one)
        for (std::size_t other = 0; other <= one; ++other)
          if (const auto *own =
                between_of(material_pair(static_cast<std::int32_t>(one), static_cast<std::int32_t>(other))))
            all.push_back(own->parameters);
          else
            all.push_back(one == other ? list[one].parameters : Parameters::Law::mean_of(list[other], list[one]));
      return all;
    }

    /** Constants of their own of a pair, by its number; nullptr: it has none. */
    const MaterialPair<Parameters> *between_of(const std::int32_t pair) const
    {
      const MaterialPair<Parameters> *found = nullptr;
      for (const MaterialPair<Parameters> &each : between)
        if (material_pair(each.one, each.other) == pair)
          found = &each;
      return found;
    }
  };

  /**
   * The materials of a specimen, whatever their law: what a specimen, a static network or a cell is made with.
   *
   * The law of contacts follows from that of the bonds (what a broken bond becomes), unless it is chosen apart.
   */
  class LinkMaterials
  {
  public:
    template <typename Parameters, typename = typename Parameters::Law>
    LinkMaterials(const Parameters &only)
      : LinkMaterials(Materials<Parameters>(only))
    {
    }
    template <typename Parameters>
    LinkMaterials(const Materials<Parameters> &materials)
      : bonding(std::make_shared<Of<Parameters>>(materials))
      , touching(bonding)
    {
      for (const auto &material : materials.list)
        density.push_back(material.density);
      const auto n = static_cast<std::int32_t>(density.size());
      for (std::int32_t pair = 0; pair < n * (n + 1) / 2; ++pair)
        if (const auto *own = materials.between_of(pair); own && !own->bonded)
          {
            unbonded.resize(static_cast<std::size_t>(n * (n + 1) / 2), false);
            unbonded[static_cast<std::size_t>(pair)] = true;
          }
    }

    std::size_t size() const { return density.size(); }
    /** Whether links are of several pairs. */
    bool several() const { return size() > 1 || joints() > 0; }
    /** Number of pairs of materials; links of joints are of further ones, one for each (Particles::pair_of()). */
    std::int32_t material_pairs() const { return static_cast<std::int32_t>(size() * (size() + 1) / 2); }
    std::size_t  joints() const { return joint_count; }
    /** Density of each material's particles [kg/m^3]. @param otherwise of those that have none of their own */
    std::vector<double> densities(double otherwise) const;

    /** Of each pair of materials whether the two are not linked at the start; empty: all are. */
    const std::vector<bool> &unbonded_pairs() const { return unbonded; }

    /** Law of the links made at the start. @throws base::InputError for constants out of range, or materials that have no mean */
    std::shared_ptr<const LinkLaw> bonds(const Physics &physics) const
    {
      return bonding->bonds(physics, physics.dimension);
    }
    /** The same with vectors of three components in histories, also in the plane: for small strains and single links. */
    std::shared_ptr<const LinkLaw> bonds_in_space(const Physics &physics) const { return bonding->bonds(physics, 3); }
    /** Law of links that are born where particles meet. */
    std::shared_ptr<const LinkLaw> contacts(const Physics &physics) const
    {
      return touching->contacts(physics, physics.dimension);
    }
    /** The same with vectors of three components in histories: for single links. */
    std::shared_ptr<const LinkLaw> contacts_in_space(const Physics &physics) const
    {
      return touching->contacts(physics, 3);
    }
    /** The same materials, whose contacts obey another law. @throws base::InputError if it has another number of materials */
    LinkMaterials with_contacts(const LinkMaterials &other) const;
    /**
     * Materials whose pairs obey laws of different kinds (LawsByPair). Pairs whose law carries no tension are not linked at the start.
     * Contacts that wait for particles to meet and others that do not are refused together: contacts() throws base::InputError.
     * @param of_laws the same materials by each law; constants of pairs that obey another one do not matter
     * @param kinds of each pair, in the order of material_pair(), which of `of_laws` it obeys
     */
    static LinkMaterials by_pair(const std::vector<LinkMaterials> &of_laws, const std::vector<std::int32_t> &kinds);
    /**
     * The same materials with joints through them (Packing::cuts), whose links obey a law of their own. @pre they have none yet
     * @param joints constants of each joint, by its number; none: nothing changes
     */
    template <typename Parameters>
    LinkMaterials with_joints(const std::vector<Parameters> &joints) const
    {
      if (joints.empty())
        return *this;
      std::vector<Parameters> pairs(static_cast<std::size_t>(material_pairs()), joints.front()); // of no link
      pairs.insert(pairs.end(), joints.begin(), joints.end());
      return jointed(std::make_shared<JointsOf<Parameters>>(std::move(pairs)), joints.size());
    }

  private:
    struct ByPair;
    struct Jointed;
    struct Concept
    {
      virtual ~Concept()                                                                                  = default;
      virtual std::shared_ptr<const LinkLaw> bonds(const Physics &physics, int vector_dimension) const    = 0;
      virtual std::shared_ptr<const LinkLaw> contacts(const Physics &physics, int vector_dimension) const = 0;
      /** The law of each kind, of bonds of several kinds. */
      virtual std::vector<std::shared_ptr<const LinkLaw>> bonds_by_kind(const Physics &physics, int dimension) const
      {
        return {bonds(physics, dimension)};
      }
      /** Of each pair of materials the number of its kind; empty: there is one. */
      virtual std::vector<std::int32_t> kinds_of_bonds() const { return {}; }
    };
    template <typename Parameters>
    struct Of : Concept
    {
      explicit Of(Materials<Parameters> given)
        : materials(std::move(given))
      {
      }
      std::shared_ptr<const LinkLaw> bonds(const Physics &physics, const int dimension) const override
      {
        return Parameters::Law::bonds(materials.pairs(), physics, dimension);
      }
      std::shared_ptr<const LinkLaw> contacts(const Physics &physics, const int dimension) const override
      {
        return Parameters::Law::contacts(materials.pairs(), physics, dimension);
      }
      Materials<Parameters> materials;
    };

    /** Bonds of joints, which touch nothing. */
    template <typename Parameters>
    struct JointsOf : Concept
    {
      explicit JointsOf(std::vector<Parameters> given)
        : pairs(std::move(given))
      {
      }
      std::shared_ptr<const LinkLaw> bonds(const Physics &physics, const int dimension) const override
      {
        return Parameters::Law::bonds(pairs, physics, dimension);
      }
      std::shared_ptr<const LinkLaw> contacts(const Physics &, int) const override { return nullptr; }
      std::vector<Parameters>        pairs;
    };
    LinkMaterials jointed(std::shared_ptr<const Concept> of_joints, std::size_t count) const;

    std::shared_ptr<const Concept> bonding, touching;
    std::size_t                    joint_count = 0;
    std::vector<double>            density; ///< of each material; 0: none of its own
    std::vector<bool>              unbonded;
  };

  /** @throws base::InputError for a particle of a material that is not among those given; see also check_packing() */
  void check_materials(const Packing &packing, const LinkMaterials &materials);

  /** Mean of two constants of a pair of materials. */
  inline double mean(const double a, const double b) { return 0.5 * (a + b); }
  /** Coefficient tan(phi) of the mean friction ANGLE; of equal ones the very same, to the last bit. */
  double mean_friction(double a, double b);
} // namespace dem

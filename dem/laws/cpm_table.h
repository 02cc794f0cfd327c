#pragma once

#include "dem/core/column.h"
#include "dem/laws/cpm.h"
#include "dem/packing/packing.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
  /** One of the materials that particles can be of. */
  struct CpmMaterial
  {
    std::string   name;
    CpmParameters parameters;  ///< of links between two of its particles
    double        density = 0; ///< of its particles [kg/m^3]; 0: the specimen's
  };

  /** The materials of a specimen, numbered from 0 as Packing::material numbers them; at least one. */
  struct CpmMaterials
  {
    std::vector<CpmMaterial> list;

    CpmMaterials(const CpmParameters &only) // of one material; implicit, because then there is nothing else to say
      : list{{"", only, 0}}
    {
    }
    explicit CpmMaterials(std::vector<CpmMaterial> materials)
      : list(std::move(materials))
    {
    }

    bool several() const { return list.size() > 1; }
    /** Parameters of every pair, in the order of CpmTable::pair(). @throws as mean_of() */
    std::vector<CpmParameters> pairs() const;
    /** Density of each material's particles [kg/m^3]. @param otherwise of those that have none of their own */
    std::vector<double> densities(double otherwise) const;
  };

  /** @throws InputError for a particle of a material that is not among those given; see also check_packing() */
  void check_materials(const Packing &packing, const CpmMaterials &materials);

  /**
   * Constants of a link between particles of two materials: arithmetic means of modulus, shear ratio, limit strain, ductility,
   * cohesion, shear contribution, residual strength limit, and of the friction ANGLE (mesoscale specification 3.6). So G is mean
   * ratio times mean modulus, and eps_f mean eps_0 times mean ductility. Equal materials give their own constants, to the last bit.
   *
   * @throws InputError if their damage laws differ; the message names both materials
   */
  CpmParameters mean_of(const CpmMaterial &one, const CpmMaterial &other);

  /**
   * The laws of all links of a specimen: one for each pair of materials. A link knows its law by number (LinkSet::law_of), so
   * that what joins two particles may also be given instead of averaged.
   */
  class CpmTable
  {
  public:
    /** @throws InputError for constants out of range, or materials whose damage laws differ. */
    CpmTable(const CpmMaterials &materials);
    /** The one law of links that are all alike; implicit, for those who have constants only. */
    CpmTable(const CpmConstants &only);

    const CpmConstants &operator[](const std::size_t law) const { return laws[law]; }
    std::size_t         size() const { return laws.size(); }
    bool                several() const { return laws.size() > 1; }
    bool                shear_damages() const; ///< in some of them

    /** Number of the law of two materials: 0-0, 1-0, 1-1, 2-0, ... */
    static constexpr std::int32_t pair(const std::int32_t one, const std::int32_t other)
    {
      return one < other ? other * (other + 1) / 2 + one : one * (one + 1) / 2 + other;
    }

    /** Numbers of a record. */
    static constexpr std::size_t record = 16;
    /**
     * One law as the kernel gathers it, two cache lines: E, G, onset, 1/softening, cohesion, friction, kappa_broken, softening |
     * shear weight, linear factor, 0 ...
     */
    const double *record_of(const std::size_t law) const { return &records[record * law]; }

  private:
    void tabulate();

    std::vector<CpmConstants> laws;
    Column                    records;
  };
} // namespace dem

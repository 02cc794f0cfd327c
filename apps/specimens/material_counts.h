#pragma once

#include "dem/specimen/observation.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace apps
{
  /** How many particles are of each material, and how many links of each pair; nothing where there is one material. */
  struct MaterialCounts
  {
    std::vector<std::string> names;            ///< of the materials, in the scene's order; empty: there is one
    std::vector<std::size_t> particles, links; ///< of each material; of each pair, numbered as by dem::material_pair

    MaterialCounts() = default;
    /** @param material of each particle  @param pair of each link */
    MaterialCounts(std::vector<std::string>         scene_names,
                   const std::vector<std::int32_t> &material,
                   const std::vector<std::int32_t> &pair);
    /** Of a specimen as it now is, with the names of its packing's materials. */
    MaterialCounts(std::vector<std::string> scene_names, const dem::ObservedSpecimen &specimen);

    std::string text() const; ///< two lines, or none
    /** Put `materials` and `material_pairs` into a summary; nothing where there is one material. */
    void put_into(nlohmann::json &summary) const;

  private:
    /** Call `use(number, one, other, links)` for every pair. */
    template <typename Use>
    void each_pair(const Use &use) const;
  };
} // namespace apps

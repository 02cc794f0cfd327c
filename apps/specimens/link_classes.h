#pragma once

#include "base/column.h"
#include "dem/network/elastic_network.h"
#include "dem/specimen/observation.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace apps
{
  /** Classes of links, by the pair of materials that they join: of a mix mortar, aggregate and interface. */
  class LinkClasses
  {
  public:
    LinkClasses() = default;
    /** @param of_pairs class of each pair of materials, in the order of dem::material_pair(); empty: there is one material */
    explicit LinkClasses(const std::vector<std::string> &of_pairs);

    bool given() const { return !names.empty(); } ///< not where there is one material
    /** Class of each pair of materials, as given. */
    std::vector<std::string> of_pairs() const;
    /** Number of each link's class in json(); empty where there is one material. */
    std::vector<std::int32_t> of_links(const dem::LinkOutput &links) const;

    static constexpr std::size_t figures_of_one = 5; ///< made, broken, sum of damage, energy [J], area [m^2]
    /** Of a specimen as it is: a row of figures for each class. Nothing where there is one material. All ranks call this and learn it. */
    base::Column figures(const dem::ObservedSpecimen &specimen) const;
    /** Of links without a log of what broke. @param network that they are of, one by one */
    base::Column figures(const dem::LinkOutput &links, const dem::ElasticNetwork &network) const;

    /** What a summary says of such figures: links, broken, mean damage, energy of damage, and area of what broke, by class. */
    nlohmann::json json(const base::Column &figures) const;
    /** One line per class that has links; none where there is one material. */
    std::string text(const base::Column &figures) const;

  private:
    double *row_of(double *figures, std::int32_t pair) const;
    /** Add links to figures, but for areas. */
    void count(double *figures, const dem::LinkOutput &links) const;

    std::vector<std::string> names;
    std::vector<std::size_t> of_pair; ///< class of each pair of materials
  };
} // namespace apps

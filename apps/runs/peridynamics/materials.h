#pragma once

#include "apps/models/material_region.h"
#include "apps/models/mix.h"
#include "base/entry_path.h"
#include "dem/peridynamics/grid.h"
#include "dem/peridynamics/mixture.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Constants of the bonds of one material. */
  struct PeridynamicConstants
  {
    std::string name; ///< of the sub-section of "Materials"
    double      young_modulus = 0, density = 0;
    double      critical_stretch = 0, fracture_energy = 0; ///< one of them; both 0: never breaks

    void check(const base::EntryPath &section, int dimension, bool moves) const;
  };

  /** Sub-section of "Interfaces": bonds between two materials with constants of their own. */
  struct PeridynamicInterface
  {
    std::string name, one, other;
    bool        bonded        = true;
    double      young_modulus = 0, critical_stretch = 0, fracture_energy = 0; ///< 0: as two halves in series
  };

  /** Sections "Material", or "Materials", "Regions" and "Interfaces": of what a body's bonds are. */
  struct PeridynamicMaterialsSection
  {
    PeridynamicConstants            only; ///< section Material
    dem::peridynamics::BondModel    bonds         = dem::peridynamics::BondModel::prototype;
    dem::peridynamics::Calibration  calibration   = dem::peridynamics::Calibration::none;
    double                          poisson_ratio = 0;
    std::list<PeridynamicConstants> named; ///< empty: there is one
    std::list<MaterialRegion>       regions;
    std::list<PeridynamicInterface> interfaces;
    MixSection mix; ///< by which nodes are mortar or aggregate; of its factors ductility does not count

    /** @param size of the body [m] @param moves whether densities matter @throws base::InputError */
    void
    check(const base::EntryPath &root, dem::peridynamics::Space space, const Eigen::Vector3d &size, bool moves) const;

    std::vector<std::string> names() const; ///< empty where there is one
    /** @param horizon [m] @throws base::InputError for a material that no node is of */
    dem::peridynamics::Mixture mixture(const dem::peridynamics::Grid &grid, double horizon) const;

  private:
    void        check_interfaces(const base::EntryPath &root, int dimension) const;
    void        check_mix(const base::EntryPath &root, int dimension, const Eigen::Vector3d &size) const;
    std::size_t number(const std::string &name) const; ///< of a material
    /** Of each node dem::in_mortar, or the number of its aggregate, from 0: aggregates with bonds between them have different ones. */
    std::vector<std::int32_t> aggregates(const dem::peridynamics::Grid &grid, double horizon) const;
    /** Mortar, aggregates and interfaces of one material times factors. */
    dem::peridynamics::Mixture
    mixture_of(const dem::peridynamics::Material &mortar, const dem::peridynamics::Grid &grid, double horizon) const;
    /** Materials of the nodes, by place; those beyond the names are further numbers of the aggregate. */
    std::vector<std::int32_t> numbers(const dem::peridynamics::Grid &grid, double horizon) const;
    /** Bonds of such further numbers: as within an aggregate, between two as between it and mortar, with others as these with it. */
    void bond_copies(dem::peridynamics::Mixture &made) const;
  };
} // namespace apps

#pragma once

#include "apps/models/material.h"
#include "apps/specimens/mixed_specimen.h"
#include "base/entry_path.h"
#include "coupling/multiscale/cell_points.h"
#include "dem/model/packing.h"
#include "fem/points/registry.h"

#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** What a scene says of cells, besides their numbers. */
  struct CellsModel
  {
    SpecimenSection     source;
    MixSection          mix; ///< of the cell
    MaterialSection     material;
    bool                moves   = false; ///< the particles have inertia
    double              density = 0, damping = 0.2;
    std::int64_t        steps     = 0;
    int                 dimension = 3;
    bool                rotations = true, from_start = false, only_solved = false;
    std::int64_t        packings  = 1;
    double              promotion = 0.9, tolerance = 1e-9, growth_step = 0.5, contact_reach = 0.1;
    coupling::Localised localised = coupling::Localised::stop;

    MixedSpecimen mixed() const { return {source, mix, material, dimension}; } ///< particles and links of a cell
  };

  /** The block "cells" of a group of elements: particles behind its integration points (doc/theory/multiscale.md). */
  class CellsConstants : public CellsModel, public fem::MaterialConstants
  {
  public:
    /** Its numbers. */
    void visit(const fem::ConstantReceiver &number) override;
    /** @throws base::InputError */
    void check(const base::EntryPath &block) const;
    /** Particles and links of a cell, for `check`. Makes the packings. */
    std::string forecast() const;
    /** @throws base::InputError for particles that move behind a solid in equilibrium step by step */
    void refuse_motion(const base::EntryPath &block) const;

    std::unique_ptr<fem::MaterialPoints> make_points(fem::Plane plane) const override;

    void                                    check() const override {}
    std::unique_ptr<fem::MaterialConstants> copy() const override;
    std::unique_ptr<fem::DrivenPoint>       make_point() const override;
    void                                    take_stiffness(const base::Stiffness &) override;
    fem::UniaxialStrengths                  uniaxial_strengths() const override;
    double                                  averaging_length() const override { return 0; }
    double                                  largest_element_size() const override;
    void                                    require_element_size(double) const override {}

  private:
    std::unique_ptr<fem::MaterialPoints> moving(fem::Plane plane) const;

    const std::vector<std::shared_ptr<const coupling::PreparedCell>> &prepared() const;
    coupling::CellParameters                                          parameters() const;

    mutable std::vector<std::shared_ptr<const coupling::PreparedCell>> made; ///< once, when first needed, as the next
    mutable std::vector<dem::Packing>                                  packed;
  };

  /** Law = cells. */
  std::shared_ptr<const fem::MaterialKind> cells_kind();
} // namespace apps

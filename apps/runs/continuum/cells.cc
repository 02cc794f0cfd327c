#include "apps/runs/continuum/cells.h"

#include "coupling/multiscale/moving_cells.h"
#include "fem/points/driven_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace apps
{
  void CellsConstants::visit(const fem::ConstantReceiver &number)
  {
    number("Promotion", promotion, "-",
           "exertion of a link (1 where it damages or slides) at which the particles answer in place of the cell's "
           "elastic stiffness; with less the stress is the same, and more cells cost time",
           1e-6, 1, false);
    number("Tolerance", tolerance, "-",
           "unbalanced force over link forces of a cell, both as root of the sum of squares", 1e-13, 1e-2, false);
    number("Growth step", growth_step, "-",
           "largest growth of any link's damaging strain in one part of a step, over itself", 1e-4, 10, false);
    number("Contact reach", contact_reach, "-",
           "particles that no link joins touch once they meet: those whose surfaces are nearer than this part of the "
           "sum of their radii are watched; none where the interaction ratio goes further",
           0, 1, false);
  }

  void CellsConstants::refuse_motion(const base::EntryPath &block) const
  {
    if (moves)
      block.refuse("Answer", "particles that move want time, and a static analysis has none. Set Model/Analysis = "
                             "explicit, or Answer = equilibrium.");
  }

  void CellsConstants::check(const base::EntryPath &block) const
  {
    source.check(block, dimension);
    material.check(block, dimension);
    mixed().check(block);
    if (moves && (localised == coupling::Localised::crack_band || localised == coupling::Localised::refuse))
      block.refuse("When localised",
                   "a cell in motion has no tangent, and cannot be evaluated twice. Take stop or go on, "
                   "or Answer = equilibrium.");
    if (packings > 1 && source.source == SpecimenSection::Source::file)
      block.refuse("Packings", "a file has one packing. Leave it at 1, or generate them.");
  }

  coupling::CellParameters CellsConstants::parameters() const
  {
    coupling::CellParameters p;
    p.links.dimension         = dimension;
    p.links.thickness         = source.thickness;
    p.links.rotations         = rotations;
    p.links.interaction_ratio = source.interaction_ratio;
    p.links.contact_reach     = moves ? 0 : contact_reach;
    p.promotion               = promotion;
    p.from_start              = from_start;
    p.only_solved             = only_solved;
    p.response.tolerance      = tolerance;
    p.response.growth_step    = growth_step;
    return p;
  }

  const std::vector<std::shared_ptr<const coupling::PreparedCell>> &CellsConstants::prepared() const
  {
    for (std::int64_t i = static_cast<std::int64_t>(made.size()); i < packings; ++i)
      {
        SpecimenSection one = source;
        one.generator.seed += i;
        MixSection of = mix;
        of.seed += i;
        const MixedSpecimen specimen{one, of, material, dimension};
        packed.push_back(specimen.packing());
        made.push_back(std::make_shared<coupling::PreparedCell>(
          packed.back(), specimen.materials(packed.back().material_names), parameters()));
      }
    return made;
  }

  std::unique_ptr<fem::MaterialPoints> CellsConstants::moving(const fem::Plane plane) const
  {
    coupling::CellPointsParameters still;
    still.cells = prepared();
    // Cells share their materials: those of the packing with most numbers of the aggregate are those of all.
    const auto most =
      std::max_element(packed.begin(), packed.end(), [](const dem::Packing &one, const dem::Packing &other) {
        return one.material_names.size() < other.material_names.size();
      });
    coupling::MovingCellsParameters p{packed, mixed().materials(most->material_names), {}, steps, {}};
    p.stiffness                  = coupling::CellPoints(still, plane).elastic_stiffness();
    p.communicator               = MPI_COMM_WORLD;
    p.stops_localised            = localised == coupling::Localised::stop;
    p.specimen.physics.rotations = rotations;
    p.specimen.physics.dimension = dimension;
    p.specimen.thickness         = source.thickness;
    p.specimen.density           = density;
    p.specimen.damping           = damping;
    p.specimen.interaction_ratio = source.interaction_ratio;
    return std::make_unique<coupling::MovingCells>(std::move(p), plane);
  }

  std::unique_ptr<fem::MaterialPoints> CellsConstants::make_points(const fem::Plane plane) const
  {
    if (moves)
      return moving(plane);
    coupling::CellPointsParameters p;
    p.cells        = prepared();
    p.localised    = localised;
    p.communicator = MPI_COMM_WORLD; // of ranks that hold the whole mesh: make_solid()
    return std::make_unique<coupling::CellPoints>(p, plane);
  }

  std::string CellsConstants::forecast() const
  {
    const coupling::PreparedCell &cell = *prepared().front();
    const base::Stiffness        &D    = cell.stiffness();
    const std::string             waiting =
      cell.waiting_contacts() > 0 ? fmt::format(" ({} more where they may touch)", cell.waiting_contacts()) : "";
    return fmt::format("{} of {} particles and {} links{}, stiffness D11 {:.4g}, D22 {:.4g}, D33 {:.4g} Pa, {}",
                       packings == 1 ? "cells" : fmt::format("cells in {} packings", packings), cell.particles(),
                       cell.links(), waiting, D(0, 0), D(1, 1), D(2, 2),
                       moves      ? "in motion" :
                       from_start ? "promoted from the start" :
                                    fmt::format("promoted at {:g}", promotion));
  }

  std::unique_ptr<fem::MaterialConstants> CellsConstants::copy() const
  {
    return std::make_unique<CellsConstants>(*this);
  }

  std::unique_ptr<fem::DrivenPoint> CellsConstants::make_point() const
  {
    throw std::logic_error("cells: are not driven alone; scenes of kind cell and quasi_static do that.");
  }

  void CellsConstants::take_stiffness(const base::Stiffness &)
  {
    throw std::logic_error("cells: have other constants than a stiffness.");
  }

  fem::UniaxialStrengths CellsConstants::uniaxial_strengths() const
  {
    throw std::logic_error("cells: take no initial state.");
  }

  double CellsConstants::largest_element_size() const { return std::numeric_limits<double>::infinity(); }

  namespace
  {
    class CellsKind : public fem::MaterialKind
    {
    public:
      std::string name() const override { return coupling::CellPoints::name; }
      std::string meaning() const override { return "A periodic cell of particles behind each integration point"; }
      std::unique_ptr<fem::MaterialConstants> constants() const override { return std::make_unique<CellsConstants>(); }
      std::vector<fem::PointQuantity>         quantities() const override
      {
        std::vector<fem::PointQuantity> all;
        coupling::CellPoints::Record    record;
        coupling::CellPoints::describe(record, [&all](const fem::PointQuantity &of, double *) { all.push_back(of); });
        return all;
      }
      bool has_history() const override { return true; }
      bool takes_initial_state() const override { return false; }
      bool takes_stiffness() const override { return false; }
      bool takes_large_strains() const override { return true; }
      bool is_numerical(const std::string &key) const override { return key == "Tolerance" || key == "Growth step"; }
    };
  } // namespace

  std::shared_ptr<const fem::MaterialKind> cells_kind()
  {
    static const auto kind = std::make_shared<const CellsKind>();
    return kind;
  }
} // namespace apps

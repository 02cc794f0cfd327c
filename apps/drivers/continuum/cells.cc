#include "apps/drivers/continuum/cells.h"

#include "apps/specimens/specimen_packing.h"
#include "coupling/multiscale/moving_cells.h"
#include "fem/points/driven_point.h"

#include <fmt/format.h>

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

  void CellsConstants::declare(Section &block)
  {
    const auto  in_motion = [this] { return moves; };
    const auto  at_rest   = [this] { return !moves; };
    const char *when      = "Answer = motion";
    const char *otherwise = "Answer = equilibrium";
    for (const char *number : {"Promotion", "Tolerance", "Growth step", "Contact reach"})
      block.find_entry(number)->only_if(at_rest, otherwise);
    block.choice("Answer", moves, {{"equilibrium", false}, {"motion", true}}, Need::optional)
      .means(
        "equilibrium: of the particles at each strain; motion: they have inertia, and take steps while an explicit "
        "solid takes one (no promotion, no tangent)");
    block.number("Particle density", density, "kg/m^3", Range::positive(), Need::required)
      .means("Of the particles, not of the bulk")
      .only_if(in_motion, when);
    block.number("Particle damping", damping, "-", Range::from_up_to(0, 1), Need::optional)
      .means("Local (Cundall) damping of their motion about the cell's")
      .only_if(in_motion, when);
    block.integer("Particle steps", steps, "", Range::between(0, 1e6), Need::optional)
      .means("In one of the solid; 0: as many as their stable step asks for, and two at least: in the last one the "
             "cell stays as it "
             "is, so that its stress is that of the new strain. 1: the stress is one step old, as published")
      .only_if(in_motion, when);
    block.flag("From the start", from_start)
      .means("The particles of all cells answer from the first step on; for comparison, and for laws that are not "
             "linear to begin with")
      .only_if(at_rest, otherwise);
    block.flag("Elastic by solving", only_solved)
      .means("Promoted cells solve for equilibrium also where no link has damaged or slid; for comparison of costs")
      .only_if(at_rest, otherwise);
    block.integer("Packings", packings, "", Range::between(1, 1e6), Need::optional)
      .means(
        "Different packings of the generator, with seeds from its own on; the points of the mesh take them in turn");
    block
      .choice("When localised", localised,
              {{"stop", coupling::Localised::stop},
               {"crack band", coupling::Localised::crack_band},
               {"refuse", coupling::Localised::refuse},
               {"go on", coupling::Localised::go_on}},
              Need::optional)
      .means("What becomes of a cell whose tangent has lost ellipticity; in motion, one whose damage has gathered in a "
             "band since its stress began to fall. stop: the run ends with that state; crack "
             "band: it goes on as a layer of its element, the rest of which unloads; refuse: the solver looks for "
             "another state with shorter steps; go on: what follows hangs on the size of the elements. In motion stop "
             "or go on");
    block.flag("Rotations", rotations).means("Particles spin; off: they only translate");
    SpecimenSection::Use use;
    use.inertia = use.box = false;
    use.cell              = true;
    block.choice("Particles", dimension, {{"spheres", 3}, {"discs", 2}}, Need::optional)
      .means("discs: of a plane model, read from a file; the model is then neither in plane strain nor in plane "
             "stress, but as "
             "the discs are");
    source.declare(block, dimension, use);
    block.find_section("Specimen")
      ->find_entry("Thickness")
      ->only_if([this] { return dimension == 2; }, "Particles = discs");
    material.declare(block, false);
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
    if (moves && (localised == coupling::Localised::crack_band || localised == coupling::Localised::refuse))
      block.refuse("When localised", "a cell in motion has no tangent, and cannot be asked twice. Take stop or go on, "
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
        packed.push_back(make_packing(one, material, dimension));
        made.push_back(std::make_shared<coupling::PreparedCell>(packed.back(), material.materials(), parameters()));
      }
    return made;
  }

  std::unique_ptr<fem::MaterialPoints> CellsConstants::moving(const fem::Plane plane) const
  {
    coupling::CellPointsParameters still;
    still.cells = prepared();
    coupling::MovingCellsParameters p{packed, material.materials(), {}, steps, {}};
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

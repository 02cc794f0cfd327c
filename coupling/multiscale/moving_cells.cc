#include "coupling/multiscale/moving_cells.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "coupling/multiscale/stretch.h"

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace coupling
{
  using Eigen::Matrix3d;

  MovingCells::MovingCells(MovingCellsParameters given, const fem::Plane plane)
    : parameters(std::move(given))
    , dealt(parameters.communicator)
  {
    if (plane == fem::Plane::stress && !of_discs())
      throw base::InputError("cells of spheres are not built for plane stress. Set Model/Plane = strain, or "
                             "Model/Dimension = 3, or take discs (Particles = discs).");
    if (parameters.packings.empty())
      throw std::invalid_argument("moving cells: at least one packing is needed.");
    for (const dem::Packing &packing : parameters.packings)
      if (!packing.periodic_cell)
        throw base::InputError("cells: the packing has no periodic cell. Take one of breccia pack, or the generator.");
    parameters.specimen.physics.periodic = true;
  }

  MovingCells::~MovingCells() = default;

  void MovingCells::allocate(const std::size_t n_points)
  {
    points.clear();
    points.resize(n_points);
  }

  void MovingCells::place(std::vector<Site> given, const Setting &setting)
  {
    sites = std::move(given);
    dealt.name(setting.group);
    large_strains = setting.large_strains;
    if (of_discs() && !setting.plane)
      throw base::InputError("cells of discs are plane, and the model has three dimensions. Set Model/Dimension = 2, "
                             "or take spheres.");
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        if (!dealt.has(sites[i].number))
          continue;
        const dem::Packing &packing = parameters.packings[sites[i].number % parameters.packings.size()];
        points[i].specimen = std::make_unique<dem::Specimen>(packing, parameters.specimen, parameters.materials);
        points[i].volume   = points[i].specimen->cell().volume;
      }
  }

  std::int64_t MovingCells::least_steps(const Point &point) const
  {
    return static_cast<std::int64_t>(std::ceil(length / point.specimen->longest_step() * (1 - 1e-9)));
  }

  void MovingCells::begin_motion(const double requested)
  {
    length = requested;
    if (parameters.steps == 0)
      return;
    base::Column worst = {0, 0};
    for (const Point &point : points)
      if (point.specimen && static_cast<double>(least_steps(point)) > worst[0])
        worst = {static_cast<double>(least_steps(point)), point.specimen->longest_step()};
    for (const base::Column &of_rank : dealt.shown(worst))
      if (of_rank[0] > worst[0])
        worst = of_rank;
    if (static_cast<double>(parameters.steps) < worst[0])
      throw base::InputError("cells: Particle steps = " + std::to_string(parameters.steps) +
                             ": the stable step of their particles is " + base::number_text(worst[1]) +
                             " s, and that of the solid " + base::number_text(length) + " s long. Take at least " +
                             std::to_string(static_cast<std::int64_t>(worst[0])) +
                             ", 0 for as many as it wants, or a lower Motion/Safety.");
  }

  Matrix3d MovingCells::deformation(const base::Voigt &strain) const
  {
    base::Voigt seen = large_strains ? Stretch(strain).strain() : strain;
    if (of_discs())
      seen.segment<3>(2).setZero();
    return Matrix3d::Identity() + base::strain_tensor(seen);
  }

  void MovingCells::gather(const std::vector<base::Voigt> &strains, bool)
  {
    if (length == 0)
      return; // no time passes: what was found still stands
    const auto n = static_cast<std::int64_t>(points.size());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t i = 0; i < n; ++i)
      {
        Point &point = points[static_cast<std::size_t>(i)];
        if (!point.specimen)
          continue;
        try
          {
            point.failure.clear();
            drive(point, strains[static_cast<std::size_t>(i)]);
          }
        catch (const std::exception &problem) // no exception may leave a thread
          {
            point.failure = problem.what();
          }
      }
    length = 0;
    share_answers();
    find_localised();
  }

  void MovingCells::find_localised()
  {
    ++states;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (Point &point = points[i]; !point.normal.isZero(0))
        {
          point.has_localised     = 1;
          const Localisation here = {sites[i].place, point.normal, states};
          localised.add(here, parameters.stops_localised ?
                                here.text() + ". What its mean stress is worth from here on, its size decides: When "
                                              "localised = go on takes it nevertheless." :
                                std::string());
          point.normal.setZero();
        }
  }

  void MovingCells::share_answers()
  {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].specimen)
        own.push_back(i);
    dealt.share(own, [this](const std::size_t i, base::StateVisitor &visitor) { visit_answer(points[i], visitor); });
  }

  void MovingCells::visit_answer(Point &point, base::StateVisitor &visitor)
  {
    visit_text(visitor, "failure", point.failure);
    visitor.scalar("stored", point.stored);
    for (double &component : point.normal)
      visitor.scalar("normal", component);
    for (base::Voigt *of : {&point.strain, &point.stress, &point.inertia})
      for (double &component : *of)
        visitor.scalar("component", component);
  }

  void MovingCells::drive(Point &point, const base::Voigt &strain) const
  {
    dem::Specimen     &specimen = *point.specimen;
    const std::int64_t least    = least_steps(point);
    const std::int64_t steps    = parameters.steps > 0 ? parameters.steps : std::max<std::int64_t>(2, least);
    if (steps < least)
      throw fem::MaterialFailure("the cell's stable step is " + std::to_string(specimen.longest_step()) +
                                 " s: it wants " + std::to_string(least) + " steps in one of the solid.");
    const double step = length / static_cast<double>(steps);
    specimen.set_time_step(step);
    const Matrix3d from = deformation(point.strain), to = deformation(strain);
    // Forces are found at the beginning of a step: in the last one the cell stays, and they are those of the new deformation.
    const std::int64_t last = std::max<std::int64_t>(1, steps - 1);
    for (std::int64_t k = 1; k <= steps; ++k)
      {
        const double   part     = std::min(1.0, static_cast<double>(k) / static_cast<double>(last));
        const Matrix3d next     = from + part * (to - from);
        Matrix3d       gradient = (next * specimen.cell().deformation.inverse() - Matrix3d::Identity()) / step;
        if (of_discs())
          {
            gradient.row(2).setZero(); // round-off of the inverse
            gradient.col(2).setZero();
          }
        specimen.set_velocity_gradient(gradient);
        specimen.advance(1);
      }
    point.strain = strain;
    read(point);
  }

  void MovingCells::read(Point &point) const
  {
    const dem::ObservedSpecimen &specimen = *point.specimen;
    const dem::CellState         cell     = specimen.cell();
    const Matrix3d               cauchy   = 0.5 * (cell.stress + cell.stress.transpose());
    if (large_strains)
      {
        const Matrix3d back = cell.deformation_at_forces.inverse();
        point.stress = base::stress_voigt(cell.deformation_at_forces.determinant() * back * cauchy * back.transpose());
      }
    else
      point.stress = base::stress_voigt(cauchy);
    Matrix3d inertia = Matrix3d::Zero();
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      {
        const dem::ParticleState particle = specimen.particle(i);
        inertia -= particle.mass * particle.velocity * particle.velocity.transpose();
      }
    point.inertia                   = base::stress_voigt(inertia / cell.volume);
    const dem::EnergyAccount energy = specimen.energy();
    point.stored                    = (energy.elastic + energy.kinetic) / point.volume;
    // Compared with where its links are as they make this stress: one step before.
    if (const auto band =
          point.watch.update(specimen, {base::strain_voigt(cell.deformation_at_forces - Matrix3d::Identity()),
                                        base::stress_voigt(cauchy), energy.damage}))
      point.normal = band->normal;
  }

  void MovingCells::evaluate(const std::size_t  number,
                             const base::Voigt &strain,
                             const fem::ElementExtent &,
                             const bool        with_tangent,
                             fem::PointAnswer &answer)
  {
    const Point &point = points.at(number);
    if (!point.failure.empty())
      throw fem::MaterialFailure(point.failure);
    if (with_tangent || strain != point.strain)
      throw fem::MaterialFailure("a cell in motion answers to the steps of an explicit analysis only.");
    answer.stress = point.stress;
  }

  void MovingCells::set_initial(std::size_t, const fem::InitialPointState &, const fem::ElementExtent &)
  {
    throw base::InputError("cells: no initial state can be given to them.");
  }

  std::vector<fem::PointQuantity> MovingCells::quantities() const
  {
    using Kind  = fem::PointQuantity::Kind;
    using Role  = fem::PointQuantity::Role;
    using Shown = fem::PointQuantity::Shown;
    return {
      {"inertia_stress", "Pa", "of the particles' own motion, not in the stress", Kind::stress},
      {"strain_of_cell", "-", "", Kind::strain, Role::other, Shown::nowhere},
      {"stress_of_cell", "Pa", "", Kind::stress, Role::other, Shown::nowhere},
      {"localised", "-", "1: damage has gathered in a band of the cell", Kind::number, Role::other, Shown::counted}};
  }

  void MovingCells::visit(const std::size_t number, const fem::StateColumn &column)
  {
    Point     &point = points.at(number);
    const auto all   = quantities();
    column(all[0], point.inertia.data());
    column(all[1], point.strain.data());
    column(all[2], point.stress.data());
    column(all[3], &point.has_localised);
  }

  void MovingCells::visit_more(base::StateVisitor &visitor)
  {
    visitor.scalar("states", states);
    localised.visit_state(visitor);
    for (Point &point : points)
      {
        visitor.scalar("stored", point.stored);
        if (point.specimen)
          {
            point.specimen->visit_state(visitor);
            point.watch.visit_state(visitor);
          }
      }
  }

  double MovingCells::stored_energy(const std::size_t number, const base::Voigt &, const base::Voigt &) const
  {
    return points.at(number).stored;
  }

  base::Voigt MovingCells::inertia_part(const std::size_t number) const { return points.at(number).inertia; }
} // namespace coupling

#include "apps/runs/particles/body.h"

#include "apps/figures/energy_terms.h"
#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "base/errors.h"
#include "base/flat_state.h"
#include "dem/specimen/packed_clumps.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace apps
{
  namespace
  {
    dem::Specimen specimen_with_clumps(const ParticlesModel &model,
                                       const dem::Packing   &packing,
                                       const JointedPacking &jointed,
                                       const ParticleGroups &groups)
    {
      dem::Specimen made(jointed.packing(), model.parameters(), jointed.materials(model.materials(packing)),
                         launched_team().get());
      model.clumps.make(made, groups);
      dem::add_packed_clumps(made, packing, model.materials(packing));
      return made;
    }
  } // namespace

  ParticlesBody::ParticlesBody(const ParticlesModel &what, const dem::Packing &particles)
    : ParticlesBody(what, particles, what.jointed(particles))
  {
  }

  ParticlesBody::ParticlesBody(const ParticlesModel &what, const dem::Packing &particles, const JointedPacking &jointed)
    : model(&what)
    , packing(&particles)
    , groups(what.groups_in(particles))
    , classes(jointed.link_classes(what.mixed().link_classes(particles.material_names)))
    , body(specimen_with_clumps(what, particles, jointed, groups))
    , motion(body, what.motion, groups)
    , forces(body, what.forces, groups)
    , walls(body, what.walls)
  {
    if (what.laboratory.given())
      lab = std::make_unique<dem::LabTest>(
        body, what.laboratory.parameters(what.source.genesis.vessel(what.physics.dimension), what.source.thickness));
    constexpr double limit = 1e12; // a year at thirty thousand steps a second
    const bool       timed = what.end_time > 0;
    const double     steps = (timed ? what.end_time : lab->longest_loading()) / body.time_step();
    if (!(steps < limit))
      throw base::InputError(fmt::format("{} = {}: that would take {:.1e} steps of {:.1e} s. Check density, "
                                         "moduli and sizes: all in SI units.",
                                         timed ? "Time/End time" : "Laboratory/Speed",
                                         timed ? what.end_time : what.laboratory.requested.speed, steps,
                                         body.time_step()));
    share_among_ranks(body);
  }

  double ParticlesBody::done() const
  {
    return std::min(1.0, std::max(lab ? lab->done() : 0.0, body.time() / model->last_time()));
  }

  void ParticlesBody::put_mix_into(nlohmann::json &summary) const
  {
    model->mixed().put_into(summary);
    if (const nlohmann::json by_class = classes.json(classes.figures(body)); !by_class.empty())
      summary["link_classes"] = by_class;
  }

  StaticStart ParticlesBody::start()
  {
    const StaticStart found = start_statically(body, model->gravity);
    model->initial_velocity.give(body, *packing, groups);
    motion.drive_next_step(); // what is held moves as prescribed from the start
    if (body.surfaces().size() > 0)
      body.partners().find_surface_forces(); // refuses particles that lie in a wall
    return found;
  }

  std::vector<std::string> ParticlesBody::untouched_groups() const
  {
    const bool may_be_damped = model->time.damping > 0 || model->time.damping_in_time.given();
    if (may_be_damped && !model->gravity.vector().isZero(0))
      return {}; // local damping takes part of the weight
    return model->initial_velocity.untouched_since(body, *packing, groups, model->gravity.vector());
  }

  void ParticlesBody::drive_next_step()
  {
    if (motion.varies())
      motion.drive_next_step();
    if (walls.varies())
      walls.drive_next_step();
    push();
    if (model->time.damping_in_time.given())
      body.set_damping(model->time.damping_at(body.time()));
  }

  void ParticlesBody::push()
  {
    if (lab && lab->pushes() && forces.empty())
      body.partners().clear_forces();
    forces.apply();
    if (lab)
      lab->drive();
  }

  void ParticlesBody::visit_state(base::StateVisitor &visitor)
  {
    body.visit_state(visitor);
    motion.visit_state(visitor);
    if (lab)
      lab->visit_state(visitor);
  }

  void ParticlesBody::advance_to(const double time)
  {
    const bool comes_back = lab && !test_is_loading();
    push();
    body.advance(std::numeric_limits<std::int64_t>::max(), [&] {
      if (lab)
        lab->observe();
      drive_next_step();
      return body.time() < time && !interrupted_on_any_rank() && !test_is_over() && !(comes_back && test_is_loading());
    });
  }

  void ParticlesBody::repeat_loading_of(ParticlesBody &other, const double part_of_speed)
  {
    base::Column          state;
    base::FlatStateWriter writer(state);
    other.visit_state(writer);
    base::FlatStateReader reader(state);
    visit_state(reader);
    load_at(part_of_speed);
  }

  void ParticlesBody::advance(const std::int64_t steps)
  {
    push();
    body.advance(steps, [&] {
      if (lab)
        lab->observe();
      drive_next_step();
      return true;
    });
  }

  std::vector<double> ParticlesBody::probes() const
  {
    std::vector<double> values;
    if (model->probes.probes.empty())
      return values;
    const dem::ParticleKinematics particles = body.kinematics();
    const ProbedBody              seen{body, particles, motion, groups, walls};
    for (const ProbeSection &probe : model->probes.probes)
      values.push_back(value_of(probe, seen));
    return values;
  }

  std::vector<double> ParticlesBody::row() const
  {
    std::vector<double> row = {body.time()};
    for (const double value : probes())
      row.push_back(value);
    if (lab)
      for (const double value : SpecimenTestSection::row(*lab))
        row.push_back(value);
    const dem::Counts counts = body.counts();
    row.insert(row.end(), {static_cast<double>(counts.links), static_cast<double>(counts.broken),
                           static_cast<double>(counts.contacts + counts.wall_contacts)});
    append_energies(row, body.energy());
    return row;
  }
} // namespace apps

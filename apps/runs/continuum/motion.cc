#include "apps/runs/continuum/motion.h"

#include "apps/runs/continuum/analysis.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    fem::ExplicitOptions explicit_options(const ContinuumModel &model)
    {
      fem::ExplicitOptions options;
      for (const auto &group : model.materials.groups)
        options.density[group->group] = group->density;
      options.damping = model.motion.damping;
      options.safety  = model.motion.safety;
      return options;
    }

    template <int dim>
    fem::VectorOf<dim> initial_velocity(const MotionSection &motion)
    {
      return [&v = motion.initial_velocity](const dealii::Point<dim> &x, const double) {
        dealii::Tensor<1, dim> at;
        for (unsigned int c = 0; c < dim; ++c)
          if (v[c].given())
            at[c] = v[c](x[0], x[1], dim == 3 ? x[dim - 1] : 0.0, 0.0);
        return at;
      };
    }

    /** What pushes, drives and adds to the account from outside: of couplings, bodies in contact and rigid bodies. */
    template <int dim>
    void visit_outside(base::StateVisitor &visitor, fem::ExplicitOutside &outside, const fem::Solid<dim> &solid)
    {
      std::int64_t pushed = outside.force.size() > 0 ? 1 : 0;
      visitor.scalar("pushed_from_outside", pushed);
      if (pushed == 1)
        {
          if (outside.force.size() == 0)
            outside.force = solid.make_vector();
          visit_vector(visitor, "outside_force", outside.force);
        }
      std::vector<std::int32_t> driven;
      base::Column              velocity;
      for (const auto &[displacement, at] : outside.driven)
        {
          driven.push_back(static_cast<std::int32_t>(displacement));
          velocity.push_back(at);
        }
      visitor.column("driven", driven);
      visitor.column("driven_velocity", velocity);
      outside.driven.clear();
      for (std::size_t k = 0; k < driven.size(); ++k)
        outside.driven[static_cast<unsigned int>(driven[k])] = velocity[k];
      visitor.scalar("outside_work", outside.work);
      visitor.scalar("outside_damped", outside.damped);
      visitor.scalar("outside_start", outside.start);
    }

    /** What the step of deformed elements was found with; all have the same number of distances. */
    void visit_elements(base::StateVisitor &visitor, fem::ExplicitState &saved)
    {
      if (saved.elements.empty())
        return;
      base::Column distances, eigenvalues;
      for (const fem::ElementStep &element : saved.elements)
        {
          distances.insert(distances.end(), element.distances.begin(), element.distances.end());
          eigenvalues.push_back(element.eigenvalue);
        }
      visitor.column("element_distances", distances);
      visitor.column("element_eigenvalues", eigenvalues);
      visitor.scalar("since_look", saved.since_look);
      const double *next = distances.data();
      for (std::size_t e = 0; e < saved.elements.size(); ++e)
        {
          for (double &distance : saved.elements[e].distances)
            distance = *next++;
          saved.elements[e].eigenvalue = eigenvalues.at(e);
        }
    }
  } // namespace

  std::int64_t steps_of(const MotionSection &motion, const double length)
  {
    constexpr double most = 1e12;
    const double     n    = std::ceil(motion.end_time / length * (1 - 1e-12));
    if (!(n < most))
      throw base::InputError(fmt::format("Motion/End time = {}: would take {:.1e} steps of {:.1e} s. Check density, "
                                         "moduli and sizes: all in SI units.",
                                         motion.end_time, n, length));
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(n));
  }

  double step_towards(const double rest, const double longest)
  {
    constexpr double rounding = 1e-12;
    return rest / std::max(1.0, std::ceil(rest / longest * (1 - rounding)));
  }

  template <int dim>
  std::unique_ptr<fem::ExplicitSolver<dim>>
  make_motion(fem::Solid<dim> &solid, const ContinuumModel &model, const std::array<double, 3> &gravity)
  {
    fem::ExplicitOptions options = explicit_options(model);
    options.gravity              = gravity;
    auto        motion           = std::make_unique<fem::ExplicitSolver<dim>>(solid, options);
    const auto &v                = model.motion.initial_velocity;
    if (v[0].given() || v[1].given() || v[2].given())
      motion->set_velocity(initial_velocity<dim>(model.motion));
    return motion;
  }

  template <int dim>
  void visit_motion(base::StateVisitor &visitor, fem::ExplicitSolver<dim> &motion, fem::Solid<dim> &solid)
  {
    fem::ExplicitState saved   = motion.state();
    std::int64_t       started = saved.started ? 1 : 0;
    visitor.scalar("time", saved.time);
    visitor.scalar("started", started);
    saved.started = started == 1;
    visitor.scalar("energy_kinetic", saved.energy.kinetic);
    visitor.scalar("energy_internal", saved.energy.internal);
    visitor.scalar("energy_external", saved.energy.external);
    visitor.scalar("energy_damped", saved.energy.damped);
    visitor.scalar("energy_start", saved.energy.start);
    visit_vector(visitor, "displacement", saved.displacement);
    visit_vector(visitor, "velocity", saved.velocity);
    visit_vector(visitor, "internal_force", saved.internal_force);
    visit_vector(visitor, "mean_velocity", saved.mean_velocity);
    visit_vector(visitor, "last_motion", saved.last_motion);
    visitor.scalar("last_length", saved.last_length);
    visit_outside(visitor, saved.outside, solid);
    visit_vector(visitor, "external_force", saved.external_force);
    visit_elements(visitor, saved);
    motion.restore(saved);
    visit_histories(visitor, solid);
  }

  ContinuumEnergy energy_of(const fem::ExplicitEnergy &motion)
  {
    ContinuumEnergy energy;
    energy.external = motion.external;
    energy.internal = motion.internal;
    energy.kinetic  = motion.kinetic;
    energy.damped   = motion.damped;
    energy.start    = motion.start;
    return energy;
  }

  template std::unique_ptr<fem::ExplicitSolver<2>>
  make_motion(fem::Solid<2> &, const ContinuumModel &, const std::array<double, 3> &);
  template std::unique_ptr<fem::ExplicitSolver<3>>
                make_motion(fem::Solid<3> &, const ContinuumModel &, const std::array<double, 3> &);
  template void visit_motion(base::StateVisitor &, fem::ExplicitSolver<2> &, fem::Solid<2> &);
  template void visit_motion(base::StateVisitor &, fem::ExplicitSolver<3> &, fem::Solid<3> &);
} // namespace apps

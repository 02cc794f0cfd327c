#include "dem/specimen/specimen.h"

#include "base/errors.h"
#include "dem/specimen/core.h"
#include "dem/specimen/gathered_state.h"
#include "dem/specimen/taken_state.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace dem
{
  namespace
  {
    void check_plane(const Packing &packing)
    {
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (packing.centre[i].z() != 0)
          {
            std::ostringstream message;
            message << "particle " << i + 1 << ": z = " << packing.centre[i].z()
                    << " m, but a scene in two dimensions lies in the plane z = 0.";
            throw base::InputError(message.str());
          }
    }

    std::unique_ptr<SpecimenCore> make_core(const Packing            &packing,
                                            const SpecimenParameters &parameters,
                                            const LinkMaterials      &materials,
                                            Ranks *const              found_by)
    {
      parameters.check();
      check_packing(packing, "packing");
      check_in_cell(packing, "packing");
      check_materials(packing, materials);
      if (parameters.physics.dimension == 2)
        check_plane(packing);
      return std::make_unique<SpecimenCore>(packing, parameters, materials, found_by);
    }
  } // namespace

  Specimen::Specimen(const Packing            &packing,
                     const SpecimenParameters &parameters,
                     const LinkMaterials      &materials,
                     Ranks *const              found_by)
    : ObservedSpecimen(make_core(packing, parameters, materials, found_by))
  {
  }

  Specimen::~Specimen()                               = default;
  Specimen::Specimen(Specimen &&) noexcept            = default;
  Specimen &Specimen::operator=(Specimen &&) noexcept = default;
  Specimen::Specimen(const Specimen &)                = default;
  Specimen &Specimen::operator=(const Specimen &)     = default;

  void Specimen::advance(const std::int64_t steps)
  {
    advance(steps, [] { return true; });
  }

  void Specimen::advance(const std::int64_t steps, const std::function<bool()> &go_on)
  {
    if (self->step_count == 0)
      self->begin();
    bool more = true;
    for (std::int64_t s = 0; s < steps && more; ++s)
      {
        self->step();
        more = go_on();
      }
    self->check_numbers();
  }

  Grips       Specimen::grips() { return Grips(*self); }
  Surfaces    Specimen::surfaces() { return Surfaces(*self); }
  RigidClumps Specimen::clumps() { return RigidClumps(*self); }
  Partners    Specimen::partners() { return Partners(*self); }

  void Specimen::set_time_step(const double step)
  {
    constexpr double rounding = 1e-12;
    if (step > 0 && step <= (1 + rounding) * self->longest_step)
      {
        self->time_step = std::min(step, self->longest_step);
        return;
      }
    std::ostringstream message;
    message << "step of " << step << " s: must be above 0 and at most " << self->longest_step
            << " s, the stable one of the particles with the step factor.";
    throw base::InputError(message.str());
  }

  void Specimen::set_damping(const double damping)
  {
    if (!(damping >= 0 && damping < 1))
      throw base::InputError("Damping: must be in [0, 1).");
    self->parameters.damping = damping;
  }

  void Specimen::set_velocity(const std::size_t particle, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    double *v = &self->particles.velocity[record_size * static_cast<std::size_t>(self->slot.at(particle))];
    std::copy_n(velocity.data(), 3, v);
    std::copy_n(spin.data(), 3, v + 3);
    const std::int32_t of = self->particles.clump_of(static_cast<std::size_t>(self->slot[particle]));
    if (of >= 0)
      self->clumps.take_velocities(self->particles, static_cast<std::size_t>(of));
  }

  void Specimen::set_velocities(const std::vector<PrescribedVelocity> &requested)
  {
    Particles                       &p = self->particles;
    std::set<std::size_t>            moved; // clumps
    std::vector<std::array<bool, 6>> given(p.count, {true, true, true, true, true, true});
    for (const PrescribedVelocity &one : requested)
      {
        const auto i = static_cast<std::size_t>(self->slot.at(one.particle));
        for (int c = 0; c < 6; ++c)
          p.velocity[record_size * i + c] = !one.given[c] ? 0.0 : c < 3 ? one.velocity[c] : one.spin[c - 3];
        given[i] = one.given;
        if (p.clump_of(i) >= 0)
          moved.insert(static_cast<std::size_t>(p.clump_of(i)));
      }
    for (const std::size_t clump : moved)
      {
        self->clumps.take_velocities(p, clump, given);
        self->clumps.drive(p, clump);
      }
  }

  void Specimen::visit_state(base::StateVisitor &visitor)
  {
    if (self->shares())
      {
        GatheredState all(*self, visitor);
        return self->visit_state(all);
      }
    if (!self->shared || !visitor.finds_by_name())
      return self->visit_state(visitor);
    TakenState own(*self, visitor);
    self->visit_state(own);
    own.take_rest();
  }

  void Specimen::share_among(std::shared_ptr<Ranks> ranks, const std::int64_t move_every)
  {
    self->shared.emplace(std::move(ranks), move_every);
  }
} // namespace dem

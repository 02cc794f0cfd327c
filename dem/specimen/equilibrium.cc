#include "base/errors.h"
#include "dem/core/memory_pages.h"
#include "dem/kernels/kinematics.h"
#include "dem/linear/linear_solver.h"
#include "dem/measures/link_measures.h"
#include "dem/network/loaded_hinges.h"
#include "dem/network/loaded_network.h"
#include "dem/network/rigid_motions.h"
#include "dem/specimen/core.h"
#include "dem/specimen/specimen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    constexpr int most_solutions = 30; // each gains the digits of 1/strain, unless the specimen is about to buckle
    /** Share of the weight along a motion that nothing holds, beyond rounding. */
    constexpr double no_load = 1e-9;
    /** Of the particles: more without equilibrium, and the specimen is not what it was meant to be. */
    constexpr double unsettled_share = 0.01;
    /** Residuals that rounding alone may leave, over its root-mean-square estimate. */
    constexpr double rounding_margin = 4;

    [[noreturn]] void refuse(const std::string &why) { throw base::InputError("Initial equilibrium: " + why); }

    /** The bonds as they are now, undamaged; particles by their number in the packing. */
    ElasticNetwork network_of(const Particles &p, const LinkSet &bonds, const LinkLaw &law, const Physics &physics)
    {
      LinkReader     reader(p, bonds, law);
      ElasticNetwork network;
      network.dimension = physics.dimension;
      network.rotations = physics.rotations;
      network.centre.resize(p.count);
      for (std::size_t i = 0; i < p.count; ++i)
        network.centre[static_cast<std::size_t>(p.number[i])] = p.position_of(i);
      for (std::size_t l = 0; l < bonds.count; ++l)
        {
          if (!bonds.is_alive(l))
            continue;
          reader.read(l, Geometry::present);
          const LinkStiffnesses moduli = reader.stiffness();
          const std::int32_t    J = bonds.first[l], K = bonds.second[l];
          ElasticLink           link;
          link.first                   = p.number[J];
          link.second                  = p.number[K];
          link.branch                  = branch_of(p, bonds, l);
          const double length          = link.branch.norm();
          link.direction               = link.branch / length;
          link.shift                   = Eigen::Vector3d::Zero();
          link.arm_first               = 0.5 * (length + p.radius_of(J) - p.radius_of(K));
          link.arm_second              = length - link.arm_first;
          link.area                    = bonds.area[l];
          link.reference               = bonds.reference_length[l];
          const Eigen::Matrix3d normal = link.direction * link.direction.transpose();
          link.stiffness               = link.area / bonds.reference_length[l] *
                           (moduli.normal * normal + moduli.shear * (Eigen::Matrix3d::Identity() - normal));
          link.turning = moduli.twist * normal + moduli.bending * (Eigen::Matrix3d::Identity() - normal);
          network.links.push_back(link);
        }
      return network;
    }

    /** What of each particle, by packing number, is held or does not exist; of loose ones everything. */
    std::vector<HeldMotions> held_motions(const Particles &p, const std::size_t loose)
    {
      std::vector<HeldMotions> held(p.count, 0);
      for (std::size_t i = 0; i < p.count; ++i)
        for (int c = 0; c < motions; ++c)
          {
            const auto number = static_cast<std::size_t>(p.number[i]);
            if (p.inverse_mass[record_size * i + c] == 0 || number + loose >= p.count)
              held[number] |= HeldMotions(1u << c);
          }
      return held;
    }

    /** Forces and moments on the particles where nothing holds them, by packing number. */
    ParticleMotions free_forces(const Particles &p, const std::vector<HeldMotions> &held)
    {
      ParticleMotions force(motions, static_cast<Eigen::Index>(p.count));
      for (std::size_t i = 0; i < p.count; ++i)
        for (int c = 0; c < motions; ++c)
          {
            const auto number                           = static_cast<std::size_t>(p.number[i]);
            force(c, static_cast<Eigen::Index>(number)) = held[number] >> c & 1 ? 0.0 : p.force[record_size * i + c];
          }
      return force;
    }

    struct Residual
    {
      double ratio, rounding; ///< see InitialEquilibrium
    };

    Residual residual_of(
      const ParticleMotions &force, const Particles &p, const LinkSet &bonds, const LinkLaw &law, const double arm)
    {
      LinkReader reader(p, bonds, law);
      double     links = 0, noise = 0;
      for (std::size_t l = 0; l < bonds.count; ++l)
        {
          if (!bonds.is_alive(l))
            continue;
          reader.read(l, Geometry::present);
          links += Eigen::Vector3d(&bonds.force[record_size * l]).squaredNorm();
          const double coordinate = std::max(p.position_of(bonds.first[l]).lpNorm<Eigen::Infinity>(),
                                             p.position_of(bonds.second[l]).lpNorm<Eigen::Infinity>());
          noise += std::pow(std::numeric_limits<double>::epsilon() * coordinate * reader.stiffness().normal *
                              bonds.area[l] / bonds.reference_length[l],
                            2);
        }
      const double left = force.topRows<3>().squaredNorm() + force.bottomRows<3>().squaredNorm() / (arm * arm);
      if (links == 0)
        return {left > 0 ? std::numeric_limits<double>::infinity() : 0.0, 0.0};
      return {std::sqrt(left / links), std::sqrt(2 * noise / links)};
    }

    /** Small motions that balance the forces. */
    ParticleMotions solve(const ElasticNetwork           &network,
                          const std::vector<HeldMotions> &held,
                          const ParticleMotions          &force,
                          SolverReport                   &report)
    {
      const StiffnessOperator stiffness(network, held);
      const double            scale = stiffness.length_scale();
      const auto              at    = [](const std::size_t k, const int c) { return (motions * k + c) * load_lanes; };
      Fields                  b(motions * load_lanes * network.particles(), 0.0), x(b);
      for (std::size_t k = 0; k < network.particles(); ++k)
        for (int c = 0; c < motions; ++c)
          if (!stiffness.is_held(k, c))
            b[at(k, c)] = force(c, stiffness.order()[k]) / (c < 3 ? 1 : scale);
      LaneStrains none;
      none.fill(base::Vector6::Zero());
      report = solve_linear(stiffness, b, x, none, false, {});
      ParticleMotions motion(motions, static_cast<Eigen::Index>(network.particles()));
      for (std::size_t k = 0; k < network.particles(); ++k)
        for (int c = 0; c < motions; ++c)
          motion(c, stiffness.order()[k]) = x[at(k, c)] / (c < 3 ? 1 : scale);
      return motion;
    }

    /** Links that the law no longer takes as elastic. */
    void refuse_onset(const Particles &p, const LinkSet &bonds, const LinkLaw &law)
    {
      const bool  slid    = plastic_dissipation(bonds) > 0;
      std::size_t damaged = 0, sliding = 0, worst = 0;
      double      strain = 0;
      LinkReader  reader(p, bonds, law);
      for (std::size_t l = 0; l < bonds.count; ++l)
        {
          if (!bonds.is_alive(l))
            continue;
          reader.read(l);
          const LinkExertion exertion = reader.exertion();
          sliding += slid && exertion.sliding >= 1 - 1e-9;
          damaged += exertion.damage > 1;
          if (exertion.damage > strain)
            {
              strain = exertion.damage;
              worst  = l;
            }
        }
      if (damaged + sliding == 0)
        return;
      std::ostringstream why;
      why << "under gravity alone " << damaged << " of " << bonds.alive << " links damage and " << sliding
          << " slide, so that it is not elastic.";
      if (damaged > 0)
        why << " The worst joins particles " << p.number[bonds.first[worst]] + 1 << " and "
            << p.number[bonds.second[worst]] + 1 << ", strained to " << strain << " of the limit elastic strain.";
      why << " Let gravity act in motion instead (Initial equilibrium = none), or lower it.";
      refuse(why.str());
    }

    [[noreturn]] void refuse_unbalanced(const InitialEquilibrium &found)
    {
      std::ostringstream why;
      why << "none is near: after " << found.solutions << " solutions the unbalanced forces are still "
          << found.unbalanced_ratio << " of the link forces. It is too slender or too soft for its weight.";
      refuse(why.str());
    }

    /** What is held, and as much of what has no equilibrium that its place is determined; a small part at most. */
    std::vector<HeldMotions> with_unsettled(const ElasticNetwork    &network,
                                            const ParticleMotions   &weight,
                                            std::vector<HeldMotions> held,
                                            InitialEquilibrium      &found)
    {
      const RigidMotions     rigid(network, held);
      std::vector<Mechanism> unsettled = hold_loaded_hinges(network, held, weight);
      for (const Mechanism &body : rigid.floating())
        {
          for (const std::int32_t i : body.particles)
            held[i] = HeldMotions(~0u);
          unsettled.push_back(body);
        }
      found.unsettled = floaters(unsettled);
      if (static_cast<double>(found.unsettled.size()) <= unsettled_share * static_cast<double>(network.particles()))
        return held;
      refuse((rigid.floating().empty() ? "" : "nothing holds a part of the specimen: ") + describe(unsettled) +
             " Raise the interaction ratio, grip them or take them out of the packing.");
    }
  } // namespace

  double SpecimenCore::weight_work()
  {
    if (parameters.gravity.isZero(0))
      return 0;
    double work = clumps.weight_work(parameters.gravity);
    walk_particles(&work, 1, [&](const std::size_t first, const std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        {
          const Eigen::Vector3d moved(&particles.motion[record_size * i]), start(&particles.reference[3 * i]);
          work += particles.mass[i] * parameters.gravity.dot(particles.position_of(i) - moved - start);
        }
    });
    return work;
  }

  void SpecimenCore::begin()
  {
    const double of_surfaces = surfaces.empty() ? 0.0 : begin_surfaces(); // may shorten the step
    // Velocities are those of half a step before the first forces: so are the energies that the account starts from.
    clumps.drive(particles);
    double of_links = 0, of_weight = 0.5 * time_step * clumps.power_of_weight(parameters.gravity);
    for (std::size_t i = 0; i < particles.count; ++i)
      for (int c = 0; c < 6; ++c)
        {
          const double weight = c < 3 ? particles.mass[i] * parameters.gravity[c] : 0.0,
                       moved  = 0.5 * time_step * particles.velocity[record_size * i + c];
          of_weight += weight * moved;
          if (book.stored_at_start > 0) // otherwise links carry nothing yet
            of_links += (particles.force[record_size * i + c] - weight) * moved;
        }
    book.initial         = kinetic_of_velocities() + book.stored_at_start + of_links + begin_contacts() + of_surfaces;
    book.weight_at_start = weight_work() - of_weight;
    if (bonds.streams || contacts.streams) // large: what they were made of
      give_back_freed();
  }

  double SpecimenCore::begin_contacts()
  {
    if (contacts.alive == 0)
      return 0;
    contact_pass(contacts, particles, *contact_law,
                 contacts.whole()); // nothing has moved yet: the first step will find the same
    return elastic_energy(particles, contacts, *contact_law) - 0.5 * time_step * power_of_ends(particles, contacts);
  }

  void SpecimenCore::find_forces()
  {
    bond_pass(bonds, particles, *bond_law, bonds.whole());
    // A step of no length: forces are summed up, nothing moves, and the last motion is done with.
    select_particle_pass(false, false, equal_radii, moments(),
                         surroundings())(particles, bonds, nullptr, surfaces.on_particles(), {0.0, 0.0}, 0.0,
                                         parameters.gravity, {0, accounts.size()}, accounts);
    held.sum_forces(particles);
  }

  void SpecimenCore::displace(const ParticleMotions &motion)
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        const auto            moved     = motion.col(particles.number[i]);
        const Eigen::Vector3d turn      = moved.tail<3>();
        const double          angle     = turn.squaredNorm();
        double               *pose      = &particles.pose[record_size * i];
        const Eigen::Vector3d stretched = half_tangent_factor(rotation_coefficients(angle), angle) * turn;
        for (int c = 0; c < 3; ++c)
          {
            pose[c] += moved[c];
            pose[3 + c] = stretched[c];
          }
        for (int c = 0; c < motions; ++c)
          particles.motion[record_size * i + c] = moved[c];
      }
  }

  InitialEquilibrium SpecimenCore::find_equilibrium(const EquilibriumWatch &watch)
  {
    InitialEquilibrium             found;
    const std::vector<HeldMotions> fixed = held_motions(particles, parameters.loose);
    find_forces();
    ParticleMotions left = free_forces(particles, fixed);
    if (left.isZero(0))
      return found;
    const std::vector<HeldMotions> still =
      with_unsettled(network_of(particles, bonds, *bond_law, parameters.physics), left, fixed, found);
    // What finds no equilibrium weighs nothing yet: fixed up, it would push the rest about.
    const auto unbalanced = [&] {
      ParticleMotions force = free_forces(particles, still);
      for (const std::int32_t i : found.unsettled)
        for (int c = 0; c < 3; ++c)
          if (!(still[i] >> c & 1))
            force(c, i) -= particles.mass[slot[i]] * parameters.gravity[c];
      return force;
    };
    left = unbalanced();
    while (true)
      {
        if (watch)
          watch(found);
        const ElasticNetwork network = network_of(particles, bonds, *bond_law, parameters.physics);
        const RigidMotions   rigid(network, fixed, found.unsettled);
        if (found.solutions == 0 && rigid.loaded_by(left) > no_load)
          refuse("gravity acts along a motion of the whole specimen that no grip or support prevents. Hold it, or turn "
                 "gravity.");
        std::vector<HeldMotions> supported = rigid.supported();
        for (std::size_t i = 0; i < supported.size(); ++i)
          supported[i] |= still[i];
        SolverReport    solver;
        ParticleMotions motion = solve(network, supported, left, solver);
        if (!solver.converged)
          refuse(solver.mechanisms.empty() ? "the linear solution did not converge: " + solver.text() :
                                             describe(solver.mechanisms));
        if (found.solutions++ == 0)
          {
            found.solver       = solver.text();
            found.undetermined = floaters(solver.mechanisms).size();
          }
        rigid.remove_from(motion);
        displace(motion);
        find_forces();
        refuse_onset(particles, bonds, *bond_law);
        left                    = unbalanced();
        const Residual residual = residual_of(left, particles, bonds, *bond_law, mean_arm(network));
        const bool     stalls   = found.solutions > 1 && residual.ratio > 0.5 * found.unbalanced_ratio;
        found.unbalanced_ratio  = residual.ratio;
        found.rounding          = residual.rounding;
        if (residual.ratio <= wanted_unbalanced_ratio ||
            (stalls && residual.ratio <= rounding_margin * residual.rounding))
          break;
        if (found.solutions == most_solutions || !std::isfinite(residual.ratio))
          refuse_unbalanced(found);
      }
    start_from_equilibrium(found);
    return found;
  }

  void SpecimenCore::start_from_equilibrium(InitialEquilibrium &found)
  {
    for (std::size_t i = 0; i < particles.count; ++i)
      if (particles.made_links[i] > 0)
        found.largest_displacement = std::max(
          found.largest_displacement, (particles.position_of(i) - Eigen::Vector3d(&particles.reference[3 * i])).norm());
    LinkReader reader(particles, bonds, *bond_law);
    for (std::size_t l = 0; l < bonds.count; ++l)
      {
        if (!bonds.is_alive(l))
          continue;
        reader.read(l);
        found.largest_strain = std::max(found.largest_strain, reader.exertion().damage);
      }
    book.stored_at_start = elastic_energy(particles, bonds, *bond_law);
    if (parameters.physics.contacts)
      {
        accounts.front().fastest = found.largest_displacement * found.largest_displacement;
        make_contacts();
      }
  }

  InitialEquilibrium Specimen::find_equilibrium(const EquilibriumWatch &watch)
  {
    if (self->step_count > 0)
      refuse("must be found before the first step.");
    if (self->parameters.physics.periodic)
      refuse("a periodic cell has no supports and no weight.");
    if (!self->surfaces.empty())
      refuse("walls only push, and the static solver knows no contact. Let the weight settle in motion.");
    if (!self->clumps.empty())
      refuse("the static solver knows no clumps. Let the weight settle in motion.");
    return self->find_equilibrium(watch);
  }

  ElasticNetwork ObservedSpecimen::network() const
  {
    self->gather();
    return network_of(self->particles, self->bonds, *self->bond_law, self->parameters.physics);
  }
} // namespace dem

#include "apps/runs/coupled/energy_watch.h"

#include "apps/results/run_work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace
  {
    /** Of the largest energy: losses below it are not worth a warning. */
    constexpr double felt = 1e-3;

    /** Where contacts at points are on dented or round faces. */
    std::string remedy_of_contacts(const CouplingSection &coupling)
    {
      return coupling.spreading == coupling::Spreading::none ?
               "In dents contacts at points are not conservative: set its Spreading = automatic, or Contact = "
               "pressure." :
               "On faces that were not flat spread contacts are not conservative: set its Contact = pressure.";
    }

    std::string names_of_couplings(const CoupledModel &model)
    {
      std::vector<std::string> names;
      for (const CouplingSection &coupling : model.couplings.couplings)
        names.push_back("Couplings/" + coupling.name);
      for (const HandshakeSection &handshake : model.handshakes.handshakes)
        names.push_back("Handshakes/" + handshake.name);
      for (const ContactSection &contact : model.continuum.contacts.contacts)
        names.push_back("Contacts/" + contact.name);
      return fmt::format("{}", fmt::join(names, ", "));
    }
  } // namespace

  template <int dim>
  EnergyWatch<dim>::EnergyWatch(const CoupledModel                    &what,
                                const coupling::ConcurrentMotion<dim> &both_,
                                const ObservedContacts<dim>           &touching_)
    : model(what)
    , both(both_)
    , touching(touching_)
    , most_absorbed(what.handshakes.handshakes.size(), 0.0)
  {
  }

  template <int dim>
  void EnergyWatch<dim>::update(const CoupledEnergies &now)
  {
    const fem::ExplicitEnergy &s = now.solid;
    const dem::EnergyAccount  &p = now.particles;
    largest = std::max({largest, s.kinetic + std::fabs(s.internal), p.kinetic + p.elastic, std::fabs(s.external),
                        std::fabs(p.external_work), std::fabs(p.gravity)});
    touching.require_balance(largest, now.time);
    check_surfaces(now.time);
    check_handshakes(now);
    check_balance(now);
  }

  template <int dim>
  void EnergyWatch<dim>::require(
    const std::string &of, const double made, const double limit, const double time, const std::string &remedy) const
  {
    if (std::fabs(made) > limit * largest)
      throw StoppedShort(fmt::format(
        "{}: at {:.6g} s the coupling has {} {:.3g} J by itself, more than Energy limit = {} of the largest "
        "energy, {:.3g} J. {}",
        of, time, made > 0 ? "made" : "lost", std::fabs(made), limit, largest, remedy));
  }

  template <int dim>
  void EnergyWatch<dim>::check_surfaces(const double time) const
  {
    auto coupling = model.couplings.couplings.begin();
    for (const auto &surface : both.surfaces())
      {
        const coupling::SurfaceBalance balance = surface->balance();
        const double                   made    = balance.spurious_in_all();
        require("Couplings/" + coupling->name, made, coupling->energy_limit, time,
                std::fabs(balance.contacts) > std::fabs(balance.spurious()) ? remedy_of_contacts(*coupling) :
                                                                              remedy(made, coupling->energy_limit));
        ++coupling;
      }
  }

  template <int dim>
  void EnergyWatch<dim>::check_handshakes(const CoupledEnergies &now)
  {
    const double of_both = std::min(now.particles.elastic, now.solid.internal); // the less of what either side stores
    auto         said    = model.handshakes.handshakes.begin();
    auto         most    = most_absorbed.begin();
    for (const auto &volume : both.volumes())
      {
        const coupling::VolumeBalance &balance = volume->balance();
        const std::string              name    = "Handshakes/" + said->name;
        require(name, balance.spurious(), said->energy_limit, now.time,
                volume->loses_by_itself() ? "Take Ties = coarse or strict, which lose nothing." :
                                            remedy(balance.spurious(), said->energy_limit));
        *most = std::max(*most, balance.absorbed);
        if (*most - balance.absorbed > said->energy_limit * largest)
          throw StoppedShort(
            fmt::format("{}: at {:.6g} s the absorber has given back {:.3g} J of what it took, more than "
                        "Energy limit = {} of the largest energy, {:.3g} J. Lower Rate.",
                        name, now.time, *most - balance.absorbed, said->energy_limit, largest));
        // What would be there twice and is in neither is a gain that is booked.
        if (balance.double_counted > of_both + said->energy_limit * largest)
          throw StoppedShort(fmt::format(
            "{}: at {:.6g} s bonds of constrained particles would have stored {:.3g} J in elements, of the {:.3g} "
            "J that both sides store: the body turns further than small displacements. Set "
            "Continuum/Model/Large displacement = true, or take Method = multipliers.",
            name, now.time, balance.double_counted, of_both));
        const std::size_t damaged = volume->damaged_bonds();
        if (static_cast<double>(damaged) > said->damage_limit * static_cast<double>(volume->bonds()))
          throw StoppedShort(
            fmt::format("{}: at {:.6g} s {} of the {} bonds in the overlap are damaged, more than "
                        "Damage limit = {}: there the solid cannot follow. Give the particles a larger "
                        "region.",
                        name, now.time, damaged, volume->bonds(), said->damage_limit));
        ++said;
        ++most;
      }
  }

  template <int dim>
  void EnergyWatch<dim>::check_balance(const CoupledEnergies &now) const
  {
    const fem::ExplicitEnergy &s     = now.solid;
    const double               limit = smallest_limit();
    if (-now.dissipated > limit * largest)
      throw StoppedShort(fmt::format("Continuum/Materials: at {:.6g} s points of the solid store {:.3g} J more than "
                                     "stresses have worked on them, more than Energy limit = {} of the largest energy, "
                                     "{:.3g} J: the material makes energy. Lower Continuum/Motion/Safety.",
                                     now.time, -now.dissipated, limit, largest));
    double made = touching.energies().spurious();
    for (const auto &surface : both.surfaces())
      made += surface->balance().spurious();
    for (const auto &handshake : both.volumes())
      made += handshake->balance().spurious();
    const double of_particles = -now.particles.residual(),
                 of_solid     = s.kinetic + s.internal + s.damped - s.external - s.start,
                 gained       = of_particles + of_solid + made;
    if (gained > limit * largest + now.particles.rounding)
      throw StoppedShort(fmt::format(
        "{}: at {:.6g} s there are {:.3g} J more than has been put in, more than Energy limit = {} of the largest "
        "energy, {:.3g} J: {:.3g} J too many with the particles and their contacts, {:.3g} J with the solid. {}; bonds "
        "that break while they are pressed leave a contact whose energy has no source.",
        names_of_couplings(model), now.time, gained, limit, largest, of_particles, of_solid,
        model.largest_ratio > 1 ? "Set Time/Largest ratio = 1" : "Lower Time/Step factor or Continuum/Motion/Safety"));
  }

  template <int dim>
  double EnergyWatch<dim>::smallest_limit() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const CouplingSection &coupling : model.couplings.couplings)
      least = std::min(least, coupling.energy_limit);
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      least = std::min(least, handshake.energy_limit);
    for (const ContactSection &contact : model.continuum.contacts.contacts)
      least = std::min(least, contact.energy_limit);
    return least;
  }

  template <int dim>
  std::string EnergyWatch<dim>::remedy(const double made, const double limit) const
  {
    if (model.largest_ratio == 1)
      return "Lower Continuum/Motion/Safety or Time/Step factor.";
    const double part = limit * largest / std::fabs(made);
    return fmt::format("Set Time/Largest ratio = {:.0f}, or a smaller Time/Sub-cycling loss.",
                       std::max(1.0, std::floor(part * static_cast<double>(model.largest_ratio))));
  }

  template <int dim>
  std::vector<std::string> EnergyWatch<dim>::doubts() const
  {
    std::vector<std::string> all;
    const auto               say = [&](const std::string &name, const double made) {
      if (made < -felt * largest)
        all.push_back(fmt::format("{} has lost {:.2g} of the largest energy, {:.3g} J", name, -made / largest, -made));
    };
    auto coupling = model.couplings.couplings.begin();
    for (const auto &surface : both.surfaces())
      say("Couplings/" + (coupling++)->name, surface->balance().spurious_in_all());
    auto handshake = model.handshakes.handshakes.begin();
    for (const auto &volume : both.volumes())
      say("Handshakes/" + (handshake++)->name, volume->balance().spurious());
    const coupling::SubCyclingLoss &loss = both.sub_cycling_loss();
    if (!all.empty() && loss.windows() > 0)
      all.push_back(fmt::format("sub-cycling has lost {:.2g} of the largest energy, with {:.3g} steps of one side in "
                                "one of the other on the mean: Time/Sub-cycling loss = {} allows that; less keeps more",
                                loss.lost() / largest, loss.steps() / loss.windows(), model.sub_cycling_loss));
    return all;
  }

  template <int dim>
  void EnergyWatch<dim>::visit_state(RunState &state)
  {
    state.scalar("largest_energy", largest);
    for (std::size_t h = 0; h < most_absorbed.size(); ++h)
      state.scalar("most_absorbed_" + std::to_string(h), most_absorbed[h]);
  }

  template class EnergyWatch<2>;
  template class EnergyWatch<3>;
} // namespace apps

#include "apps/runs/coupled/series.h"

#include "dem/facets/surface.h"

#include <iterator>
#include <string>

namespace apps
{
  namespace
  {
    constexpr const char *axis_suffixes[3] = {"_x", "_y", "_z"};
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> CoupledSeries<dim>::columns() const
  {
    std::vector<postprocess::SeriesColumn> all = {{"time", "s"}};
    const auto add = [&](const std::string &name, const char *unit) { all.push_back({name, unit}); };
    for (const postprocess::SeriesColumn &one : reported())
      all.push_back(one);
    for (const char *count : {"links", "broken_links", "contacts"})
      add(count, "");
    for (const CouplingSection &coupling : from.model.couplings.couplings)
      {
        add(column_name(coupling.name) + "_contacts", "");
        if (coupling.bond.given())
          {
            add(column_name(coupling.name) + "_glued", "");
            add(column_name(coupling.name) + "_torn", "");
          }
        add(column_name(coupling.name) + "_work", "J");
        add(column_name(coupling.name) + "_spurious", "J");
        add(column_name(coupling.name) + "_spurious_of_contacts", "J");
      }
    for (const postprocess::SeriesColumn &column : from.touching.columns())
      all.push_back(column);
    for (const HandshakeSection &handshake : from.model.handshakes.handshakes)
      {
        add(column_name(handshake.name) + "_damaged", "");
        for (const char *term : {"_work", "_spurious", "_absorbed", "_double_counted"})
          add(column_name(handshake.name) + term, "J");
      }
    for (const char *quantity : {"momentum", "angular_momentum"})
      for (const char *axis : axis_suffixes)
        add(std::string(quantity) + axis, quantity[0] == 'm' ? "N s" : "N m s");
    for (const char *term : {"kinetic", "internal", "external", "damped", "start"})
      add(std::string("energy_solid_") + term, "J");
    dem::EnergyAccount().each([&](const std::string &term, double) { add("energy_particles_" + term, "J"); });
    add("energy_residual", "J");
    return all;
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> CoupledSeries<dim>::reported() const
  {
    std::vector<postprocess::SeriesColumn> all;
    for (const ProbeColumn &probe : from.probes.columns())
      all.push_back(of_solid(probe));
    for (const ProbeSection &probe : from.model.particles.probes.probes)
      all.push_back({probe.name, probe.unit()});
    for (const CouplingSection &coupling : from.model.couplings.couplings)
      for (int d = 0; d < dim; ++d)
        all.push_back({column_name(coupling.name) + "_force" + axis_suffixes[d], "N"});
    for (const postprocess::SeriesColumn &force : from.touching.force_columns())
      all.push_back(force);
    for (const postprocess::SeriesColumn &of_press : from.model.laboratory.columns())
      all.push_back(of_press);
    return all;
  }

  template <int dim>
  CoupledRow CoupledSeries<dim>::row(const double time) const
  {
    const dem::ObservedSpecimen &specimen = from.body.specimen();
    const fem::ExplicitEnergy    s        = from.motion.energy();
    const dem::EnergyAccount     p        = specimen.energy();
    std::vector<double>          values   = {time};
    const auto      add = [&](const auto &list) { values.insert(values.end(), std::begin(list), std::end(list)); };
    ContinuumEnergy continuum;
    continuum.internal = s.internal;
    add(from.probes.read({&from.motion.displacement(), &from.motion.internal_force(), &from.motion.external_force()},
                         continuum));
    add(from.body.probes());
    for (const auto &surface : from.both.surfaces())
      for (int d = 0; d < dim; ++d)
        values.push_back(specimen.surfaces().at(surface->surface()).total_force[d]);
    add(from.touching.forces());
    add(from.model.laboratory.read(columns(), values));
    const dem::Counts counts = specimen.counts();
    add(std::initializer_list<double>{static_cast<double>(counts.links),
                                      static_cast<double>(counts.broken) + static_cast<double>(torn_glue()),
                                      static_cast<double>(counts.contacts + counts.wall_contacts)});
    double made     = from.touching.energies().spurious();
    auto   coupling = from.model.couplings.couplings.begin();
    for (const auto &surface : from.both.surfaces())
      {
        const coupling::SurfaceBalance balance = surface->balance();
        const dem::Surface            &touched = specimen.surfaces().at(surface->surface());
        values.push_back(static_cast<double>(touched.touching));
        if (coupling++->bond.given())
          add(std::initializer_list<double>{static_cast<double>(touched.glued), static_cast<double>(touched.torn)});
        add(std::initializer_list<double>{balance.work_on_solid, balance.spurious(), balance.contacts});
        made += balance.spurious(); // what contacts make, the residual of the particles shows already
      }
    add(from.touching.values());
    for (const auto &handshake : from.both.volumes())
      {
        const coupling::VolumeBalance &balance = handshake->balance();
        add(std::initializer_list<double>{static_cast<double>(handshake->damaged_bonds()), balance.work_on_solid,
                                          balance.spurious(), balance.absorbed, balance.double_counted});
        made += balance.spurious(); // what was absorbed is known, and no defect
      }
    const auto [linear, angular] = momentum();
    add(std::initializer_list<double>{linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]});
    add(std::initializer_list<double>{s.kinetic, s.internal, s.external, s.damped, s.start});
    p.each([&](const std::string_view, const double value) { values.push_back(value); });
    // What went into one side by the other is no energy from outside.
    values.push_back(s.external + s.start - s.kinetic - s.internal - s.damped + p.residual() - made);
    return {values, {time, s, p, continuum.dissipated}};
  }

  template <int dim>
  std::int64_t CoupledSeries<dim>::torn_glue() const
  {
    std::int64_t torn = 0;
    for (const auto &coupled : from.both.surfaces())
      torn += from.body.specimen().surfaces().at(coupled->surface()).torn;
    return torn;
  }

  template <int dim>
  coupling::Momentum CoupledSeries<dim>::momentum() const
  {
    coupling::Momentum sum   = coupling::momentum_of(from.participant);
    const std::size_t  count = from.body.specimen().counts().particles; // counting all is no work for every particle
    for (std::size_t i = 0; i < count; ++i)
      {
        const dem::ParticleState p = from.body.specimen().particle(i);
        sum.linear += p.mass * p.velocity;
        sum.angular += p.position.cross(p.mass * p.velocity) + p.inertia * p.spin;
      }
    return sum;
  }

  template class CoupledSeries<2>;
  template class CoupledSeries<3>;
} // namespace apps

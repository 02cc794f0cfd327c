#pragma once

#include "dem/specimen/specimen.h"
#include "memory_state.h"
#include "shared_bodies.h"

#include <string>
#include <vector>

/** What a body is in, and what is read of it, to be compared. */
namespace shared_bodies
{
  inline MemoryState state_of(Body &body)
  {
    MemoryState         state;
    MemoryState::Writer writer(state);
    body.visit(writer);
    return state;
  }

  inline void restore(const MemoryState &state, Body &body)
  {
    MemoryState::Reader reader(state);
    body.visit(reader);
  }

  /** Names of the parts that differ, each after a space. */
  inline std::string differences(const MemoryState &a, const MemoryState &b)
  {
    std::string names;
    const auto  compare = [&](const auto &some, const auto &others) {
      for (const auto &[name, values] : some)
        if (others.count(name) == 0 || others.at(name) != values)
          names += " " + name;
      if (some.size() != others.size())
        names += " (others)";
    };
    compare(a.columns, b.columns);
    compare(a.integer_columns, b.integer_columns);
    compare(a.numbers, b.numbers);
    compare(a.integers, b.integers);
    return names;
  }

  inline std::size_t numbers_in(const MemoryState &state)
  {
    std::size_t count = state.numbers.size() + state.integers.size();
    for (const auto &[name, values] : state.columns)
      count += values.size();
    for (const auto &[name, values] : state.integer_columns)
      count += values.size();
    return count;
  }

  /** Energies [J]. */
  inline std::vector<double> energies_of(const dem::ObservedSpecimen &specimen)
  {
    const dem::EnergyAccount e = specimen.energy();
    return {e.external_work, e.gravity, e.initial, e.kinetic, e.elastic, e.damage, e.friction, e.damping, e.released};
  }

  /** What is read of a specimen from outside, in a row. */
  inline std::vector<double> readings_of(const dem::ObservedSpecimen &specimen)
  {
    std::vector<double> row = energies_of(specimen);
    const dem::Counts   n   = specimen.counts();
    row.insert(row.end(),
               {n.deepest_overlap, specimen.stable_step(), specimen.mean_damage(), specimen.unbalanced_ratio()});
    for (const std::size_t count : {n.links, n.contacts, n.broken, n.wall_contacts})
      row.push_back(static_cast<double>(count));
    const auto     append = [&](const auto &numbers) { row.insert(row.end(), numbers.begin(), numbers.end()); };
    const Vector3d force  = specimen.force_on({0, 1, 2, 3, 4, 5, 6, 7});
    append(std::vector<double>(force.data(), force.data() + 3));
    const dem::ParticleOutput particles = specimen.particles();
    append(particles.damage);
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      {
        append(std::vector<double>(particles.position[i].data(), particles.position[i].data() + 3));
        append(std::vector<double>(particles.velocity[i].data(), particles.velocity[i].data() + 3));
        append(std::vector<double>(particles.stress[i].data(), particles.stress[i].data() + 9));
      }
    const dem::LinkOutput links = specimen.links();
    append(links.normal_force);
    append(links.damage);
    return row;
  }
} // namespace shared_bodies

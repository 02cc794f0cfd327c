#include "dem/specimen/told_to_first.h"

#include "base/voigt.h"
#include "dem/specimen/core.h"
#include "dem/specimen/few_lines.h"
#include "dem/specimen/inside.h"
#include "dem/specimen/observation.h"
#include "dem/specimen/shown.h"

#include <algorithm>

namespace dem
{
  // --- Particles ---

  ParticleOutput lasting_particles(const ObservedSpecimen &specimen)
  {
    const SpecimenCore &core = core_in_parts_of(specimen);
    const Particles    &p    = core.particles;
    ParticleOutput      out;
    out.radius.resize(p.count);
    out.held.assign(p.count, 0);
    out.volume.resize(p.count);
    out.broken_links.resize(p.count);
    out.material.resize(p.material.empty() ? 0 : p.count);
    for (const std::int32_t held : core.held.members())
      out.held[static_cast<std::size_t>(p.number[static_cast<std::size_t>(held)])] = 1;
    for (std::size_t i = 0; i < p.count; ++i)
      {
        const auto to        = static_cast<std::size_t>(p.number[i]);
        out.radius[to]       = p.radius_of(i);
        out.volume[to]       = volume_of(core, i);
        out.broken_links[to] = p.broken_links[i];
        if (!p.material.empty())
          out.material[to] = p.material[i];
      }
    return out;
  }

  namespace
  {
    template <typename Matrix>
    void put(std::vector<double> &numbers, const Matrix &values)
    {
      numbers.insert(numbers.end(), values.data(), values.data() + values.size());
    }

    /** Take numbers of each particle, as they follow each other. @param use called with its place in their order and its numbers */
    template <typename Use>
    SharedWork::Take taking(const std::size_t of_each, const Use &use)
    {
      return [at = std::size_t(0), of_each, use](const std::vector<double> &numbers) mutable {
        for (std::size_t n = 0; n < numbers.size(); n += of_each)
          use(at++, &numbers[n]);
      };
    }
  } // namespace

  ParticleOutput placed_particles_for_first(const ObservedSpecimen &specimen)
  {
    SpecimenCore    &core = core_in_parts_of(specimen);
    const Particles &p    = core.particles;
    if (core.has_all_links())
      core.gather_particles(); // they may have moved since
    ParticleOutput out;
    if (core.is_first())
      {
        out = lasting_particles(specimen);
        out.position.resize(p.count);
        out.displacement.resize(p.count);
      }
    core.tell_first_of_particles(
      [&](const std::size_t begin, const std::size_t end, std::vector<double> &numbers) {
        for (std::size_t i = begin; i < end; ++i)
          for (const Eigen::Vector3d &one : {p.position_of(i), displacement_of(p, i)})
            put(numbers, one);
      },
      taking(6, [&](const std::size_t i, const double *numbers) {
        const auto to        = static_cast<std::size_t>(p.number[i]);
        out.position[to]     = Eigen::Vector3d(numbers);
        out.displacement[to] = Eigen::Vector3d(numbers + 3);
      }));
    return out;
  }

  namespace
  {
    /** Of the links of which particles each rank reads what they do; where the first has all of them, it reads all. */
    ShownParticles read_by_each(const SpecimenCore &core)
    {
      const bool by_first_alone = core.has_all_links();
      if (by_first_alone)
        return core.is_first() ? ShownParticles{0, core.particles.count} : ShownParticles{};
      const auto [first, last] = core.own_particles();
      return {first, last};
    }

  } // namespace

  ParticleOutput particles_for_first(const ObservedSpecimen &specimen)
  {
    SpecimenCore             &core = core_in_parts_of(specimen);
    ParticleOutput            out  = placed_particles_for_first(specimen);
    const ShownParticles      read = read_by_each(core);
    const std::vector<double> lost = damage_of_links(core, read, !core.has_all_links());
    out.damage.resize(out.position.size());
    core.tell_first_of_particles(
      [&](const std::size_t begin, const std::size_t end, std::vector<double> &numbers) {
        for (std::size_t i = begin; i < end; ++i)
          numbers.push_back(mean_damage_of(core.particles, i, lost[i - read.first]));
      },
      taking(1, [&](const std::size_t i, const double *damage) {
        out.damage[static_cast<std::size_t>(core.particles.number[i])] = *damage;
      }));
    return out;
  }

  namespace
  {
    /** Of some particles, from the first of them on. */
    LinkEffects part_of(const LinkEffects &effects, const std::size_t begin, const std::size_t end)
    {
      const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end);
      return {{effects.moments.begin() + from, effects.moments.begin() + to},
              {effects.damage.begin() + from, effects.damage.begin() + to}};
    }

    /** What lasting_particles() does not know, for as many particles. */
    void add_changing(ParticleOutput &out, const SpecimenCore &core)
    {
      const std::size_t n = core.particles.count;
      for (std::vector<Eigen::Vector3d> *column :
           {&out.position, &out.displacement, &out.velocity, &out.angular_velocity})
        column->resize(n);
      out.damage.resize(n);
      out.stress.resize(n);
      out.mass.resize(n);
      for (std::size_t i = 0; i < n; ++i)
        out.mass[static_cast<std::size_t>(core.particles.number[i])] = core.mass_of(i);
    }
  } // namespace

  ParticleOutput all_particles_for_first(const ObservedSpecimen &specimen)
  {
    constexpr std::size_t of_each = 19;
    SpecimenCore         &core    = core_in_parts_of(specimen);
    if (core.has_all_links())
      core.gather_particles(); // they may have moved since
    const ShownParticles read    = read_by_each(core);
    const LinkEffects    effects = effects_of_links(core, read, !core.has_all_links());
    ParticleOutput       out;
    if (core.is_first())
      add_changing(out = lasting_particles(specimen), core);
    core.tell_first_of_particles(
      [&](const std::size_t begin, const std::size_t end, std::vector<double> &numbers) {
        const ParticleOutput some =
          particles_of(core, {begin, end}, part_of(effects, begin - read.first, end - read.first));
        for (std::size_t i = 0; i < end - begin; ++i)
          {
            for (const auto *column : {&some.position, &some.displacement, &some.velocity, &some.angular_velocity})
              put(numbers, (*column)[i]);
            put(numbers, base::stress_voigt(some.stress[i]));
            numbers.push_back(some.damage[i]);
          }
      },
      taking(of_each, [&](const std::size_t i, const double *numbers) {
        const auto to = static_cast<std::size_t>(core.particles.number[i]);
        for (auto *column : {&out.position, &out.displacement, &out.velocity, &out.angular_velocity})
          {
            (*column)[to] = Eigen::Vector3d(numbers);
            numbers += 3;
          }
        out.stress[to] = base::stress_tensor(base::Voigt(numbers));
        out.damage[to] = numbers[6];
      }));
    return out;
  }

  std::vector<double> stress_for_first(const ObservedSpecimen &specimen)
  {
    SpecimenCore                &core    = core_in_parts_of(specimen);
    const ShownParticles         read    = read_by_each(core);
    std::vector<Eigen::Matrix3d> moments = moments_of_links(core, read, !core.has_all_links());
    add_moments_of_surfaces(core, read, moments);
    std::vector<double> all(core.is_first() ? 6 * core.particles.count : 0);
    core.tell_first_of_particles(
      [&](const std::size_t begin, const std::size_t end, std::vector<double> &numbers) {
        for (std::size_t i = begin; i < end; ++i)
          {
            const base::Voigt stress = base::stress_voigt(stress_of(core, i, moments[i - read.first]));
            numbers.insert(numbers.end(), stress.data(), stress.data() + stress.size());
          }
      },
      taking(6, [&](const std::size_t i, const double *stress) {
        std::copy_n(stress, 6, &all[6 * static_cast<std::size_t>(core.particles.number[i])]);
      }));
    return all;
  }

  // --- Links ---

  void tell_first_of_links(const ObservedSpecimen &specimen, const TellOfLink &tell, const TakeOfLinks &take)
  {
    SpecimenCore &core = core_in_parts_of(specimen);
    const auto    say  = [&](const LinkOutput &some, std::vector<double> &numbers) {
      for (std::size_t l = 0; l < some.ends.size(); ++l)
        tell(some, l, numbers);
    };
    for (const LinkSet *links : {&core.bonds, &core.contacts})
      core.tell_first(
        *links,
        [&](const std::size_t begin, const std::size_t end, std::vector<double> &numbers) {
          say(links_among(core, *links, {begin, end}), numbers);
        },
        take);
    if (!core.is_first()) // all know what broke
      return;
    std::vector<double> numbers;
    say(broken_links(core), numbers);
    take(numbers);
  }

  namespace
  {
    /** What files for ParaView show of links beside their ends, kinds and pairs of materials. */
    template <typename Links, typename Use>
    void each_shown_column(Links &links, const Use &use)
    {
      for (auto *column : {&links.normal_force, &links.shear_force, &links.normal_stress, &links.shear_stress,
                           &links.normal_strain, &links.damage})
        use(*column);
      for (auto &column : links.history)
        use(column);
    }

    /** Room for all, of which pages are taken as they are filled. */
    void reserve(LinkOutput &out, const SpecimenCore &core)
    {
      const std::size_t most = core.bonds.alive + core.contacts.alive + core.cracks.count();
      out.ends.reserve(most);
      out.kind.reserve(most);
      out.pair.reserve(core.bond_law->several() ? most : 0);
      each_shown_column(out, [&](std::vector<double> &column) { column.reserve(most); });
    }

    /** Four numbers of each, its shown columns, and where it is to be seen its branch. */
    void put_link(const LinkOutput &some, const std::size_t l, const bool branch, std::vector<double> &numbers)
    {
      numbers.insert(numbers.end(), {static_cast<double>(some.ends[l][0]), static_cast<double>(some.ends[l][1]),
                                     static_cast<double>(some.kind[l]), some.pair.empty() ? -1.0 : some.pair[l]});
      each_shown_column(some, [&](const std::vector<double> &column) { numbers.push_back(column[l]); });
      if (branch)
        put(numbers, some.load[l].branch);
    }

    void take_link(LinkOutput &out, const double *numbers)
    {
      out.ends.push_back({static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1])});
      out.kind.push_back(static_cast<std::int32_t>(numbers[2]));
      if (numbers[3] >= 0)
        out.pair.push_back(static_cast<std::int32_t>(numbers[3]));
      numbers += 4;
      each_shown_column(out, [&](std::vector<double> &column) { column.push_back(*numbers++); });
    }
  } // namespace

  LinkOutput shown_links_for_first(const ObservedSpecimen &specimen, const SeeLinks &see)
  {
    const SpecimenCore &core    = core_in_parts_of(specimen);
    LinkOutput          out     = without_links(core);
    std::size_t         columns = 4;
    each_shown_column(out, [&](const std::vector<double> &) { ++columns; });
    const std::size_t of_each = columns + (see ? 3 : 0);
    if (core.is_first())
      reserve(out, core);
    tell_first_of_links(
      specimen,
      [&](const LinkOutput &some, const std::size_t l, std::vector<double> &numbers) {
        put_link(some, l, static_cast<bool>(see), numbers);
      },
      [&](const std::vector<double> &numbers) {
        LinkOutput some;
        for (std::size_t n = 0; n < numbers.size(); n += of_each)
          {
            take_link(out, &numbers[n]);
            if (!see)
              continue;
            some.ends.push_back(out.ends.back());
            some.kind.push_back(out.kind.back());
            some.load.emplace_back().branch = Eigen::Vector3d(&numbers[n + columns]);
          }
        if (see)
          see(some);
      });
    if (core.is_first())
      out.glue = glue_of(core);
    return out;
  }

  LinkOutput damaged_links_for_first(const ObservedSpecimen &specimen)
  {
    constexpr std::size_t of_each = 8;
    const SpecimenCore   &core    = core_in_parts_of(specimen);
    LinkOutput            out;
    tell_first_of_links(
      specimen,
      [](const LinkOutput &some, const std::size_t l, std::vector<double> &numbers) {
        if (some.kind[l] == LinkOutput::contact || !(some.damage[l] > 0))
          return;
        const auto &[first, second] = some.ends[l];
        const Eigen::Vector3d &to   = some.load[l].branch;
        numbers.insert(numbers.end(),
                       {static_cast<double>(first), static_cast<double>(second), static_cast<double>(some.kind[l]),
                        some.pair.empty() ? -1.0 : some.pair[l], some.damage[l], to.x(), to.y(), to.z()});
      },
      [&](const std::vector<double> &numbers) {
        for (std::size_t n = 0; n < numbers.size(); n += of_each)
          {
            out.ends.push_back({static_cast<std::size_t>(numbers[n]), static_cast<std::size_t>(numbers[n + 1])});
            out.kind.push_back(static_cast<std::int32_t>(numbers[n + 2]));
            if (numbers[n + 3] >= 0)
              out.pair.push_back(static_cast<std::int32_t>(numbers[n + 3]));
            out.damage.push_back(numbers[n + 4]);
            out.load.emplace_back().branch = Eigen::Vector3d(&numbers[n + 5]);
          }
      });
    if (core.is_first())
      out.glue = glue_of(core);
    return out;
  }

  void add_up_links(const ObservedSpecimen                        &specimen,
                    std::vector<double>                           &numbers,
                    const std::function<void(const LinkOutput &)> &use)
  {
    SpecimenCore &core = core_in_parts_of(specimen);
    for (const LinkSet *links : {&core.bonds, &core.contacts})
      core.walk(*links, numbers.data(), numbers.size(), [&](const LinkRange &lines) {
        each_few_lines(lines.begin, lines.end, [&](const std::size_t begin, const std::size_t end) {
          use(links_among(core, *links, {begin, end}));
        });
      });
    use(broken_links(core));
  }
} // namespace dem

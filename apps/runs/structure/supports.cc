#include "apps/runs/structure/supports.h"

#include <fmt/format.h>

#include <map>

namespace apps
{
  void ParticleSupportsSection::check(const base::EntryPath &root, const int dimension, const GroupNames &names) const
  {
    const base::EntryPath all = root.at("Supports");
    for (const ParticleSupport &support : supports)
      names.require_section(all, support.group);
    for (const ParticleSupport &support : supports)
      {
        const base::EntryPath s = all.at(support.group);
        for (int c = 0; c < 3; ++c)
          {
            if (!support.drives(c))
              continue;
            const std::string entry = std::string("Displacement ") + "xyz"[c];
            if (c >= dimension)
              s.refuse(entry, "in two dimensions nothing moves along z. Leave it out.");
            const Expression &formula  = support.displacement[static_cast<std::size_t>(c)];
            const auto        at       = [&](const double t) { return formula(0.3, 0.2, 0.1, t); };
            const auto        away     = [&](const double t) { return formula(0.7, -0.4, 0.9, t); };
            constexpr double  rounding = 1e-9;
            if (at(0) != 0 || std::fabs(at(2) - 2 * at(1)) > rounding * std::fabs(at(1)) || away(1) != at(1))
              s.refuse(entry, "must be a number times t, the load factor, the same for the whole group.");
          }
      }
  }

  void ParticleSupportsSection::drive(dem::LoadedNetwork &loaded, const ParticleGroups &groups) const
  {
    std::map<std::pair<std::size_t, int>, const ParticleSupport *> driven_by;
    for (const ParticleSupport &support : supports)
      {
        const std::vector<std::size_t> &members = groups.at(support.group);
        for (int c = 0; c < loaded.network.dimension; ++c)
          if (support.drives(c))
            {
              for (const std::size_t i : members)
                if (const auto [found, is_new] = driven_by.emplace(std::pair{i, c}, &support); !is_new)
                  throw base::InputError(fmt::format("Supports/{} and Supports/{}: both lead particle {} along {}.",
                                                     found->second->group, support.group, i + 1, "xyz"[c]));
              dem::drive(loaded, members, c, support.displacement[static_cast<std::size_t>(c)](0, 0, 0, 1));
            }
        for (int c = 3; c < dem::motions && !support.spins; ++c)
          dem::drive(loaded, members, c, 0);
      }
  }
} // namespace apps

#include "apps/runs/particles/groups.h"

#include "apps/runs/particles/particle_numbers.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace apps
{
  void GroupSection::check(const base::EntryPath &section, const int dimension) const
  {
    if (members == Members::region)
      region.check(section, dimension);
    if (members == Members::layer && axis >= dimension)
      section.refuse("Axis", "in two dimensions the axes are x and y.");
    if (members == Members::file && !std::filesystem::is_regular_file(file))
      section.refuse("File", "there is no such file.");
  }

  std::vector<std::size_t> GroupSection::find(const dem::Packing &packing, const int dimension) const
  {
    if (members == Members::file)
      return read_particle_numbers(file, packing.size());
    double outermost = 0;
    if (members == Members::layer)
      {
        const auto by_place = [this](const auto &a, const auto &b) { return a[axis] < b[axis]; };
        const auto ends     = std::minmax_element(packing.centre.begin(), packing.centre.end(), by_place);
        outermost           = high ? (*ends.second)[axis] : (*ends.first)[axis];
      }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < packing.size(); ++i)
      if (members == Members::layer ? std::abs(packing.centre[i][axis] - outermost) <= thickness :
                                      region.holds(packing.centre[i], dimension))
        found.push_back(i);
    return found;
  }

  void GroupsSection::check(const base::EntryPath &root, const int dimension, GroupNames &names) const
  {
    for (const GroupSection &group : groups)
      {
        const base::EntryPath section = root.at("Groups").at(group.name);
        if (names.knows(group.name))
          section.refuse("there is a group of this name already (all particles are \"all\", and each "
                         "sub-section of More particles is a group). Choose another.");
        group.check(section, dimension);
        names.names.push_back(group.name);
      }
  }

  void GroupsSection::find(const dem::Packing &packing, const int dimension, ParticleGroups &found) const
  {
    for (const GroupSection &group : groups)
      {
        found[group.name] = group.find(packing, dimension);
        if (found[group.name].empty())
          throw base::InputError("Groups/" + group.name +
                                 ": no particle's centre lies in it. Check its place and size against the packing "
                                 "(metres).");
      }
    auto &all = found[GroupNames::all];
    all.resize(packing.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
  }

  std::string text_of(const ParticleGroups &groups)
  {
    std::string text;
    for (const auto &[name, members] : groups)
      text += (text.empty() ? "" : ", ") + name + " " + std::to_string(members.size());
    return text;
  }
} // namespace apps

#include "apps/runs/continuum/materials.h"

#include "apps/runs/continuum/cells.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace apps
{
  namespace
  {
  } // namespace

  base::Stiffness stiffness_in(const std::string &file, const std::string &way)
  {
    std::ifstream stream(file);
    if (!stream)
      throw base::InputError(file + ": cannot be opened.");
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    const auto           path = nlohmann::json::json_pointer("/" + way + "/stiffness");
    base::Stiffness      D;
    try
      {
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t j = 0; j < 6; ++j)
            D(static_cast<int>(i), static_cast<int>(j)) = json.at(path).at(i).at(j).get<double>();
      }
    catch (const nlohmann::json::exception &)
      {
        throw base::InputError(file + ": has no 6 x 6 matrix of numbers at \"" + path.to_string() +
                               "\". Give a homogenised.json of breccia homogenise.");
      }
    // A stiffness from an iterative solution is symmetric to its tolerance only.
    const base::Stiffness symmetric = 0.5 * (D + D.transpose());
    if ((D - symmetric).norm() > 1e-6 * D.norm())
      throw base::InputError(file + ": the matrix at \"" + path.to_string() + "\" is not symmetric.");
    return symmetric;
  }

  void MaterialOfGroup::become(const base::Stiffness &stiffness, const double found_density)
  {
    Block &block    = blocks.at(law->name());
    block.constants = block.constants->copy();
    block.constants->take_stiffness(0.5 * (stiffness + stiffness.transpose()));
    density = found_density;
  }

  std::unique_ptr<fem::MaterialPoints> MaterialOfGroup::make_points(const fem::Plane plane) const
  {
    try
      {
        const Block &block = chosen();
        if (block.stiffness_file.empty() || block.homogenised)
          {
            if (!block.homogenised)
              block.constants->check();
            return block.constants->make_points(plane);
          }
        const auto read = block.constants->copy();
        read->take_stiffness(stiffness_in(block.stiffness_file, block.stiffness_way));
        return read->make_points(plane);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(place.text() + ": Materials/" + group + ": " + refusal.what());
      }
  }

  const CellsConstants *MaterialOfGroup::cells() const
  {
    return dynamic_cast<const CellsConstants *>(chosen().constants.get());
  }

  void MaterialOfGroup::require_element_size(const double size) const
  {
    try
      {
        chosen().constants->require_element_size(size);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(place.text() + ": Materials/" + group + ": " + refusal.what());
      }
  }

  void MaterialsSection::check(const base::EntryPath &root, const bool large_displacement) const
  {
    for (const auto &group : groups)
      {
        const base::EntryPath s = root.at("Materials").at(group->group);
        if (large_displacement && !group->law->takes_large_strains())
          s.refuse("Law", "is a small-strain law. Large displacements need an elastic material.");
        const std::string &file = group->chosen().stiffness_file;
        if (!file.empty() && !std::filesystem::is_regular_file(file))
          s.at(group->law->name())
            .refuse("Stiffness file",
                    "there is no such file (" + std::filesystem::absolute(file).lexically_normal().string() + ").");
        if (const CellsConstants *cells = group->cells())
          cells->check(s.at(group->law->name()));
        else if (!group->is_homogenised())
          group->make_points(fem::Plane::strain); // refuses constants that do not fit together
      }
  }
} // namespace apps

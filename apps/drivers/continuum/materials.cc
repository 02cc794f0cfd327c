#include "apps/drivers/continuum/materials.h"

#include "apps/drivers/continuum/cells.h"
#include "apps/scene/constant_entries.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace apps
{
  namespace
  {
    /** Where a stiffness may stand in for the constants; they are then not needed. */
    void declare_stiffness_file(Section &section, MaterialOfGroup::Block &block)
    {
      section.file("Stiffness file", block.stiffness_file)
        .means("homogenised.json of breccia homogenise, in place of the entries");
      section.find_entry("Stiffness file")->required = false;
      section
        .choice("Stiffness way", block.stiffness_way,
                {{"relaxed", std::string("relaxed")},
                 {"affine", std::string("affine")},
                 {"statistics", std::string("statistics")}},
                Need::optional)
        .means("Which of the three stiffnesses of the file");
    }
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

  void MaterialOfGroup::declare(Section &section, const std::function<bool()> &is_explicit, const bool holds_particles)
  {
    auto kinds = fem::material_kinds();
    kinds.push_back(cells_kind());
    std::vector<std::string> names;
    for (const auto &kind : kinds)
      names.push_back(kind->name());
    law = kinds.front().get();
    section
      .choice_of(
        "Law", names, 0, [this, kinds](const std::size_t i) { law = kinds.at(i).get(); }, Need::required)
      .means("Law of the group; the section of its name holds its constants");
    section.number("Density", density, "kg/m^3", Range::positive(), Need::required)
      .means("Mass per volume")
      .only_if([this, is_explicit] { return is_explicit() && !is_homogenised(); },
               holds_particles ? "in motion, and the law is not homogenised" : "Model/Analysis = explicit");

    for (const auto &kind : kinds)
      {
        Section &entries = section.section(kind->name(), kind->meaning());
        entries.only_if([this, kind] { return law == kind.get(); }, "Law = " + kind->name());
        Block &block    = blocks[kind->name()];
        block.constants = kind->constants();
        if (kind->takes_stiffness())
          declare_stiffness_file(entries, block);
        if (kind->takes_stiffness() && holds_particles)
          entries.flag("Homogenised", block.homogenised)
            .means("Stiffness and density are those of the particles inside the solid, found from their periodic cell; "
                   "where "
                   "there are Regions, of that in which the elements lie");
        const std::size_t first = entries.entries().size();
        block.constants->visit(ConstantEntries{entries});
        if (auto *cells = dynamic_cast<CellsConstants *>(block.constants.get()))
          cells->declare(entries);
        for (std::size_t i = first; kind->takes_stiffness() && i < entries.entries().size(); ++i)
          entries.entries()[i]->only_if([&block] { return block.stiffness_file.empty() && !block.homogenised; },
                                        holds_particles ? "there is no Stiffness file, and Homogenised = false" :
                                                          "there is no Stiffness file");
      }
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

  void MaterialsSection::declare(Section &root, std::function<bool()> is_explicit, const bool holds_particles)
  {
    Section &s = root.section("Materials", "One sub-section per named group of elements: its law");
    s.named_sections("GROUP", [this, is_explicit = std::move(is_explicit), holds_particles](Section &opened) {
      groups.push_back(std::make_unique<MaterialOfGroup>());
      groups.back()->group = opened.name();
      groups.back()->place = opened.place();
      groups.back()->declare(opened, is_explicit, holds_particles);
    });
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

#include "apps/drivers/continuum/materials.h"

#include "apps/scene/continuum_law_block.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace apps
{
  namespace
  {
    constexpr double softest = 1e3; // [Pa]: gels are about as soft
  }

  void MaterialOfGroup::declare(Section &section, const std::function<bool()> &is_explicit)
  {
    const auto is = [this](const Law wanted) { return [this, wanted] { return law == wanted; }; };
    section
      .choice("Law", law,
              {{fem::IsotropicElastic::name, Law::isotropic},
               {fem::AnisotropicElastic::name, Law::anisotropic},
               {fem::DamagePlasticConcrete::name, Law::concrete}},
              Need::required)
      .means("Law of the group; the section of its name holds its constants");
    section.number("Density", density, "kg/m^3", Range::positive(), Need::required)
      .means("Mass per volume")
      .only_if(is_explicit, "Model/Analysis = explicit");

    Section &hooke = section.section(fem::IsotropicElastic::name, "Hooke's law");
    hooke.only_if(is(Law::isotropic), "Law = isotropic elastic");
    declare_continuum_law<fem::IsotropicElastic>(hooke, isotropic);

    Section &full = section.section(fem::AnisotropicElastic::name, "Any stiffness, e.g. a homogenised one");
    full.only_if(is(Law::anisotropic), "Law = anisotropic elastic");
    full.file("Stiffness file", stiffness_file)
      .means("homogenised.json of breccia homogenise, in place of the entries");
    full.find_entry("Stiffness file")->required = false;
    full
      .choice("Stiffness way", stiffness_way,
              {{"relaxed", std::string("relaxed")},
               {"affine", std::string("affine")},
               {"statistics", std::string("statistics")}},
              Need::optional)
      .means("Which of the three stiffnesses of the file");
    declare_continuum_law<fem::AnisotropicElastic>(full, anisotropic);
    for (const auto &entry : full.entries())
      if (entry->name[0] == 'D')
        entry->only_if([this] { return stiffness_file.empty(); }, "there is no Stiffness file");

    Section &concrete_block =
      section.section(fem::DamagePlasticConcrete::name, "Grassl and Jirasek (2006): plasticity and damage");
    concrete_block.only_if(is(Law::concrete), "Law = damage-plastic concrete");
    declare_continuum_law<fem::DamagePlasticConcrete>(concrete_block, concrete);
  }

  fem::AnisotropicElastic MaterialOfGroup::anisotropic_law() const
  {
    if (stiffness_file.empty())
      return fem::AnisotropicElastic(anisotropic);
    std::ifstream stream(stiffness_file);
    if (!stream)
      throw std::invalid_argument(stiffness_file + ": cannot be opened.");
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    const auto           path = nlohmann::json::json_pointer("/" + stiffness_way + "/stiffness");
    fem::Stiffness       D;
    try
      {
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t j = 0; j < 6; ++j)
            D(static_cast<int>(i), static_cast<int>(j)) = json.at(path).at(i).at(j).get<double>();
      }
    catch (const nlohmann::json::exception &)
      {
        throw std::invalid_argument(stiffness_file + ": has no 6 x 6 matrix of numbers at \"" + path.to_string() +
                                    "\". Give a homogenised.json of breccia homogenise.");
      }
    // A stiffness from an iterative solution is symmetric to its tolerance only.
    const fem::Stiffness symmetric = 0.5 * (D + D.transpose());
    if ((D - symmetric).norm() > 1e-6 * D.norm())
      throw std::invalid_argument(stiffness_file + ": the matrix at \"" + path.to_string() + "\" is not symmetric.");
    return fem::AnisotropicElastic(symmetric);
  }

  std::unique_ptr<fem::MaterialPoints> MaterialOfGroup::make_points(const fem::Plane plane) const
  {
    try
      {
        if (law == Law::isotropic && isotropic.young_modulus < softest)
          throw std::invalid_argument(fmt::format("Young modulus = {} Pa: no solid is as soft. Is it in Pa? 25 GPa are "
                                                  "25e9.",
                                                  isotropic.young_modulus));
        if (law == Law::isotropic)
          return fem::make_points(fem::IsotropicElastic(isotropic), plane);
        if (law == Law::anisotropic)
          return fem::make_points(anisotropic_law(), plane);
        return fem::make_points(fem::DamagePlasticConcrete(concrete), plane);
      }
    catch (const std::invalid_argument &refusal)
      {
        throw dem::InputError(place.text() + ": Materials/" + group + ": " + refusal.what());
      }
  }

  void MaterialsSection::declare(Section &root, std::function<bool()> is_explicit)
  {
    Section &s = root.section("Materials", "One sub-section per named group of elements: its law");
    s.named_sections("GROUP", [this, is_explicit = std::move(is_explicit)](Section &opened) {
      groups.push_back(std::make_unique<MaterialOfGroup>());
      groups.back()->group = opened.name();
      groups.back()->place = opened.place();
      groups.back()->declare(opened, is_explicit);
    });
  }

  void MaterialsSection::validate(const Section &root, const bool large_displacement) const
  {
    for (const auto &group : groups)
      {
        const Section &s = *root.find_section("Materials")->find_section(group->group);
        if (large_displacement && group->law == MaterialOfGroup::Law::concrete)
          s.refuse("Law", "is a small-strain law. Large displacements need an elastic material.");
        if (group->law == MaterialOfGroup::Law::anisotropic && !group->stiffness_file.empty() &&
            !std::filesystem::is_regular_file(group->stiffness_file))
          s.find_section(fem::AnisotropicElastic::name)
            ->refuse("Stiffness file", "there is no such file (" +
                                         std::filesystem::absolute(group->stiffness_file).lexically_normal().string() +
                                         ").");
        group->make_points(fem::Plane::strain); // refuses constants that do not fit together
      }
  }
} // namespace apps

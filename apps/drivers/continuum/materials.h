#pragma once

#include "apps/scene/section.h"
#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/damage_plastic/concrete.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/solid/material_points.h"

#include <memory>

namespace apps
{
  /** Sub-section of "Materials": the law of one group of elements. */
  struct MaterialOfGroup
  {
    enum class Law
    {
      isotropic,
      anisotropic,
      concrete
    };

    std::string                            group;
    Place                                  place;
    Law                                    law     = Law::isotropic;
    double                                 density = 0; ///< [kg/m^3], in explicit analyses
    fem::IsotropicElasticParameters        isotropic;
    fem::AnisotropicElasticParameters      anisotropic;
    std::string                            stiffness_file; ///< of `breccia homogenise`; "": the entries
    std::string                            stiffness_way = "relaxed";
    fem::DamagePlasticConcrete::Parameters concrete;

    void declare(Section &section, const std::function<bool()> &is_explicit);

    /** Room for points of this law. @throws dem::InputError naming the group and the constant that is refused. */
    std::unique_ptr<fem::MaterialPoints> make_points(fem::Plane plane) const;

  private:
    fem::AnisotropicElastic anisotropic_law() const;
  };

  /** Section "Materials": a law for every named group of elements. */
  struct MaterialsSection
  {
    std::vector<std::unique_ptr<MaterialOfGroup>> groups;

    void declare(Section &root, std::function<bool()> is_explicit);
    void validate(const Section &root, bool large_displacement) const;
  };
} // namespace apps

#include "apps/scene/entries/material_region.h"

#include "apps/scene/entries/region.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &section, MaterialRegion &material_region)
  {
    section.text("Material", material_region.material, Need::required).means("Name of a section in Materials");
    declare(section, material_region.region);
  }

  void declare_pair(Section &section, std::string &one, std::string &other, const std::string &between)
  {
    section.text("Material", one, Need::required).means("Name of a section in Materials");
    section.text("Other material", other, Need::required).means("Likewise; of " + between + " the same");
  }

  void declare_regions(Section &root, std::list<MaterialRegion> &regions, const std::string &of)
  {
    Section &places =
      root.section("Regions", "One sub-section per region whose " + of + " are of a material; later ones win");
    places.only_if([&regions] { return !regions.empty(); }, "there are several materials");
    places.named_list("REGION", regions, &MaterialRegion::name);
  }
} // namespace apps

#include "fem/points/registry.h"

#include "fem/points/all.h"
#include "fem/points/material_kind_of.h"

namespace fem
{
  template std::unique_ptr<MaterialPoints> make_points(const IsotropicElastic &, Plane);
  template std::unique_ptr<MaterialPoints> make_points(const AnisotropicElastic &, Plane);
  template std::unique_ptr<MaterialPoints> make_points(const DamagePlasticConcrete &, Plane);

  namespace
  {
    template <typename... Laws>
    std::vector<std::shared_ptr<const MaterialKind>> kinds_of(const std::tuple<Laws...> * /*of these types*/)
    {
      return {std::make_shared<MaterialKindOf<Laws>>()...};
    }

    std::vector<std::shared_ptr<const MaterialKind>> &all()
    {
      static auto kinds = kinds_of(static_cast<const Materials *>(nullptr));
      return kinds;
    }
  }

  const std::vector<std::shared_ptr<const MaterialKind>> &material_kinds() { return all(); }

  void add_material(std::shared_ptr<const MaterialKind> kind) { all().push_back(std::move(kind)); }
}

#include "apps/runs/coupled/element_region.h"

#include "apps/text/nearest_name.h"
#include "base/errors.h"

#include <algorithm>
#include <vector>

namespace apps
{
  std::unique_ptr<coupling::MeshElements> elements_of(const MeshSection &mesh, const int dimension)
  {
    if (dimension == 2)
      return coupling::elements_of(make_mesh<2>(mesh, MPI_COMM_SELF));
    return coupling::elements_of(make_mesh<3>(mesh, MPI_COMM_SELF));
  }

  coupling::MeshElements::Set elements_of_group(const coupling::MeshElements &mesh, const std::string &group)
  {
    const std::vector<std::string> names = mesh.groups();
    if (std::find(names.begin(), names.end(), group) == names.end())
      throw base::InputError("Handshakes: the mesh has no group of elements \"" + group + "\". " +
                             did_you_mean(group, names));
    return mesh.of_group(group);
  }
} // namespace apps

#include "dem/kernels/link_update.h"

namespace dem
{
  LinkPass select_bond_pass_in_plane(const Physics &physics, const Mixture mixture, const bool shear_damages)
  {
    return link_update::select_bonds<2>(physics, mixture, shear_damages);
  }

  LinkPass select_contact_pass_in_plane(const Physics &physics, const Mixture mixture)
  {
    return link_update::select_contacts<2>(physics, mixture);
  }
} // namespace dem

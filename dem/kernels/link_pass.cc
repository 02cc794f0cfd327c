#include "dem/kernels/link_pass.h"

namespace dem
{
  LinkPass select_bond_pass(const Physics &physics, const Mixture mixture, const bool shear_damages)
  {
    return (physics.dimension == 3 ? select_bond_pass_in_space : select_bond_pass_in_plane)(physics, mixture,
                                                                                            shear_damages);
  }

  LinkPass select_contact_pass(const Physics &physics, const Mixture mixture)
  {
    return (physics.dimension == 3 ? select_contact_pass_in_space : select_contact_pass_in_plane)(physics, mixture);
  }
} // namespace dem

// Passes of the cohesive particle model with the first-order shear update: only those that CpmLaw makes.
#include "dem/kernels/link_update.h"
#include "dem/laws/cpm_links.h"

#include <stdexcept>

namespace dem
{
  namespace
  {
    template <typename Law>
    LinkPass first_order_pass(const bool rotations, const Mixture mixture)
    {
      if (!rotations)
        throw std::logic_error("first-order shear without rotations");
      return link_update::choose(mixture, [](auto particles) -> LinkPass {
        return link_update::link_pass<link_update::Policy<Law, 3, true, particles>>;
      });
    }

    LinkPass none_in_plane() { throw std::logic_error("first-order shear in the plane"); }

    using Bond    = FirstOrderShear<CpmBond<DamageDriver::normal, true>>;
    using Contact = FirstOrderShear<CpmContact<true>>;
  } // namespace

  template <>
  LinkPass link_pass_in_space<Bond>(const bool rotations, const Mixture mixture)
  {
    return first_order_pass<Bond>(rotations, mixture);
  }
  template <>
  LinkPass link_pass_in_space<Contact>(const bool rotations, const Mixture mixture)
  {
    return first_order_pass<Contact>(rotations, mixture);
  }
  template <>
  LinkPass link_pass_in_plane<Bond>(bool, Mixture)
  {
    return none_in_plane();
  }
  template <>
  LinkPass link_pass_in_plane<Contact>(bool, Mixture)
  {
    return none_in_plane();
  }
} // namespace dem

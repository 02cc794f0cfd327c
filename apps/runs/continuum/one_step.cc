#include "apps/runs/continuum/one_step.h"

#include "base/errors.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr int    sampled  = 20; // as many as there would be
    constexpr double rounding = 1e-10;

    /** @param at gives the vector of a time */
    template <int dim, typename At>
    bool goes_straight(const fem::Solid<dim> &solid, const double end, const At &at)
    {
      fem::Vector first = solid.make_vector(), last = first, between = first;
      at(0.0, first);
      at(end, last);
      const double size = std::max(first.linfty_norm(), last.linfty_norm());
      for (int k = 1; k < sampled; ++k)
        {
          const double part = static_cast<double>(k) / sampled;
          at(part * end, between);
          between.add(part - 1, first, -part, last);
          if (!(between.linfty_norm() <= rounding * size)) // not a number either
            return false;
        }
      return true;
    }
  } // namespace

  template <int dim>
  bool one_step_does(const fem::Solid<dim> &solid, const ControlSection &control)
  {
    if (!solid.linear() || control.follow != ControlSection::Follow::time || control.first_step > 0 ||
        control.largest_step > 0)
      return false;
    const auto loads    = [&](const double time, fem::Vector &force) { solid.external_force(time, force); };
    const auto supports = [&](const double time, fem::Vector &values) { solid.prescribed(time, values); };
    try
      {
        return goes_straight(solid, control.end, loads) && goes_straight(solid, control.end, supports);
      }
    catch (const base::InputError &) // a formula without value at a time that no step needs
      {
        return false;
      }
  }

  template bool one_step_does(const fem::Solid<2> &, const ControlSection &);
  template bool one_step_does(const fem::Solid<3> &, const ControlSection &);
} // namespace apps

// What of a specimen counts where something else fills the same space (doc/theory/volume-coupling.md, 2).

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/measures/link_measures.h"
#include "dem/specimen/implementation.h"

#include <cmath>

namespace dem
{
  namespace
  {
    void refuse_late(const Specimen &specimen, const char *what)
    {
      if (specimen.steps() > 0)
        throw base::InputError(std::string(what) + ": only before the first step.");
      if (specimen.parameters().physics.periodic)
        throw base::InputError(std::string(what) + ": a periodic cell has no place for somebody else's body.");
    }

    double checked(const double weight, const Eigen::Vector3d &place)
    {
      if (weight > 0 && weight <= 1)
        return weight;
      throw base::InputError("Weight " + base::number_text(weight) + " at (" + base::number_text(place.x()) + ", " +
                             base::number_text(place.y()) + ", " + base::number_text(place.z()) +
                             "): must be above 0 and at most 1.");
    }

    /** Where a link acts. */
    Eigen::Vector3d contact_point(const Particles &p, const LinkSet &links, const std::size_t l)
    {
      const std::int32_t    J = links.first[l], K = links.second[l];
      const Eigen::Vector3d branch = branch_of(p, links, l);
      const double          length = branch.norm(), arm = 0.5 * (length + p.radius_of(J) - p.radius_of(K));
      return p.position_of(J) + arm / length * branch;
    }

    void scale_mass(Particles &p, const std::size_t i, const double weight)
    {
      p.mass[i] *= weight;
      p.inertia[i] *= weight;
      for (std::size_t c = 0; c < 6; ++c)
        p.inverse_mass[record_size * i + c] /= weight;
    }
  } // namespace

  void Specimen::share(const std::function<double(const Eigen::Vector3d &)> &of_bonds,
                       const std::vector<double>                            &of_masses)
  {
    refuse_late(*this, "Weights");
    Particles &p     = self->particles;
    LinkSet   &bonds = self->bonds;
    for (std::size_t l = 0; l < bonds.count; ++l)
      {
        const Eigen::Vector3d place = contact_point(p, bonds, l);
        bonds.area[l] *= checked(of_bonds(place), place);
      }
    for (std::size_t number = 0; number < p.count; ++number)
      {
        const auto i = static_cast<std::size_t>(self->slot[number]);
        scale_mass(p, i, checked(of_masses.at(number), p.position_of(i)));
      }
    self->longest_step = self->time_step = self->parameters.step_factor * self->stable();
  }

  void Specimen::leave(const std::vector<std::size_t> &given, const bool keep_bonds_between)
  {
    refuse_late(*this, "Particles of somebody else");
    Particles        &p     = self->particles;
    LinkSet          &bonds = self->bonds;
    std::vector<bool> left(p.count, false);
    for (const std::size_t number : given)
      left[static_cast<std::size_t>(self->slot.at(number))] = true;
    for (std::size_t l = 0; l < bonds.count && !keep_bonds_between; ++l)
      if (bonds.is_alive(l) && left[static_cast<std::size_t>(bonds.first[l])] &&
          left[static_cast<std::size_t>(bonds.second[l])])
        {
          bonds.remove(l);
          --self->made_links;
          --p.made_links[static_cast<std::size_t>(bonds.first[l])];
          --p.made_links[static_cast<std::size_t>(bonds.second[l])];
        }
    bonds.compact(p.count);
    Grip grip;
    grip.particles                           = given;
    grip.prescribed                          = {true, true, true, true, true, true};
    const std::size_t                  added = add_grip(grip);
    const std::vector<Eigen::Vector3d> rest(given.size(), Eigen::Vector3d::Zero());
    set_grip_velocities(added, rest, rest);
    for (const std::size_t number : given)
      {
        const auto i = static_cast<std::size_t>(self->slot[number]);
        p.mass[i] = p.inertia[i] = 0;
      }
    self->led_by.resize(p.count, {-1, 0});
    for (std::size_t k = 0; k < self->grips[added].members.size(); ++k)
      self->led_by[static_cast<std::size_t>(self->grips[added].members[k])] = {static_cast<std::int32_t>(added), k};
    self->longest_step = self->time_step = self->parameters.step_factor * self->stable();
  }
} // namespace dem

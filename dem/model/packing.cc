#include "dem/model/packing.h"

#include "base/errors.h"
#include "dem/neighbours/cell_list.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace dem
{
  namespace
  {
    std::string place(const Eigen::Vector3d &x)
    {
      std::ostringstream text;
      text << '(' << x[0] << ", " << x[1] << ", " << x[2] << ')';
      return text.str();
    }

    [[noreturn]] void refuse(const std::string &origin, const std::size_t particle, const std::string &why)
    {
      throw base::InputError(origin + ": particle " + std::to_string(particle + 1) + ": " + why);
    }

    /** Volumes, and squares of distances, of what lies within these can be computed [m]. */
    constexpr double smallest_length = 1e-100, largest_length = 1e100;

    /** Further out, in radii, the rounding of a place is no longer small against the strains of a link. */
    constexpr double farthest = 1e9;
    /** Of a centre, in periodic cells; neighbours are then no more than 127 cells apart, which is what a shift can hold. */
    constexpr double farthest_cell = 60;

    void check_place(const Packing &packing, const std::size_t i, const std::string &origin)
    {
      const Eigen::Vector3d &x = packing.centre[i];
      if (x.cwiseAbs().maxCoeff() > farthest * packing.radius[i])
        refuse(origin, i,
               "centre = " + place(x) +
                 ": more than 1e9 radii from the origin, too far to distinguish places there. Move the packing "
                 "to the origin, or check the units: metres.");
    }

    void check_particle(const Packing &packing, const std::size_t i, const std::string &origin)
    {
      for (int d = 0; d < 3; ++d)
        if (!std::isfinite(packing.centre[i][d]))
          refuse(origin, i, "centre = " + place(packing.centre[i]) + ": not finite numbers.");
        else if (std::abs(packing.centre[i][d]) > largest_length)
          refuse(origin, i, "centre = " + place(packing.centre[i]) + ": must lie within 1e100 m of the origin.");
      const double radius = packing.radius[i];
      if (radius >= smallest_length && radius <= largest_length)
        return check_place(packing, i, origin);
      std::ostringstream found;
      found << "radius = " << radius << ": must be a finite number above zero, from 1e-100 to 1e100 m.";
      refuse(origin, i, found.str());
    }

    std::vector<NeighbourPair> pairs_at_one_place(const Packing &packing, const std::string &origin)
    {
      try
        {
          return find_pairs(packing.centre, packing.radius, 1e-9, 0.0, packing.periodic_cell);
        }
      catch (const std::range_error &)
        {
          check_in_cell(packing, origin); // says which particle it is
          throw;
        }
    }

    /** Closer than a billionth of their radii: no direction could be given to a link between them. */
    void check_coincidence(const Packing &packing, const std::string &origin)
    {
      const auto same = pairs_at_one_place(packing, origin);
      if (same.empty())
        return;
      const bool images = packing.periodic_cell && same[0].shift != decltype(same[0].shift){};
      refuse(origin, same[0].second,
             "centre = " + place(packing.centre[same[0].second]) + ": the same place as particle " +
               std::to_string(same[0].first + 1) + (images ? " (its periodic image)" : "") +
               ". Remove one of the two.");
    }
  } // namespace

  namespace
  {
    void check_materials(const Packing &packing, const std::string &origin)
    {
      const auto &names = packing.material_names;
      for (std::size_t i = 0; i < names.size(); ++i)
        if (!is_material_name(names[i]))
          throw base::InputError(origin + ": material \"" + names[i] + "\": " + material_name_rule() + ".");
        else if (std::count(names.begin(), names.end(), names[i]) > 1)
          throw base::InputError(origin + ": the material name \"" + names[i] + "\" stands for two numbers.");
      if (packing.material.empty())
        return;
      if (packing.material.size() != packing.size())
        throw base::InputError(origin + ": " + std::to_string(packing.size()) + " particles but the materials of " +
                               std::to_string(packing.material.size()) + ".");
      for (std::size_t i = 0; i < packing.size(); ++i)
        if (packing.material[i] < 0)
          refuse(origin, i, "material = " + std::to_string(packing.material[i]) + ": must be a number from 0.");
        else if (!names.empty() && static_cast<std::size_t>(packing.material[i]) >= names.size())
          refuse(origin, i,
                 "material = " + std::to_string(packing.material[i]) + ": there are names for 0 to " +
                   std::to_string(names.size() - 1) + " only.");
    }
  } // namespace

  namespace
  {
    void check_bodies(const Packing &packing, const std::string &origin)
    {
      if (!packing.clump.empty() && packing.clump.size() != packing.size())
        throw base::InputError(origin + ": " + std::to_string(packing.size()) + " particles but the clumps of " +
                               std::to_string(packing.clump.size()) + ".");
      std::vector<bool> has_pebbles(packing.bodies.size(), false);
      for (std::size_t i = 0; i < packing.clump.size(); ++i)
        if (const std::int32_t body = packing.clump[i]; body >= 0)
          {
            if (packing.bodies.empty())
              refuse(
                origin, i,
                "clump = " + std::to_string(body) +
                  ": the packing says of no rigid body what it is. In a text each is a line \"# body VOLUME X Y Z "
                  "IXX IYY IZZ IYZ IXZ IXY\" before the first particle, in HDF5 a row of \"bodies\". Add these, or "
                  "leave the column clump out.");
            if (static_cast<std::size_t>(body) >= packing.bodies.size())
              refuse(origin, i,
                     "clump = " + std::to_string(body) + ": there are bodies for " +
                       std::to_string(packing.bodies.size()) + " only, numbered from 0.");
            has_pebbles[static_cast<std::size_t>(body)] = true;
          }
      for (std::size_t b = 0; b < packing.bodies.size(); ++b)
        {
          const PackedBody &body = packing.bodies[b];
          const std::string name = origin + ": body " + std::to_string(b) + ": ";
          if (!has_pebbles[b])
            throw base::InputError(name + "no particle is a pebble of it.");
          if (!(body.volume > 0) || !(body.inertia(2, 2) > 0) || !body.centre.allFinite() || !body.inertia.allFinite())
            throw base::InputError(name + "its volume and inertia must be finite numbers above 0, its centre finite.");
        }
    }
  } // namespace

  bool is_material_name(const std::string &name)
  {
    const auto allowed = [](const unsigned char c) {
      return std::isalnum(c) || c == '.' || c == '_' || c == '+' || c == '-';
    };
    return !name.empty() && std::isalnum(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(), allowed);
  }

  const char *material_name_rule()
  {
    return "a material's name begins with a letter or digit, and goes on with these and any of . _ + -";
  }

  void check_packing(const Packing &packing, const std::string &origin)
  {
    if (packing.centre.size() != packing.radius.size())
      throw base::InputError(origin + ": " + std::to_string(packing.centre.size()) + " centres but " +
                             std::to_string(packing.radius.size()) + " radii.");
    if (packing.size() == 0)
      throw base::InputError(origin + ": no particle. A packing needs at least one.");
    for (int d = 0; d < 3 && packing.periodic_cell; ++d)
      if (const double edge = (*packing.periodic_cell)[d];
          !(edge >= smallest_length && (edge <= largest_length || std::isinf(edge))))
        throw base::InputError(origin + ": periodic cell = " + place(*packing.periodic_cell) +
                               ": its edges must be above zero, from 1e-100 to 1e100 m (or inf: no repetition).");
    for (std::size_t i = 0; i < packing.size(); ++i)
      check_particle(packing, i, origin);
    check_materials(packing, origin);
    check_bodies(packing, origin);
    check_coincidence(packing, origin);
  }

  double solid_volume(const Packing &packing)
  {
    double sum = 0;
    for (const double r : packing.radius)
      sum += r * r * r;
    return 4.0 / 3.0 * M_PI * sum;
  }

  void check_in_cell(const Packing &packing, const std::string &origin)
  {
    for (std::size_t i = 0; i < packing.size(); ++i)
      for (int d = 0; d < 3 && packing.periodic_cell; ++d)
        if (packing.radius[i] > 5 * (*packing.periodic_cell)[d])
          refuse(origin, i,
                 "its radius is more than 5 edges of the periodic cell: it would touch hundreds of its own images.");
        else if (std::abs(packing.centre[i][d]) > farthest_cell * (*packing.periodic_cell)[d])
          refuse(origin, i,
                 "centre = " + place(packing.centre[i]) +
                   ": more than 60 periodic cells from the origin. Bring it back into the cell.");
  }
} // namespace dem

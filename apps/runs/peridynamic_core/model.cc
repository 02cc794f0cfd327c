#include "apps/runs/peridynamic_core/model.h"

#include "apps/text/nearest_name.h"
#include "dem/peridynamics/boundary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace apps
{
  namespace pd = dem::peridynamics;
  using Eigen::Vector3d;

  namespace
  {
    /** left, right, bottom, top, back, front: two along each axis, the one at its lower end first. */
    struct Side
    {
      int  axis;
      bool upper;
    };

    Side side_of(const std::string &name)
    {
      const std::vector<std::string> names{"left", "right", "bottom", "top", "back", "front"};
      const auto                     number = std::find(names.begin(), names.end(), name) - names.begin();
      return {static_cast<int>(number / 2), number % 2 == 1};
    }
  } // namespace

  void PeridynamicCoreModel::check(const base::EntryPath &root) const
  {
    const base::EntryPath solid = root.at("Continuum");
    continuum.check_as_part(solid);
    if (continuum.is_static())
      solid.at("Model").refuse("Analysis", "the core moves, and so does what is around it: explicit.");
    if (!continuum.contacts.empty())
      solid.at("Contacts")
        .refuse("bodies with a peridynamic core cannot touch each other here. Leave the section out.");
    if (!continuum.motion.rigid.empty())
      solid.at("Motion").refuse("Rigid bodies", "not with a peridynamic core. Leave the entry out.");
    check_shared(root);
    core.check(root.at("Core"));
    check_handshake(root);
  }

  void PeridynamicCoreModel::check_shared(const base::EntryPath &root) const
  {
    const base::EntryPath body = root.at("Core").at("Body");
    if (core.dimension() != dimension())
      body.refuse("Size",
                  fmt::format("has {} lengths, but Continuum/Model/Dimension = {}.", core.dimension(), dimension()));
    if (dimension() == 3)
      return;
    const double thickness = core.body().thickness, wanted = continuum.solid.thickness;
    if (std::abs(thickness - wanted) > 1e-9 * wanted)
      body.refuse("Thickness", fmt::format("must be Continuum/Model/Thickness, {} m.", wanted));
    if ((core.plane == pd::Space::plane_stress) != continuum.solid.plane_stress)
      body.refuse("Plane", "must be that of Continuum/Model.");
  }

  void PeridynamicCoreModel::check_handshake(const base::EntryPath &root) const
  {
    const base::EntryPath          section = root.at("Handshake");
    const std::vector<std::string> known = pd::side_names(dimension()), &sides = handshake.sides;
    if (sides.empty())
      section.refuse("Sides", "names no side of the core.");
    Vector3d left = core.body().size; // of the core where both are not
    for (const std::string &side : sides)
      {
        if (std::find(known.begin(), known.end(), side) == known.end())
          section.refuse("Sides", fmt::format("there is no side \"{}\". {} There are: {}.", side,
                                              did_you_mean(side, known), fmt::join(known, ", ")));
        left[side_of(side).axis] -= handshake.width;
        for (const PeridynamicTraction &traction : core.loads.tractions)
          if (traction.boundary == side)
            root.at("Core")
              .at("Tractions")
              .at(traction.name)
              .refuse("Boundary", "lies in the elements (Handshake/Sides): nothing can act there.");
      }
    if (left.head(dimension()).minCoeff() <= 0)
      section.refuse("Overlap",
                     "leaves nothing of the core: it must be less than half of its length between two sides.");
  }

  Eigen::AlignedBox3d PeridynamicCoreModel::room() const
  {
    Vector3d half = 0.5 * core.body().size;
    if (dimension() == 2)
      half.z() = std::numeric_limits<double>::infinity();
    return {-half, half};
  }

  coupling::VolumeCouplingParameters PeridynamicCoreModel::parameters() const
  {
    constexpr double endless = std::numeric_limits<double>::infinity();
    Vector3d         low = Vector3d::Constant(-endless), high = Vector3d::Constant(endless);
    const Vector3d   half = 0.5 * core.body().size;
    for (const std::string &name : handshake.sides)
      {
        const Side side                      = side_of(name);
        (side.upper ? high : low)[side.axis] = (side.upper ? 1 : -1) * (half[side.axis] - handshake.width);
      }
    coupling::VolumeCouplingParameters made;
    made.name             = "Handshake";
    made.overlap.distance = coupling::distance_from_box(low, high);
    made.overlap.width    = handshake.width;
    made.compatibility    = handshake.ties;
    return made;
  }

  bool PeridynamicCoreModel::is_taken(const Vector3d &place) const
  {
    return parameters().overlap.distance(place) <= 1e-9 * core.body().size.maxCoeff();
  }
} // namespace apps

#pragma once

#include "apps/text/place.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Boundary conditions", named after a boundary of the mesh. */
  struct BoundaryCondition
  {
    std::string name;
    Place       place{"model"}; ///< for messages: where it was written
    Expressions displacement, traction;
    Expression  pressure;
  };

  /** Sub-section of "Supports": prescribed displacements of the nodes in a box. */
  struct NodeSupport
  {
    std::string           name;
    Place                 place{"model"}; ///< for messages: where it was written
    std::array<double, 3> from{}, to{};
    bool                  is_box = false; ///< otherwise the one place `from`
    Expressions           displacement;
  };

  /** Sub-section of "Point forces". */
  struct PointLoad
  {
    std::string           name;
    Place                 place{"model"}; ///< for messages: where it was written
    std::array<double, 3> position{};
    Expressions           force;
  };

  /** Sub-section of "Points": where displacements are recorded. */
  struct NamedPoint
  {
    std::string           name;
    Place                 place{"model"}; ///< for messages: where it was written
    std::array<double, 3> position{};
  };

  /** Sections "Boundary conditions", "Supports", "Point forces", "Body force" and "Points". */
  struct LoadsSection
  {
    std::vector<std::unique_ptr<BoundaryCondition>> boundaries;
    std::vector<std::unique_ptr<NodeSupport>>       supports;
    std::vector<std::unique_ptr<PointLoad>>         forces;
    std::vector<std::unique_ptr<NamedPoint>>        points;
    Expressions                                     body_force;

    /** Nothing may act along z in two dimensions. @throws base::InputError. */
    void check(const base::EntryPath &root, int dimension) const;
  };
} // namespace apps

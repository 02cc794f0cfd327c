#include "apps/scene/entries/physics.h"

#include "dem/contacts/deepest_overlap.h"

namespace apps
{
  void declare_physics(Section &root, dem::Physics &physics)
  {
    Section &section = root.section("Physics", "What is modelled; what is off costs neither time nor memory");
    section.choice("Dimension", physics.dimension, {{"2", 2}, {"3", 3}}, Need::optional)
      .means("3: spheres in space; 2: discs in the plane z = 0");
    section.flag("Rotations", physics.rotations).means("Particles spin; off: they only translate");
    section.flag("Damage", physics.damage)
      .means("Links soften and break in tension; off: they stay as stiff as they were made");
    section.flag("Friction", physics.friction)
      .means("Shear stress is limited by cohesion and friction; off: shear stays elastic");
    section.flag("Contacts", physics.contacts)
      .means("Particles that meet after their link is gone, or that never had one, touch with friction");
    physics.largest_overlap = dem::DeepestOverlap::doubtful;
    section.number("Largest overlap", physics.largest_overlap, "-", Range::between(0.01, 1), Need::optional)
      .means("Of particles that touch without a bond, over the smaller radius: a run in motion whose particles are "
             "pressed further into each other ends and names them. Laws of contact hold for small overlaps");
  }

  void declare_static_physics(Section &root, int &dimension, bool &rotations)
  {
    Section &physics = root.section("Physics", "What is modelled");
    physics.choice("Dimension", dimension, {{"2", 2}, {"3", 3}}, Need::optional)
      .means("3: spheres in space; 2: discs in the plane z = 0");
    physics.flag("Rotations", rotations).means("Particles spin; off: they only translate");
  }
} // namespace apps

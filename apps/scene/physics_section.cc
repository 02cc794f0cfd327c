#include "apps/scene/physics_section.h"

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
  }
} // namespace apps

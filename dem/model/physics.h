#pragma once

namespace dem
{
  /** What a scene models; everything that is off costs neither time nor memory. Chosen once, when the specimen is made. */
  struct Physics
  {
    int  dimension = 3;    ///< 3: spheres; 2: discs in the plane z = 0, of the given thickness
    bool rotations = true; ///< particles spin; off: they only translate
    bool damage    = true; ///< links soften and break; off: they stay as stiff as they were
    bool friction  = true; ///< shear is limited by cohesion and friction; off: shear stays elastic
    bool contacts  = true; ///< particles that meet after their link is gone (or never had one) touch
    bool periodic =
      false; ///< the packing's periodic cell repeats and can be deformed; off: the packing is a body of its own
    double largest_overlap =
      1; ///< in motion, of particles that touch without a bond, over the smaller radius: past it the run ends; (0, 1]
  };

  /** In what the particles of a specimen may differ. */
  enum class Mixture
  {
    equal,    ///< in nothing: one material, and one radius, so that arms are half the length
    radii,    ///< in radius
    materials ///< in material, and in radius perhaps: each link has the constants of its pair
  };
} // namespace dem

#pragma once

namespace performance
{
  /** Operations of one link update, by kind. */
  struct Operations
  {
    long additions = 0, multiplications = 0, divisions = 0, roots = 0, comparisons = 0;

    long all() const { return additions + multiplications + divisions + roots + comparisons; }
  };

  /**
   * Counted by running the kernel's own kinematics, law and force on a number type that counts: rotations, exactly objective shear
   * update, damage and friction on, elastic state; the transposes between records and packs are moves and not counted.
   */
  Operations count_link_update();
} // namespace performance

#pragma once

#include <string>
#include <vector>

namespace apps
{
  /** How both sides move at the start, about the middle of all. */
  enum class CouplingMotion
  {
    translation,
    rotation, ///< as one rigid body, particles with their spin
    spin,     ///< particles turn, or one body; what is apart comes together
    pulse,    ///< a packet in one side runs into the other
    impact    ///< one side hits the other, or its free end is hit
  };

  /** A way of joining particles and a solid, or bodies of a solid, as it is measured here. */
  struct CouplingCase
  {
    enum class Kind
    {
      handshake, ///< a free bar of discs that goes over into one of elements
      surface,   ///< a ball on a free block
      bodies     ///< two free blocks
    };

    std::string name;
    Kind        kind   = Kind::handshake;
    int         choice = 0; ///< among those of its kind
    int         ratio  = 1; ///< steps of one side in one of the other; negative: of the solid
  };

  /** What a motion keeps: the largest changes over its course, over the sum of the sizes of their parts or the largest energy. */
  struct ConservationAnswer
  {
    double momentum = 0, turning = 0; ///< linear and angular [-]
    double energy = 0;                ///< in no account [-]
    double lost   = 0;                ///< by the coupling, as its account says, in the end [-]
    double cost   = 0;                ///< processor time of a window [s]
  };

  const std::vector<CouplingCase> &coupling_cases();
  const char                      *name_of(CouplingMotion motion);

  /** Run it. @param part of the longest stable window that is taken, in (0, 1] */
  ConservationAnswer measure_conservation(const CouplingCase &which, CouplingMotion motion, double part);
} // namespace apps
